"""Text in, sentences out: as the text arrives, or all at once.

A sentence ends where nobody could doubt it, and else where pysbd says so when it is shown the text up to at least
`AHEAD` code points behind the end: a rule that looks at nothing further. So a sentence is given as soon as the start of
the next one is known, and it is the same however the text was cut on its way here. pysbd is quadratic: it sees windows
of some hundred code points. What has no end within `LONGEST` is given in parts, cut at the strongest place of the
second half. Blank lines and form feeds end everything.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import takewhile

from scorebreath.errors import ScriptError
from scorebreath.script import emoticons
from scorebreath.script.boundaries import END, FORCED, candidate, certain, ends
from scorebreath.script.decode import SURROGATE, universal_newlines
from scorebreath.script.dialogue import turns as turns_of
from scorebreath.script.gathering import Gatherer, alone
from scorebreath.script.kinds import kinds as kinds_of
from scorebreath.script.language import primary
from scorebreath.script.marks import Mark
from scorebreath.script.markup.marked import Marked, Markup, marked
from scorebreath.script.model import Script, Sentence
from scorebreath.script.sentence import Ending, hanging, make_sentence
from scorebreath.script.told import Told, between
from scorebreath.script.verse import is_verse
from scorebreath.spans import Span

AHEAD = 40
"""Code points behind a sentence's end that may decide about it."""
BEHIND = 160
"""Code points before what is to be judged that pysbd is shown, at most from the sentence's start on."""
STEP = 120
"""Code points that are judged at a time, at least: keeps a text of tiny sentences cheap."""
LONGEST = 4000
"""Code points of a sentence. What has no end within them is given in parts."""

DEFAULT_LANGUAGE = "en"

_SPACE, _LETTER = re.compile("[ n]"), re.compile("[adk]")
_BREAK = re.compile(r"n *n|f")
_LEAD = re.compile(r"(?:(?<![^ n])S )?[^ nfF]{0,16}$")
_LEADING_SYMBOLS = "§&"
_KEPT = 24
"""Code points before a sentence's first letter that may belong to it, with a margin."""
_CUTS = tuple(
    re.compile(pattern)
    for pattern in (r".*[;:MeN)][\"']*(?=[ n])", r".*,[\"']*(?=[ n])", r".*[^ n](?=[ n])", r".*(?=[^m])")
)
"""Where a part without a sentence end is cut, best first: at the last such place."""
_TRIM = 1 << 16
"""Code points that are let go at a time."""


@dataclass(slots=True, kw_only=True)
class _Raw:
    """A sentence whose gap is still growing."""

    text: str
    start: int
    letter: int
    """place of its first letter"""
    line: int
    complete: bool
    gap: list[str] = field(default_factory=list)


