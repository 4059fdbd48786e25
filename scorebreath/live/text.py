"""One text on its way: tags, sentences, moods, as it comes."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace

from scorebreath.live.markup import TagStream
from scorebreath.script.dialogue import turns
from scorebreath.script.emotional import Moods
from scorebreath.script.gathering import alone
from scorebreath.script.marks import BreathingMark, Mark, ProsodyMark, VoiceMark
from scorebreath.script.markup.marked import Marked
from scorebreath.script.model import Sentence
from scorebreath.script.reader import Reader
from scorebreath.script.verse import is_verse
from scorebreath.spans import Span

PORTION = 2000
"""Code points of a text that are read at a time."""

NEUTRAL: Mapping[type[Mark], Mark] = {
    VoiceMark: VoiceMark(at=0, written="", voice=""),
    ProsodyMark: ProsodyMark(at=0, written=""),
    BreathingMark: BreathingMark(at=0, written=""),
}
"""Kinds of marks that stay in force until the next one, each with one that takes all back."""


@dataclass(slots=True, kw_only=True)
class Text:
    """What somebody says, whole or in pieces. It is read as it comes, so it changes."""

    voice: str = ""
    """who says it; empty: whoever began"""
    poem: bool | None = None
    """whether line ends are edges; None: as it looks, if it is whole, else not"""
    waiting: deque[str | Marked] = field(default_factory=deque)
    """not read yet"""
    complete: bool = False
    """whether nothing more comes"""
    sentences: deque[Sentence | None] = field(default_factory=deque)
    """read, but not planned; None: nothing more comes for now"""
    force: dict[type[Mark], Mark] = field(default_factory=dict)
    """lasting marks behind what has been said of it"""
    starters: list[Mark] = field(default_factory=list)
    """marks to stand before its next sentence"""
    reading: Reading | None = None
    begun: str = ""
    """the beginning of a tag or of a word, which waits for its end"""

    @property
    def empty(self) -> bool:
        """Whether all of it has been planned."""
        return self.complete and not (self.waiting or self.sentences or self.begun) and self.reading is None

    def next(self) -> Sentence | None:
        """The next sentence that has been read."""
        sentence = self.sentences.popleft()
        if sentence is not None and self.starters:
            sentence = replace(sentence, before=(*self.starters, *sentence.before))
            self.starters = []
        return sentence

    def pause(self, *, word: bool = False) -> None:
        """Nothing more of it comes for now: all that is read counts.

        Args:
            word: Whether a word that may not be whole waits for its end; the beginning of a tag does in any case.
        """
        if self.reading is not None:
            if not self.complete:
                self.begun = self.reading.keep(word=word)
            self.sentences.extend(self.reading.finish())
            self.reading = None
        self.sentences.append(None)

    def settle(self) -> None:
        """The sentences that are read count, whatever follows."""
        if self.reading is not None:
            self.sentences.extend(self.reading.settle())
        self.sentences.append(None)


class Reading:
    """A stretch of a text that is read in one go.

    Args:
        language: BCP 47.
        poem: Whether line ends are edges.
        start: Its place in the text of the performance.
        whole: All of it; None: it comes in pieces.
        before: Marks at its very beginning.
        moods: Lets emotions move the breath; None: they do not.
        said: Told of its text without tags.
        problem: Told what could not be understood.
        wordless: Told, if there is no word in it, of the acts and emotions that are.
    """

    def __init__(
        self,
        *,
        language: str,
        poem: bool,
        start: int,
        whole: Marked | None,
        before: Iterable[Mark],
        moods: Moods | None,
        said: Callable[[str], None],
        problem: Callable[[str], None],
        wordless: Callable[[tuple[Mark, ...]], None] = lambda _: None,
    ) -> None:
        """Nothing is read yet."""
        clean = whole or Marked(text="")
        self._tags = TagStream(start)
        self.marks: list[Mark] = [*before, *(replace(mark, at=mark.at + start) for mark in clean.marks)]
        self._reader = Reader(
            language=language, poem=poem, marks=self.marks, start=start,
            turns=[place + start for place in turns(clean.text)], ends=[place + start for place in clean.ends],
            told=[(place + start, told) for place, told in clean.told],
        )  # fmt: skip
        self._moods, self._said, self._problem, self._wordless = moods, said, problem, wordless
        self._silent: str | None = ""  # what was read, as long as there was no word in it
        self._introduced, self._start = len(self.marks) - len(clean.marks), start

    def keep(self, *, word: bool) -> str:
        """Take out the beginning of a tag or of a word at the end of what came."""
        return self._tags.keep(word=word)

    def whole(self, text: str) -> list[Sentence]:
        """All of it, without tags."""
        found: list[Sentence] = []
        for at in range(0, len(text), PORTION):
            found += self._read(text[at : at + PORTION])
        return found

    def feed(self, piece: str) -> list[Sentence]:
        """A piece, with tags; the sentences that are certain now."""
        return [sentence for clean in self._tags.feed(piece) for sentence in self._hear(*clean)]

    @property
    def holds(self) -> bool:
        """Whether a sentence waits for the next one's mood."""
        return self._moods is not None and self._moods.waits

    def settle(self) -> list[Sentence]:
        """Sentences that waited for the next one's mood."""
        return self._moods.finish() if self._moods else []

    def finish(self) -> list[Sentence]:
        """All that is left."""
        left = [sentence for clean in self._tags.finish() for sentence in self._hear(*clean)]
        last = self._reader.finish()
        if self._silent is not None and not last:
            own = self.marks[self._introduced :]
            felt = (replace(mark, at=mark.at + self._start) for mark in alone(self._silent))
            if marks := tuple(sorted((*own, *felt), key=lambda mark: mark.at)):
                self._wordless(marks)
        return [*left, *self._moody(last), *self.settle()]

    def _hear(self, text: str, marks: tuple[Mark, ...], problem: str) -> list[Sentence]:
        if problem:
            self._problem(problem)
        self.marks += marks  # the reader sees this very list grow
        return self._read(text)

    def _read(self, text: str) -> list[Sentence]:
        self._said(text)
        found = self._reader.feed(text)
        if self._silent is not None:
            self._silent = None if found or len(self._silent) > PORTION else self._silent + text
        return self._moody(found)

    def _moody(self, sentences: Iterable[Sentence]) -> list[Sentence]:
        if self._moods is None:
            return list(sentences)
        return [moved for sentence in sentences for moved in self._moods.feed(sentence)]


def lasting(marks: Iterable[Mark]) -> dict[type[Mark], Mark]:
    """The last of each kind that stays in force until the next one."""
    return {type(mark): mark for mark in marks if type(mark) in NEUTRAL}


def looks_like_verse(text: Text, whole: Marked | None) -> bool:
    """Whether line ends are edges."""
    if text.poem is None and whole is not None:
        text.poem = is_verse(whole.text)
    return bool(text.poem)


def remaining(sentence: Sentence, place: int) -> Sentence | None:
    """What is left of a sentence from a place on; None: nothing."""
    words = tuple(word for word in sentence.words if word.source.start >= place)
    if not words:
        return None
    if len(words) == len(sentence.words):
        return sentence
    start = words[0].source.start
    text = sentence.text[start - sentence.source.start :]
    return replace(sentence, source=Span(start, sentence.source.end), text=text, words=words, before=())
