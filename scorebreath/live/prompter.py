"""The prompter: texts in, as they come; breath groups out, one at a time, as soon as they are certain.

The steps are those of `pipeline.compile_text`: tags, sentences, moods, planner. A text that is given whole is planned
as it would be offline. What has not been said yet can be planned anew, with other parameters, from any word on.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace

from scorebreath.compose.models import breathing_model
from scorebreath.ensemble import BODY
from scorebreath.live.markup import Clean, TagStream
from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, Planner, SyllableCounter
from scorebreath.planning.planners import open_planner
from scorebreath.script.dialogue import turns
from scorebreath.script.emotional import Moods
from scorebreath.script.marks import BreathingMark, Mark, ProsodyMark, StateMark, VoiceMark
from scorebreath.script.markup.marked import Marked
from scorebreath.script.model import Sentence
from scorebreath.script.reader import Reader
from scorebreath.script.verse import is_verse
from scorebreath.spans import Span

APART = "\n\n"
"""What stands between two texts in the text of the performance."""
PORTION = 2000
"""Code points of a text that are read at a time."""
NOTHING, SENTENCES, ALL = 0, 1, 2
"""How much of an unfinished text is taken: what is certain; sentences that are over; all there is."""


@dataclass(slots=True, kw_only=True)
class Text:
    """A text on its way."""

    voice: str = ""
    """who says it; empty: whoever began"""
    poem: bool | None = None
    """whether line ends are edges; None: as it looks, if it is whole, else not"""
    waiting: deque[str | Marked] = field(default_factory=deque)
    complete: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """What plans are made with."""

    model: str
    language: str
    parameters: Parameters
    count: SyllableCounter
    seed: int = 0
    cast: Mapping[str, Parameters] = field(default_factory=dict)
    begun: tuple[StateMark, ...] = ()
    """states that the first body begins in"""


class Prompter:
    """Everything that is still to be said.

    Args:
        plan: How to plan.
        said: Told of everything that becomes text of the performance: it goes on where that ended.
        problem: Told in one line what could not be understood.
    """

    def __init__(self, plan: Plan, *, said: Callable[[str], None], problem: Callable[[str], None]) -> None:
        """Nothing to say."""
        self.plan = plan
        self.texts: deque[Text] = deque()
        self._said, self._problem = said, problem
        self._length = 0  # of the performance's text
        self._reader: Reader | None = None
        self._tags = TagStream()
        self._marks: list[Mark] = []  # the reader sees this very list grow
        self._used: dict[type[Mark], Mark] = {}  # kinds of lasting marks met so far, with a neutral one of each
        self._sentences: deque[Sentence | None] = deque()  # read; None: nothing more for now
        self._fed: list[Sentence | None] = []  # given to the planner, and not said yet
        self._over = True  # whether the planner was told that nothing more comes
        self._ready: deque[BreathGroup] = deque()
        self._force: dict[type[Mark], Mark] = {}  # what is in force behind what was said
        self._poem = False
        blend = Blend()
        for mark in plan.begun:
            blend, _ = blend.changed(0.0, mark.name, mark.intensity, mark.ramp, held=mark.held)
        self._planner = self._open(blend, 0.0)
        self._moods = self._new_moods(plan.begun)

    def next(self, flush: int = NOTHING) -> BreathGroup | None:
        """The next breath group, or None: more text is needed.

        Args:
            flush: How much of an unfinished text to take.
        """
        while not self._ready:
            if self._sentences:
                self._plan(self._sentences.popleft())
            elif not self._read(flush):
                return None
        return self._ready.popleft()

    @property
    def idle(self) -> bool:
        """Whether there is nothing left to say, and nothing more announced."""
        return not (self.texts or self._ready or self._sentences) and self._over

    def forget(self, *, blend: Blend, time: float) -> None:
        """Drop all that has not been said."""
        self.texts.clear()
        self._reader = None
        self._sentences.clear()
        self._fed.clear()
        self._ready.clear()
        self._over = True
        self._planner = self._open(blend, time)
        self._moods = self._new_moods()
        self._force.pop(VoiceMark, None)

    def done(self, group: BreathGroup) -> None:
        """A group is being said: it will not be planned again."""
        inside = (mark for word in group.words[:-1] for mark in word.after)
        self._force |= _lasting((*group.before, *inside, *group.after))
        end = group.source.end
        while self._fed and _said(self._fed[0], end):
            del self._fed[0]

    def again(self, place: int, *, plan: Plan, blend: Blend, time: float) -> None:
        """Plan anew what begins at a place of the text, behind what `done` was told of.

        Args:
            place: Of a word's beginning.
            plan: How to plan from now on.
            blend: The body's states.
            time: When it begins, s.
        """
        self.plan = plan
        self._planner = self._open(blend, time)
        starters = self._starters(place)
        rest: list[Sentence | None] = []
        for sentence in self._fed:
            left = sentence and remaining(sentence, place)
            if left is not None and not rest and starters:
                left = replace(left, before=(*starters, *left.before))
            if sentence is None or left is not None:
                rest.append(left)
        self._fed.clear()
        self._ready.clear()
        self._over = True
        self._sentences.extendleft(reversed(rest))

    def _starters(self, place: int) -> list[Mark]:
        """Marks that hold from a place on, and those between it and the word before."""
        force = dict(self._force)
        behind: tuple[Mark, ...] = ()
        for sentence in self._fed:
            if sentence is None or sentence.words[0].source.start >= place:
                continue
            force |= _lasting(sentence.before)
            for word in sentence.words:
                if word.source.start < place:
                    force |= _lasting(word.after)
                    behind = word.after
        return [*force.values(), *(mark for mark in behind if mark not in force.values())]

    def _open(self, blend: Blend, time: float) -> Planner:
        plan = self.plan
        return open_planner(
            plan.model, plan.parameters, plan.language, plan.count, poem=self._poem, blend=blend, time=time,
            seed=plan.seed, body=BODY, cast=plan.cast,
        )  # fmt: skip

    def _new_moods(self, begun: tuple[StateMark, ...] = ()) -> Moods | None:
        share = self.plan.parameters.emotion_breath
        return Moods(share, begun) if breathing_model(self.plan.model).has_states and share > 0.0 else None

    def _plan(self, sentence: Sentence | None) -> None:
        if sentence is None and self._over:
            return
        self._fed.append(sentence)
        self._over = sentence is None
        self._ready.extend(self._planner.finish() if sentence is None else self._planner.feed(sentence))

    def _read(self, flush: int) -> bool:
        """Read some more; whether there was anything."""
        if not self.texts:
            return False
        text = self.texts[0]
        if text.waiting:
            self._take(text, text.waiting.popleft())
            return True
        if text.complete:
            self._finish()
            self.texts.popleft()
            return True
        if flush == ALL and self._reader is not None:
            self._finish()
            return True
        if flush == SENTENCES and not self._over:
            self._settle()
            return True
        return False

    def _take(self, text: Text, piece: str | Marked) -> None:
        if isinstance(piece, Marked):
            self._begin(text, piece)
            for at in range(0, len(piece.text), PORTION):
                self._hear(Clean(piece.text[at : at + PORTION], ()))
            return
        if self._reader is None:
            if not piece.strip():
                return
            self._begin(text, Marked(text=""))
        for clean in self._tags.feed(piece):
            self._hear(clean)

    def _begin(self, text: Text, whole: Marked) -> None:
        """A reader for a new text, or for what goes on behind a place where nothing more came for a while."""
        if self._length:
            self._say(APART)
        start = self._length
        if text.poem is None and whole.text:
            text.poem = is_verse(whole.text)
        self._tags = TagStream(start)
        self._marks = [replace(mark, at=mark.at + start) for mark in whole.marks]
        self._introduce(text.voice, start)
        self._used |= {kind: _NEUTRAL[kind] for kind in _lasting(self._marks)}
        self._reader = Reader(
            language=self.plan.language, poem=bool(text.poem), marks=self._marks, start=start,
            turns=[place + start for place in turns(whole.text)], ends=[place + start for place in whole.ends],
            told=[(place + start, told) for place, told in whole.told],
        )  # fmt: skip
        if bool(text.poem) != self._poem:
            self._poem = bool(text.poem)
            self._planner = self._open(Blend(), 0.0)

    def _introduce(self, voice: str, start: int) -> None:
        """Say whose text begins, and end what the text before has left in force."""
        if voice:
            self._used[VoiceMark] = _NEUTRAL[VoiceMark]
        for kind, neutral in self._used.items():
            mark = replace(neutral, at=start)
            if kind is VoiceMark and voice:
                mark = VoiceMark(at=start, written=f"[voice {voice}]", voice=voice)
            self._marks.insert(0, mark)

    def _hear(self, clean: Clean) -> None:
        if clean.problem:
            self._problem(clean.problem)
        self._marks += clean.marks
        self._used |= {kind: _NEUTRAL[kind] for kind in _lasting(clean.marks)}
        self._say(clean.text)
        if self._reader is not None:
            self._pass_on(self._reader.feed(clean.text))

    def _say(self, text: str) -> None:
        self._length += len(text)
        self._said(text)

    def _pass_on(self, sentences: Iterable[Sentence]) -> None:
        for sentence in sentences:
            self._sentences.extend(self._moods.feed(sentence) if self._moods else (sentence,))

    def _settle(self) -> None:
        """What is read is all, for now."""
        if self._moods:
            self._sentences.extend(self._moods.finish())
        self._sentences.append(None)

    def _finish(self) -> None:
        """The text is over, or nothing more of it came for a while."""
        for clean in self._tags.finish():
            self._hear(clean)
        if self._reader is not None:
            self._pass_on(self._reader.finish())
            self._reader = None
        self._settle()


_NEUTRAL: Mapping[type[Mark], Mark] = {
    VoiceMark: VoiceMark(at=0, written="", voice=""),
    ProsodyMark: ProsodyMark(at=0, written=""),
    BreathingMark: BreathingMark(at=0, written=""),
}


def _lasting(marks: Iterable[Mark]) -> dict[type[Mark], Mark]:
    """The last of each kind that stays in force until the next one."""
    return {type(mark): mark for mark in marks if type(mark) in _NEUTRAL}


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


def _said(sentence: Sentence | None, end: int) -> bool:
    return sentence is None or sentence.words[-1].source.start < end