class Reader:
    """Reads a text as it arrives.

    Args:
        language: BCP 47; only the primary language counts.
        poem: Whether line ends are edges.
        turns: Places of newlines that end a paragraph, ascending.
        ends: Places of characters that end a sentence whatever they look like, ascending.
        marks: What the markup asks for, ascending; like the places, there before the text that they stand in.
        told: What MaryXML tells of words, each at a place of one of the word's letters, ascending; there as well.
        start: Place of the text's beginning; all places count from 0 of a larger text.

    Raises:
        ScriptError: `language` is no language tag.
    """

    def __init__(
        self,
        *,
        language: str = "en",
        poem: bool = False,
        turns: Sequence[int] = (),
        ends: Sequence[int] = (),
        marks: Sequence[Mark] = (),
        told: Sequence[tuple[int, Told]] = (),
        start: int = 0,
    ) -> None:
        """Start with an empty text."""
        self._language = primary(language)
        self._poem = poem
        self._told = (turns, "f"), (ends, FORCED)
        self._marks, self._knowledge = marks, told
        self._marked = 0  # marks that are given
        self._gatherer = Gatherer(done=start)
        self._letter = start  # place of the next sentence's first letter
        self._text = self._kinds = self._carry = ""
        self._base = start  # place of the buffer in the text
        self._at, self._inside = 0, False  # what lies before is done with; a sentence starts there, or a gap goes on
        self._ends: list[int] = []  # where the next sentences end
        self._complete = True  # whether those are ends of sentences
        self._raw: _Raw | None = None
        self._line = self._stanza = 0
        self._begun = self._over = False

    def feed(self, piece: str) -> list[Sentence]:
        """Take more text; give the sentences that later text can no longer change.

        Raises:
            ScriptError: Half of a surrogate pair, which is no text.
        """
        piece = self._carry + piece
        self._carry = ""
        if piece.endswith("\r"):
            piece, self._carry = piece[:-1], "\r"
        if piece and not self._begun:
            piece = piece.removeprefix("\ufeff")
            self._begun = True
        self._take(universal_newlines(piece))
        return list(self._sentences())

    def finish(self) -> list[Sentence]:
        """The text is over; give all that is left. Nothing can be fed afterwards."""
        self._take("\n" if self._carry else "")
        self._over = True
        found = list(self._sentences())
        return [*found, *self._close(last=True)]

    def _take(self, piece: str) -> None:
        """Append to the buffer, letting go of what is done with, but for what patterns look back at."""
        if match := SURROGATE.search(piece):
            place = self._base + len(self._text) + match.start()
            raise ScriptError(
                f"half of a surrogate pair (U+{ord(match.group()):04X}) at character {place}", expected="text"
            )
        if self._at > _TRIM or self._at * 2 > len(self._text):
            drop = max(0, self._at - emoticons.LONGEST)
            self._text, self._kinds = self._text[drop:], self._kinds[drop:]
            self._base += drop
            self._at -= drop
            self._ends = [end - drop for end in self._ends]
        place = self._base + len(self._text)
        self._text += piece
        self._kinds += self._apart(kinds_of(piece), place)

    def _apart(self, kinds: str, start: int) -> str:
        """Kinds of the text from `start` on, with a paragraph's end where a turn begins, and the ends markup makes."""
        for places, kind in self._told:
            first, last = bisect_left(places, start), bisect_left(places, start + len(kinds))
            if first == last:
                continue
            pieces, at = [], 0
            for place in places[first:last]:
                pieces += [kinds[at : place - start], kind]
                at = place - start + 1
            kinds = "".join((*pieces, kinds[at:]))
        return kinds

    def _sentences(self) -> Iterator[Sentence]:
        """All that can be read now."""
        while True:
            if self._inside:
                if not self._ends and not self._judge():
                    return
                self._end()
            elif self._seek():
                yield from self._close(last=False)
                self._inside = True
            else:
                return

    def _seek(self) -> bool:
        """Go through the gap up to the next sentence's start; whether it was found."""
        limit, found = self._first_letter()
        first = limit if found else None
        start = max(self._at, limit - _KEPT)
        if first is None:
            start = limit if self._over else emoticons.whole(self._text, start, self._at)
        else:
            lead = _LEAD.search(self._kinds, start, first)
            start = lead.start() if lead else first
            if self._kinds[start : start + 2] == "S " and self._text[start] not in _LEADING_SYMBOLS:
                start += 2
        gap = self._text[self._at : start]
        if self._raw:
            self._raw.gap.append(gap)
        else:
            self._line += gap.count("\n")
            self._gatherer.begin(gap)
        self._at, self._letter = start, self._base + limit
        self._ends = [end for end in self._ends if end > limit]
        return first is not None

    def _first_letter(self) -> tuple[int, bool]:
        """The next letter or digit that is no part of an emoticon, and whether there is one beyond doubt."""
        for match in _LETTER.finditer(self._kinds, self._at):
            place = match.start()
            behind = self._text[max(self._at, place - emoticons.LONGEST) : place]
            # what follows a heart may show that it is none
            heart = len(self._text) - place < _KEPT and "<" in behind
            if not self._over and (heart or emoticons.unfinished(self._text, place)):
                return place, False
            near = max(self._at, place - emoticons.LONGEST), min(len(self._text), place + _KEPT)
            if not any(span.start <= place < span.end for span in emoticons.spans(self._text, *near)):
                return place, True
        return len(self._text), False

    def _judge(self) -> bool:
        """Find where the next sentences end, looking further step by step; False if more text is needed."""
        start, known = self._at, len(self._text)
        cap = start + LONGEST
        judged = start
        while True:
            first = self._candidate(start, judged, min(known, cap))
            end = cap if first is None else min(cap, max(first[1] + AHEAD, judged + STEP))
            if first and judged == start and self._certain(*first):
                self._ends, self._complete = [first[1]], True
                return True
            apart = _BREAK.search(self._kinds, start, min(known, end))
            final = apart is not None or (self._over and known <= end)
            if final:
                end = apart.start() if apart else known
            if end > known:
                return False
            found = self._asked(max(start, judged - BEHIND), judged, end, final) if first and first[1] < end else []
            if final and found[-1:] != [end]:
                found.append(end)
            self._complete = bool(found)
            self._ends = found or ([self._part(start, cap)] if end == cap else [])
            if self._ends:
                return True
            judged = end - AHEAD

    def _certain(self, first: int, behind: int) -> bool:
        """Whether the sentence ends with these marks beyond doubt, in its first paragraph."""
        if not certain(self._text, self._kinds, first, behind, self._language):
            return False
        return _BREAK.search(self._kinds, self._at, first) is None

    def _asked(self, start: int, judged: int, end: int, final: bool) -> list[int]:
        """Ends between `judged` and `end` as pysbd sees them, shown the text from about `start` on."""
        if start > self._at and (space := _SPACE.search(self._kinds, start, judged)):
            start = space.end()
        places = ends(self._text[start:end], self._kinds[start:end], self._language, final=final)
        found, least = (start + place for place in places), max(judged, self._letter - self._base)
        return [place for place in found if place > least and (final or place <= end - AHEAD)]

    def _candidate(self, start: int, after: int, limit: int) -> tuple[int, int] | None:
        """The first marks from `start` on that may end a sentence behind `after`, and behind its first letter."""
        after = max(after, self._letter - self._base)
        for run in END.finditer(self._kinds, start, limit):
            if run.end() > after and candidate(self._kinds, run, limit):
                return run.span()
        return None

    def _part(self, start: int, cap: int) -> int:
        """Where to cut what has no end."""
        half = start + LONGEST // 2
        for pattern in _CUTS:
            if match := pattern.match(self._kinds, half, cap):
                return match.end()
        return cap

    def _end(self) -> None:
        """A sentence is over: its gap begins."""
        end = self._at + len(self._kinds[self._at : self._ends.pop(0)].rstrip(" n"))
        text, start = self._text[self._at : end], self._base + self._at
        self._raw = _Raw(text=text, start=start, letter=self._letter, line=self._line, complete=self._complete)
        self._at = end
        self._inside = False

    def _close(self, *, last: bool) -> Iterator[Sentence]:
        """The sentence whose gap is complete, if there is one."""
        raw, self._raw = self._raw, None
        if raw is None:
            return
        gap = "".join(raw.gap)
        apart = _BREAK.search(self._apart(kinds_of(gap), raw.start + len(raw.text))) is not None
        edge: Ending | None = "paragraph" if apart or last else "sentence" if raw.complete else None
        source = Span(raw.start, raw.start + len(raw.text) + len(gap))
        waiting = (self._marks[index] for index in range(self._marked, len(self._marks)))
        marks = tuple(takewhile(lambda mark: last or mark.at <= source.end, waiting))
        self._marked += len(marks)
        ahead, until = ("", None) if last else (self._text[self._at : self._at + _KEPT], self._letter)
        emotions = self._gatherer.take(raw.text + gap, source, raw.letter, ahead, until)
        sentence = make_sentence(
            raw.text,
            gap,
            raw.start,
            language=self._language,
            poem=self._poem,
            line=raw.line,
            stanza=self._stanza,
            edge=edge,
            marks=marks,
            emotions=emotions,
            told=between(self._knowledge, raw.start, raw.start + len(raw.text)),
        )
        self._line = raw.line + raw.text.count("\n") + gap.count("\n")
        self._stanza += apart
        if sentence:
            yield sentence


