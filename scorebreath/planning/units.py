"""Units: what no breath divides. A word as a rule; the parts of a compound together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from scorebreath.planning.model import SyllableCounter
from scorebreath.script import emoticons
from scorebreath.script.marks import DIVIDING, LONG_PAUSE, Act, Mark, NoBreath, VoiceMark
from scorebreath.script.model import Edge, ScriptWord, Sentence, SentenceType
from scorebreath.spans import Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Unit:
    """One word, or several that are joined (`joint` edges inside)."""

    words: tuple[ScriptWord, ...]
    counts: tuple[int, ...]
    """syllables of each word"""
    ends: tuple[int, ...]
    """code points of the text: after the last mark of each word, where a part that ends with it ends"""
    syllables: int
    """of all words, at least 1: whatever is said takes time"""
    written: str
    """as written, up to where the next unit begins"""
    start: int
    """code points of the text"""
    end: int
    """after its last mark: where a group that ends with it ends"""
    letters: Span
    """from its first letter to its last: what stands outside is punctuation"""
    edge: Edge
    """what follows it; `joint` only where a chain of joined words is longer than a breath"""
    ends_line: bool
    """whether a line of verse ends with it, whatever its edge; a stanza's end is its edge"""
    sentence_type: SentenceType
    closes: bool
    """whether a sentence ends with it"""
    stanza: int | None
    """of verse, from 0; None in prose"""
    signs: tuple[Span, ...] = ()
    """places in `written` of emoticons, each with the space before it and the mark behind it that ends nothing (A11)"""
    unheard: int = 0
    """code points of those in the text before it"""

    @property
    def after(self) -> tuple[Mark, ...]:
        """What the markup asks for between it and the next unit."""
        return self.words[-1].after

    @property
    def frontier(self) -> int:
        """Where the next unit begins, or will begin."""
        return self.start + len(self.written)

    @property
    def shown(self) -> str:
        """As written, with spaces for emoticons."""
        shown = self.written
        for sign in self.signs:
            shown = shown[: sign.start] + " " * sign.length + shown[sign.end :]
        return shown

    def heard(self, place: int) -> int:
        """A place in it, as code points of a text without emoticons."""
        inside = place - self.start
        return place - self.unheard - sum(max(0, min(inside, sign.end) - sign.start) for sign in self.signs)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Part:
    """A word on its way into a unit."""

    word: ScriptWord
    syllables: int
    written: str
    sentence: Sentence


class UnitReader:
    """Sentences to units, as they come.

    Args:
        count: Counts syllables; asked once a sentence, and once for each word.
        longest: Syllables one breath can hold: a chain of joined words is divided only beyond this.
        poem: Whether lines are lines of verse.
    """

    def __init__(self, count: SyllableCounter, longest: int, poem: bool = False) -> None:
        """Start with nothing read."""
        self._poem = poem
        self._count = Remembering(count)
        self._longest = longest
        self._chain: list[_Part] = []
        self._syllables = self._unheard = 0

    def read(self, sentence: Sentence) -> Iterator[Unit]:
        """Units that are complete once `sentence` is known: all, unless it ends inside a word."""
        for part in self._parts(sentence):
            if self._chain and self._syllables + part.syllables > self._longest:
                yield self._close()
            self._chain.append(part)
            self._syllables += part.syllables
            if part.word.edge != "joint" or dividing(part.word.after):
                yield self._close()

    def rest(self) -> Iterator[Unit]:
        """The text is over: the unit that still waited for its other half."""
        if self._chain:
            yield self._close()

    def _parts(self, sentence: Sentence) -> Iterator[_Part]:
        counts = iter(self._count([spoken for word in sentence.words for spoken in word.words]))
        origin = sentence.source.start
        for word, after in zip(sentence.words, (*sentence.words[1:], None), strict=True):
            stop = None if after is None else after.source.start - origin
            written = sentence.text[word.source.start - origin : stop] + ("" if after else sentence.gap)
            syllables = sum(next(counts) for _ in word.words)
            yield _Part(word=word, syllables=syllables, written=written, sentence=sentence)

    def _close(self) -> Unit:
        chain, self._chain, syllables, self._syllables = self._chain, [], self._syllables, 0
        first, last = chain[0], chain[-1]
        written = "".join(part.written for part in chain)
        start, edge = first.word.source.start, last.word.edge
        letters = Span(_letters(first).start, _letters(last).end)
        counts = [part.syllables for part in chain]
        counts[0] += syllables == 0
        signs, unheard = _signs(written), self._unheard
        self._unheard += sum(sign.length for sign in signs)
        return Unit(
            words=tuple(part.word for part in chain),
            counts=tuple(counts),
            ends=tuple(_end(part) for part in chain),
            syllables=max(1, syllables),
            written=written,
            start=start,
            end=_end(last),
            letters=letters,
            edge=edge,
            ends_line=edge == "line" or (self._poem and edge != "paragraph" and "\n" in written[letters.end - start :]),
            sentence_type=last.sentence.type,
            closes=edge in ("sentence", "paragraph") and last.sentence.complete,
            stanza=first.sentence.stanza if self._poem else None,
            signs=signs,
            unheard=unheard,
        )


class Remembering:
    """A syllable counter that asks only for words it has not met, all at once: counters may sit in other processes."""

    LIMIT = 50_000
    """words remembered; then it starts anew, so that memory stays bounded"""

    def __init__(self, count: SyllableCounter) -> None:
        """Remember nothing yet."""
        self._count = count
        self._known: dict[str, int] = {}

    def __call__(self, words: Sequence[str]) -> list[int]:
        """Syllables of each word."""
        if len(self._known) > self.LIMIT:
            self._known.clear()
        if new := [word for word in dict.fromkeys(words) if word not in self._known]:
            self._known.update(zip(new, self._count(new), strict=True))
        return [self._known[word] for word in words]


def dividing(marks: Sequence[Mark]) -> Mark | None:
    """The mark before which a breath group ends whatever else stands there.

    A breath, a sound of one, another voice; or the pauses, where they are together too long to hold the breath.
    """
    for mark in marks:
        if isinstance(mark, VoiceMark) or (isinstance(mark, Act) and mark.name in DIVIDING):
            return mark
    pauses = [mark for mark in marks if isinstance(mark, Act) and mark.name == "pause"]
    return pauses[0] if sum(pause.seconds or 0.0 for pause in pauses) >= LONG_PAUSE else None


def forbids(unit: Unit) -> bool:
    """Whether the markup forbids a breath behind a unit; where it asks for one at the same place, that is taken."""
    return any(isinstance(mark, NoBreath) for mark in unit.after) and not dividing(unit.after)


def _signs(written: str) -> tuple[Span, ...]:
    """Emoticons as `Unit.signs` has them."""
    if not emoticons.possible(written):
        return ()
    found = []
    for span in emoticons.spans(written):
        spaced = span.start > 0 and written[span.start - 1] == " "
        found.append(Span(span.start - spaced, span.end))
    return tuple(found)


def _end(part: _Part) -> int:
    return max(part.word.source.start + len(part.written.rstrip()), part.word.source.end)


def _letters(part: _Part) -> Span:
    """The bare word's place in the text: the written word less the punctuation that hangs on it."""
    word = part.word
    inside = part.written[: word.source.length].find(word.text) if word.text else -1
    if inside < 0:
        return word.source
    return Span(word.source.start + inside, word.source.start + inside + len(word.text))
