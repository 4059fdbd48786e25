"""Emotions move the breath (B60): as long as a phrase is spoken with one, the body is in the state that goes with it.

A phrase ends here at punctuation, at a line's end in verse, where MaryXML tells so, and where another voice begins. An
emotion between two phrases holds for both (A42), but for the one it is written beside where a rest is asked for between
them. Of several in a phrase the strongest counts, of equals the last. The
text's own moods come first: where one is in force or set within a phrase, its emotions leave the breath alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from scorebreath.parameters.states import NEUTRAL, find_state
from scorebreath.script import emotions
from scorebreath.script.marks import LONG_PAUSE, Act, EmotionMark, Mark, StateMark, VoiceMark
from scorebreath.script.model import Edge, Script, ScriptWord, Sentence
from scorebreath.script.sentence import hanging
from scorebreath.units import snap

ENDS: frozenset[Edge] = frozenset({"paragraph", "sentence", "semicolon", "comma", "line"})
"""Edges that end a phrase."""


def with_breathing(script: Script, share: float, begun: Sequence[StateMark] = ()) -> Script:
    """A script whose emotions move the breath, too.

    Args:
        script: As read.
        share: How much they move it, 0..1: a state's intensity for a whole emotion; 0: not at all.
        begun: The states that the body is in at the beginning.

    Returns:
        The script with states among its marks: each begins before the first word of its phrase, so that the breath
        before it is part of it, and ends behind the phrase, before another voice is named.
    """
    if share <= 0.0 or not any(isinstance(mark, EmotionMark) for mark in script.marks):
        return script
    sentences = tuple(breathing(script.sentences, share, begun))
    return replace(script, sentences=sentences, marks=tuple(m for one in sentences for m in hanging(one)))


def breathing(sentences: Iterable[Sentence], share: float, begun: Sequence[StateMark] = ()) -> Iterator[Sentence]:
    """The same, sentence by sentence: each is given when the next one is known."""
    moods = Moods(share, begun)
    for sentence in sentences:
        yield from moods.feed(sentence)
    yield from moods.finish()


class Moods:
    """The same, as sentences come.

    Args:
        share: As for `with_breathing`.
        begun: As for `with_breathing`.
    """

    def __init__(self, share: float, begun: Sequence[StateMark] = ()) -> None:
        """Stand before the text."""
        self._walk = _Walk(share=share)
        self._walk.own(begun)
        self._waiting: _Sentence | None = None

    @property
    def waits(self) -> bool:
        """Whether a sentence waits for the one behind it."""
        return self._waiting is not None

    def feed(self, sentence: Sentence) -> list[Sentence]:
        """Take one sentence; give the one before it."""
        here, last = _Sentence(sentence), self._waiting
        self._walk.go(here, last)
        self._waiting = here
        return [last.whole()] if last else []

    def finish(self) -> list[Sentence]:
        """Nothing more comes for now: give what is left, with no state on."""
        last, self._waiting = self._waiting, None
        if last is None:
            return []
        self._walk.end(last)
        return [last.whole()]


def rest(marks: Sequence[Mark], least: float = LONG_PAUSE) -> int | None:
    """Where the silence is that parts some marks: what stands before it belongs to what was said, the others ahead.

    Args:
        marks: All between two words.
        least: s; what is asked for, all in all, is no rest if it is shorter.

    Returns:
        Place of the longest act of them; None: nothing parts them.
    """
    lengths = [(mark.seconds or 0.0, -number) for number, mark in enumerate(marks) if isinstance(mark, Act)]
    return -max(lengths)[1] if lengths and sum(seconds for seconds, _ in lengths) >= least else None


def changed(marks: Sequence[Mark]) -> int:
    """How many of some marks stand before the last change of voice, and that one itself."""
    return max((number for number, mark in enumerate(marks, 1) if isinstance(mark, VoiceMark)), default=0)


def ahead(marks: Sequence[Mark]) -> Sequence[Mark]:
    """Those of the marks between two words that hold for what follows, too."""
    return marks[changed(marks) or rest(marks) or 0 :]


@dataclass(frozen=True, slots=True)
class _Mood:
    """A state, how much of it, and for what."""

    state: str
    intensity: float
    written: str = field(compare=False)


class _Sentence:
    """A sentence whose marks are being added to; place 0 is before its first word, n behind its n-th."""

    def __init__(self, sentence: Sentence) -> None:
        self._sentence = sentence
        self.words = sentence.words
        self.marks = [list(sentence.before), *(list(word.after) for word in sentence.words)]
        self.told = [tuple(marks) for marks in self.marks]
        """as they were"""

    def whole(self) -> Sentence:
        """With all of its marks."""
        words = tuple(
            word if len(marks) == len(word.after) else replace(word, after=tuple(marks))
            for word, marks in zip(self.words, self.marks[1:], strict=True)
        )
        return replace(self._sentence, words=words, before=tuple(self.marks[0]))


@dataclass(slots=True, kw_only=True)
class _Walk:
    """Goes through a text, phrase by phrase."""

    share: float
    moods: dict[str, str] = field(default_factory=dict)
    """by voice: the mood that the text itself has set"""
    voice: str = ""
    now: _Mood | None = None
    """what this walk has set and not ended yet"""
    ahead: list[EmotionMark] = field(default_factory=list)
    """emotions of the phrase before that are this one's as well"""

    def own(self, marks: Iterable[Mark]) -> None:
        """The text itself changes moods and voices."""
        for mark in marks:
            if isinstance(mark, VoiceMark):
                self.voice = mark.voice
            elif isinstance(mark, StateMark):
                row = find_state(mark.name)
                if row.name == NEUTRAL or (not mark.intensity and self.moods.get(self.voice) == row.name):
                    self.moods.pop(self.voice, None)
                elif row.kind == "mood" and mark.intensity:
                    self.moods[self.voice] = row.name

    def go(self, here: _Sentence, last: _Sentence | None) -> None:
        """Take one sentence; what begins with it is told behind the last one's last word."""
        self.ahead += _felt(here.told[0])
        self.own(here.told[0])
        first = 0
        for count, word in enumerate(here.words, 1):
            if count < len(here.words) and not _ends(word):
                continue
            start = last.marks[-1] if last and not first else here.marks[first]
            self._phrase(here, first, count, start)
            first = count

    def _phrase(self, here: _Sentence, first: int, last: int, start: list[Mark]) -> None:
        """The words between two places, and what is told before them."""
        inside, behind = here.told[first + 1 : last], here.told[last]
        voice = next((number for number, mark in enumerate(behind) if isinstance(mark, VoiceMark)), None)
        parted = rest(behind) if voice is None else voice
        here_still = behind if parted is None else behind[:parted]
        felt = [*self.ahead, *(mark for marks in inside for mark in _felt(marks)), *_felt(here_still)]
        free = self.voice not in self.moods and not any(_sets_mood(mark) for marks in inside for mark in marks)
        mood = self._mood(felt) if free else None
        at = here.words[first].source.start
        if self.now and mood is None:
            start.insert(0, _end(self.now, start[0].at if start else at))
        elif mood and mood != self.now:
            start.append(_begin(mood, at))
        self.now = mood
        if self.now and voice is not None:
            here.marks[last].insert(0, _end(self.now, behind[0].at))
            self.now = None
        for marks in (*inside, behind):
            self.own(marks)
        if any(isinstance(mark, StateMark) and find_state(mark.name).name == NEUTRAL for mark in behind):
            self.now = None
        self.ahead = _felt(behind if parted is None else behind[parted:])

    def _mood(self, felt: Sequence[EmotionMark]) -> _Mood | None:
        """The state for the strongest of some emotions."""
        if not felt:
            return None
        best = max(reversed(felt), key=lambda mark: mark.intensity)
        intensity = snap(best.intensity * self.share)
        return _Mood(emotions.rows()[best.name].state, intensity, best.written) if intensity else None

    def end(self, last: _Sentence) -> None:
        """Nothing is left on."""
        if self.now:
            marks = last.marks[-1]
            marks.insert(0, _end(self.now, marks[0].at if marks else last.words[-1].source.end))
            self.now = None


def _ends(word: ScriptWord) -> bool:
    """Whether a phrase ends with a word."""
    told = word.told is not None and word.told.boundary
    return word.edge in ENDS or told or any(isinstance(mark, VoiceMark) for mark in word.after)


def _felt(marks: Iterable[Mark]) -> list[EmotionMark]:
    return [mark for mark in marks if isinstance(mark, EmotionMark)]


def _sets_mood(mark: Mark) -> bool:
    return isinstance(mark, StateMark) and find_state(mark.name).kind == "mood"


def _begin(mood: _Mood, at: int) -> StateMark:
    """At once: the breath that comes next is already of it."""
    return StateMark(at=at, written=mood.written, name=mood.state, intensity=mood.intensity, ramp=0.0)


def _end(mood: _Mood, at: int) -> StateMark:
    return StateMark(at=at, written=mood.written, name=mood.state, intensity=0.0, ramp=0.0)