def read(
    text: str | Marked,
    *,
    language: str | None = None,
    poem: bool | None = None,
    file: str = "",
    markup: Markup = "auto",
) -> Script:
    """Read a whole text.

    Args:
        text: The text; `decode` makes it from bytes. Or with its markup taken out already, by `marked`.
        language: BCP 47; only the primary language counts. None: what the text's markup says, or English.
        poem: Whether line ends are edges; None: if `is_verse` says so.
        file: Its name, for messages.
        markup: Which markup it has; `auto`: MaryXML or SSML if it begins like that, else inline tags.

    Raises:
        ScriptError: Nothing in it can be spoken, it is too long, no text, or its markup is wrong.
    """
    clean = text if isinstance(text, Marked) else marked(text, markup=markup, language=language, file=file)
    text = clean.text
    language = primary((clean.language or DEFAULT_LANGUAGE) if language is None else language)
    poem = is_verse(text) if poem is None else poem
    reader = Reader(
        language=language, poem=poem, turns=turns_of(text), ends=clean.ends, marks=clean.marks, told=clean.told
    )
    sentences = (*reader.feed(text), *reader.finish())
    marks = [mark for sentence in sentences for mark in hanging(sentence)]
    if not sentences:
        marks = sorted([*clean.marks, *alone(text)], key=lambda mark: mark.at)
    if not sentences and not marks:
        found = "only punctuation and symbols" if text.strip() else "an empty text"
        raise ScriptError(f"nothing to speak: {found}", expected="at least one word or number", file=file)
    return Script(text=text, language=language, poem=poem, sentences=sentences, marks=tuple(marks))
