"""The bodies of one Score on one clock: whoever does not speak breathes at rest, and every face goes on living."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from scorebreath.compose.models import BreathingModel
from scorebreath.compose.state import BodyState, Spoken
from scorebreath.errors import InputError
from scorebreath.expression.emotion import wordless
from scorebreath.expression.express import express
from scorebreath.expression.state import FaceState, Placed
from scorebreath.media.recordings import Recordings
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup
from scorebreath.score.document import Body, VoiceInfo
from scorebreath.score.events import Blink, Event, Pause
from scorebreath.script.emotional import changed, rest
from scorebreath.script.marks import EmotionMark, Mark, StateMark
from scorebreath.speech.model import Voice
from scorebreath.units import snap

BODY = "body"
"""Id of the body that begins; others are `body2`, `body3`, ..."""


@dataclass(slots=True, kw_only=True)
class Performer:
    """A body of the Score while it is being composed."""

    voice: Voice
    state: BodyState
    face: FaceState
    events: list[Event] = field(default_factory=list)

    def go_on(
        self, done: tuple[BodyState, list[Event]], spoken: Spoken | None = None, felt: tuple[EmotionMark, ...] = ()
    ) -> None:
        """Take what compose has placed, and let the face answer to it and to the emotions of what is spoken."""
        self.state, placed = done
        self.events += placed
        self._express(placed, spoken, felt)

    def feel(self, marks: tuple[EmotionMark, ...]) -> bool:
        """Emotions right behind what it has said; whether it is not too late for them."""
        if not marks or not self.face.waiting:
            return not marks
        *others, last = self.face.waiting
        self.face = replace(self.face, waiting=(*others, replace(last, marks=(*last.marks, *marks))))
        return True

    def keep_from(self, shown: Iterable[Event]) -> None:
        """No blink comes into the way of these winks."""
        winks = tuple((event.onset, event.end) for event in shown if isinstance(event, Blink))
        self.face = replace(self.face, memory=replace(self.face.memory, winks=winks))

    def end(self, time: float) -> None:
        """All is over."""
        self._express([], None, (), over=time)

    def hurry(self) -> None:
        """What it says last is about to begin, and nobody knows what follows: its face decides as if nothing did."""
        self._express([], None, (), hurry=True)

    def _express(
        self, placed: list[Event], spoken: Spoken | None, felt: tuple[EmotionMark, ...], over: float | None = None,
        *, hurry: bool = False,
    ) -> None:  # fmt: skip
        place = spoken.place if spoken else f"rest@{self.state.waits}"
        seen = Placed(events=tuple(placed), place=place, marks=felt, until=self.state.time)
        self.face, shown = express(self.face, seen, over=over, hurry=hurry)
        self.events += shown

    def body(self) -> Body:
        """Who it is, as the Score has it."""
        details = self.voice.details
        return Body(
            id=self.state.body,
            voice=VoiceInfo(
                engine=details.engine,
                voice=details.voice,
                version=details.version,
                licence=details.licence,
                sample_rate=details.sample_rate,
                reference_db=snap(self.voice.reference_db),
            ),
            person=self.state.person,
            parameters=self.state.parameters.set_by_hand(),
        )


@dataclass(slots=True, kw_only=True)
class Ensemble:
    """Everybody who performs one text.

    Voices are known by the name the text calls them; the empty name is whoever begins.
    """

    breathing: BreathingModel
    voice: Voice
    voices: Callable[[str], Voice] | None
    parameters: Parameters
    cast: Mapping[str, Parameters]
    language: str
    seed: int
    recordings: Recordings | None
    clock: float = 0.0
    """s; what is said next begins here"""
    performers: dict[str, Performer] = field(default_factory=dict)
    speaker: Performer | None = None
    """who spoke last"""

    def performer(self, name: str) -> Performer:
        """Who speaks with a voice; somebody new breathes at rest until now.

        Whoever begins is also meant by the whole name of their voice, such as `espeak:en-us` for `espeak`.

        Raises:
            InputError: There is no such voice.
        """
        if name == self.voice.details.voice and name not in self.cast:
            name = ""
        if name not in self.performers:
            who = BODY if not self.performers else f"{BODY}{len(self.performers) + 1}"
            p = self.cast.get(name, self.parameters)
            person = self.breathing.person(p)
            self.performers[name] = Performer(
                voice=self._opened(name) if name else self.voice,
                state=BodyState(
                    body=who, seed=self.seed, parameters=p, person=person, time=0.0, volume=person.resting_volume,
                    recordings=self.recordings, language=self.language,
                ),
                face=FaceState(body=who, seed=self.seed, parameters=p, language=self.language),
            )  # fmt: skip
        return self.performers[name]

    def begin(self, lead: float, marks: tuple[Mark, ...]) -> None:
        """Silence until the first breath; the first body is in the states that the marks put it into."""
        self.clock = snap(lead)
        main = self.performer("")
        main.events.append(_silence("start", 0.0, self.clock))
        main.go_on(self.breathing.act(main.state, marks, "begin"))

    def step(self, spoken: Spoken) -> Performer:
        """Somebody speaks a group; who it is."""
        who = self.performer(spoken.group.voice)
        spoken, before = self._parted(self.speaker, spoken) if self.speaker else (spoken, spoken.group.before)
        self.speaker = who
        who.go_on(self.breathing.rest(who.state, self.clock, "rest"))
        who.go_on(self.breathing.step(who.state, spoken), spoken, emotions_in(spoken.group, before))
        self.clock = who.state.time
        return who

    def _parted(self, last: Performer, spoken: Spoken) -> tuple[Spoken, tuple[Mark, ...]]:
        """Whoever spoke last takes what stands on its side of a group's marks.

        These are the emotions before another voice is named, before the longest of the acts that stand there, or else
        all of them: the face knows what is near (A42). And the states of a body that falls silent.

        Returns:
            What is spoken, without states that are not its body's; and the marks before it whose emotions are its own.
        """
        group = spoken.group
        voice = changed(group.before)
        border = voice or rest(group.before, 0.0)
        left, own = group.before[:border], group.before[border:] if border is not None else ()
        if not last.feel(_emotions(left)) and not voice:
            own = group.before
        if states := tuple(mark for mark in group.before[:voice] if isinstance(mark, StateMark)):
            last.go_on(self.breathing.act(last.state, states, f"leave_{spoken.id.rpartition('.')[2]}"))
            others = (mark for mark in group.before[:voice] if not isinstance(mark, StateMark))
            before = (*others, *group.before[voice:])
            spoken = replace(spoken, group=replace(group, before=before))
        return spoken, own

    def act(self, marks: tuple[Mark, ...]) -> None:
        """The first body does what a text without words asks for."""
        main = self.performer("")
        main.go_on(self.breathing.rest(main.state, self.clock, "rest"))
        main.go_on(self.breathing.act(main.state, marks, "act"))
        felt = [mark for mark in marks if isinstance(mark, EmotionMark)]
        shown = wordless(felt, body=main.state.body, onset=main.state.time)
        if shown:
            main.keep_from(shown)
            main.go_on(self.breathing.rest(main.state, snap(max(event.end for event in shown)), "shown"))
        main.events += shown if main.state.parameters.face_emotion else []

    def finish(self, tail: float) -> float:
        """Everybody comes back to rest, and stays there for so long; the time when all is over, s."""
        everybody = self.performers.values()
        self.clock = max(who.state.time for who in everybody)
        for who in everybody:
            who.go_on(self.breathing.rest(who.state, self.clock, "rest"))
            who.go_on(self.breathing.finish(who.state, snap(tail)))
        end = max(who.state.time for who in everybody)
        self.performer("").events.append(_silence("end", self.clock, snap(end - self.clock)))
        for who in everybody:
            who.go_on(self.breathing.rest(who.state, end, "rest"))
            who.end(end)
        return end

    def events(self) -> Iterator[Event]:
        """What everybody does, body by body."""
        return (event for who in self.performers.values() for event in who.events)

    def _opened(self, name: str) -> Voice:
        if self.voices is None:
            raise InputError(f"the text changes to the voice {name!r}, and nobody opens voices here; pass `voices`")
        try:
            return self.voices(name)
        except InputError as error:
            raise InputError(f"the text changes to the voice {name!r}: {error}") from None


def emotions_in(group: BreathGroup, before: Sequence[Mark]) -> tuple[EmotionMark, ...]:
    """Emotions that the text asks for in and behind a group, and among the marks before it, in its order."""
    inner = (mark for word in group.words[:-1] for mark in word.after)
    return _emotions((*before, *inner, *group.after))


def _emotions(marks: Iterable[Mark]) -> tuple[EmotionMark, ...]:
    return tuple(mark for mark in marks if isinstance(mark, EmotionMark))


def _silence(kind: str, onset: float, duration: float) -> Pause:
    return Pause(
        id=f"{BODY}.{kind}",
        body=BODY,
        onset=onset,
        duration=duration,
        rule=f"silence: {kind}",
        kind="start" if kind == "start" else "end",
    )
