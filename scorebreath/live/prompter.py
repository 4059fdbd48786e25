"""The prompter: texts in, as they come; breath groups out, one at a time, as soon as they are certain.

The steps are those of `pipeline.compile_text`: tags, sentences, moods, planner. A text that is given whole is planned
as it would be offline. What has not been said yet can be planned anew, with other parameters, from any word on, and a
text can be put before others that have begun.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from scorebreath.compose.models import breathing_model
from scorebreath.ensemble import BODY
from scorebreath.live.text import NEUTRAL, Reading, Text, lasting, looks_like_verse, remaining
from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, Planner, SyllableCounter
from scorebreath.planning.planners import open_planner
from scorebreath.script.emotional import Moods
from scorebreath.script.marks import Mark, StateMark, VoiceMark
from scorebreath.script.markup.marked import Marked
from scorebreath.script.model import Sentence

APART = "\n\n"
"""What stands between two texts in the text of the performance."""
NOTHING, SENTENCES, WORDS, ALL = 0, 1, 2, 3
"""How much of an unfinished text is taken: what is certain; sentences that are over; words that are; all there is."""


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


class _Fed(NamedTuple):
    """What the planner was given."""

    text: Text
    sentence: Sentence | None


class Prompter:
    """Everything that is still to be said.

    Args:
        plan: How to plan.
        said: Told of everything that becomes text of the performance: it goes on where that ended.
        problem: Told in one line what could not be understood.
        wordless: Told who is to do what, where a text has no word; by name of a voice.
    """

    def __init__(
        self, plan: Plan, *, said: Callable[[str], None], problem: Callable[[str], None],
        wordless: Callable[[str, tuple[Mark, ...]], None] = lambda voice, marks: None,
    ) -> None:  # fmt: skip
        """Nothing to say."""
        self.plan = plan
        self.texts: deque[Text] = deque()
        """in the order in which they are said; the first one is being planned"""
        self._said, self._problem, self._wordless = said, problem, wordless
        self._length = 0  # of the performance's text
        self._used: dict[type[Mark], Mark] = {}  # kinds of lasting marks met so far, with a neutral one of each
        self._fed: list[_Fed] = []  # given to the planner, and not said yet
        self._over = True  # whether the planner was told that nothing more comes
        self._ready: deque[BreathGroup] = deque()
        self._poem = False
        self._begun = False
        blend = Blend()
        for mark in plan.begun:
            blend, _ = blend.changed(0.0, mark.name, mark.intensity, mark.ramp, held=mark.held)
        self._planner = self._open(blend, 0.0)

    def next(self, flush: int = NOTHING) -> BreathGroup | None:
        """The next breath group, or None: more text is needed.

        Args:
            flush: How much of an unfinished text to take.
        """
        while not self._ready:
            text = self.texts[0] if self.texts else None
            if text is None:
                return None
            if text.sentences:
                self._plan(text, text.next())
            elif text.empty:
                self.texts.popleft()
            elif not self._read(text, flush):
                return None
        return self._ready.popleft()

    @property
    def idle(self) -> bool:
        """Whether there is nothing left to say, and nothing more announced."""
        return not self._ready and self._over and all(text.empty for text in self.texts)

    def forget(self, *, blend: Blend, time: float) -> None:
        """Drop all that has not been said; texts that still come go on being read."""
        kept = [text for text in self.texts if not text.complete]
        for text in kept:
            text.waiting.clear()
            text.sentences.clear()
            text.reading, text.force, text.begun = None, {}, ""
        self.texts = deque(kept)
        self._fed.clear()
        self._ready.clear()
        self._over = True
        self._planner = self._open(blend, time)

    def done(self, group: BreathGroup) -> None:
        """A group has been said: it will not be planned again."""
        end = group.source.end
        while self._fed and ((first := self._fed[0].sentence) is None or first.words[0].source.start < end):
            if first is not None:
                behind = [mark for word in first.words if word.source.start < end for mark in word.after]
                self._fed[0].text.force |= lasting((*first.before, *behind))
                if first.words[-1].source.start >= end:
                    return
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
        self._put_back(place)
        self._planner = self._open(blend, time)

    def prefer(self, voice: str, place: int, *, plan: Plan, blend: Blend, time: float) -> None:
        """Plan what somebody says before everything else, from a place of the text on; others go on behind it."""
        self._used[VoiceMark] = NEUTRAL[VoiceMark]
        self._put_back(place)
        chosen = [text for text in self.texts if text.voice == voice]
        for text in self.texts:
            if text.voice != voice and text.reading is not None:
                text.pause()
        self.texts = deque([*chosen, *(text for text in self.texts if text.voice != voice)])
        self.again(place, plan=plan, blend=blend, time=time)

    def _put_back(self, place: int) -> None:
        """What the planner was given goes back to the texts it is of."""
        behind: dict[int, tuple[Mark, ...]] = {}
        kept: dict[int, list[Sentence | None]] = {}
        texts: list[Text] = []
        for text, sentence in self._fed:
            if id(text) not in kept:
                kept[id(text)] = []
                texts.append(text)
            if sentence is None:
                kept[id(text)].append(None)
                continue
            left = remaining(sentence, place)
            if left is not None:
                kept[id(text)].append(left)
            if left is not sentence:
                before = [word for word in sentence.words if word.source.start < place]
                text.force |= lasting((*sentence.before, *(mark for word in before for mark in word.after)))
                behind[id(text)] = before[-1].after
        for text in reversed(texts):
            text.sentences.extendleft(reversed(kept[id(text)]))
            own = [mark for mark in behind.get(id(text), ()) if mark not in text.force.values()]
            voice = [VoiceMark(at=place, written="", voice=text.voice)] if VoiceMark in self._used else []
            text.starters = [*(voice if VoiceMark not in text.force else []), *text.force.values(), *own]
            if text not in self.texts:
                self.texts.appendleft(text)
        self._fed.clear()
        self._ready.clear()
        self._over = True

    def _open(self, blend: Blend, time: float) -> Planner:
        plan = self.plan
        return open_planner(
            plan.model, plan.parameters, plan.language, plan.count, poem=self._poem, blend=blend, time=time,
            seed=plan.seed, body=BODY, cast=plan.cast,
        )  # fmt: skip

    def _moods(self) -> Moods | None:
        share = self.plan.parameters.emotion_breath
        if not breathing_model(self.plan.model).has_states or share <= 0.0:
            return None
        begun, self._begun = (() if self._begun else self.plan.begun), True
        return Moods(share, begun)

    def _plan(self, text: Text, sentence: Sentence | None) -> None:
        if sentence is None and self._over:
            return
        self._fed.append(_Fed(text, sentence))
        self._over = sentence is None
        self._ready.extend(self._planner.finish() if sentence is None else self._planner.feed(sentence))

    def _read(self, text: Text, flush: int) -> bool:
        """Read some more; whether there was anything."""
        late = text.complete or (flush == ALL and not text.begun.startswith("["))
        if late and text.begun and not text.waiting:
            text.waiting.append("\n")  # nothing more comes of it
        if text.waiting:
            self._take(text, text.waiting.popleft())
        elif text.complete or (flush >= WORDS and text.reading is not None):
            text.pause(word=flush == WORDS)
        elif flush == SENTENCES and (not self._over or (text.reading is not None and text.reading.holds)):
            text.settle()
        else:
            return False
        return True

    def _take(self, text: Text, piece: str | Marked) -> None:
        if isinstance(piece, Marked):
            text.reading = self._begin(text, piece)
            text.sentences.extend(text.reading.whole(piece.text))
        elif text.reading is not None or (text.begun + piece).strip():
            if text.reading is None:
                text.reading = self._begin(text, None)
            piece, text.begun = text.begun + piece, ""
            text.sentences.extend(text.reading.feed(piece))
        if text.reading is not None:
            self._used |= {kind: NEUTRAL[kind] for kind in lasting(text.reading.marks)}

    def _begin(self, text: Text, whole: Marked | None) -> Reading:
        """Begin to read a text, or what goes on behind a place where nothing more had come for a while."""
        if self._length:
            self._say(APART)
        poem = looks_like_verse(text, whole)
        if poem != self._poem:
            self._poem = poem
            self._planner = self._open(Blend(), 0.0)
        return Reading(
            language=self.plan.language, poem=poem, start=self._length, whole=whole, before=self._introduced(text),
            moods=self._moods(), said=self._say, problem=self._problem,
            wordless=lambda marks: self._wordless(text.voice, marks),
        )  # fmt: skip

    def _introduced(self, text: Text) -> list[Mark]:
        """Who speaks, and the end of what the text before has left in force."""
        if text.voice:
            self._used[VoiceMark] = NEUTRAL[VoiceMark]
        marks = {kind: replace(mark, at=self._length) for kind, mark in {**self._used, **text.force}.items()}
        if text.voice and VoiceMark not in text.force:
            marks[VoiceMark] = VoiceMark(at=self._length, written=f"[voice {text.voice}]", voice=text.voice)
        return list(marks.values())

    def _say(self, text: str) -> None:
        self._length += len(text)
        self._said(text)
