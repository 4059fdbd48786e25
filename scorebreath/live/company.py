"""The company: the ensemble of a performance, which may be one breath group ahead of what is decided.

A face must know what follows to decide what it does. So the next group is placed on trial while one is decided; whoever
changes their mind before it is its turn takes it back, and it is placed again.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from scorebreath.compose.state import BodyState, Places, Spoken
from scorebreath.ensemble import BODY, Ensemble, Performer
from scorebreath.expression.interrupted import FACE, taken_back
from scorebreath.expression.scene import last_sound
from scorebreath.expression.state import FaceState, Placed
from scorebreath.live.preparing import Prepared
from scorebreath.score.events import Event, Utterance
from scorebreath.script import emoticons
from scorebreath.units import snap

Snapshot = tuple[BodyState, FaceState, float, Performer | None]
"""Of who speaks next: body and face; where the line was, and who spoke last."""


@dataclass(slots=True, kw_only=True)
class Turn:
    """A breath group as it is placed."""

    prepared: Prepared
    spoken: Spoken
    who: Performer
    before: Snapshot
    events: list[Event]
    """of bodies; not yet decided"""
    shown: list[Event]
    """of faces; what begins before this group is decided, whatever becomes of it"""
    announced: bool = False
    """whether something that is decided names it already"""

    @property
    def onset(self) -> float:
        """When its first event begins, s."""
        return min(event.onset for event in self.events)

    def seen_before(self) -> list[Event]:
        """Take what faces have decided up to the group; emotions that only begin with it wait for it."""
        onset = self.onset
        early = [event for event in self.shown if event.group != self.spoken.id or event.onset < onset]
        self.shown = [event for event in self.shown if event.group == self.spoken.id and event.onset >= onset]
        self.announced = any(event.group == self.spoken.id for event in early)
        return early

    @property
    def silent(self) -> float:
        """When its last sound is over, s."""
        said = [event for event in self.events if isinstance(event, Utterance)]
        return last_sound(Placed(events=tuple(said), place="")) if said else self.who.state.time


class Company:
    """Everybody on stage.

    Args:
        ensemble: Not begun.
    """

    def __init__(self, ensemble: Ensemble) -> None:
        """Nothing has been said."""
        self.ensemble = ensemble
        self._places = Places()
        self._number = 0

    @property
    def performers(self) -> tuple[Performer, ...]:
        """Who is there."""
        return tuple(self.ensemble.performers.values())

    def performer(self, voice: str, now: float) -> tuple[Performer, bool]:
        """Who speaks with a voice, and whether they have just come: they begin to breathe now.

        Raises:
            InputError: There is no such voice.
        """
        known = len(self.ensemble.performers)
        who = self.ensemble.performer(voice)
        if len(self.ensemble.performers) == known:
            return who, False
        at = snap(max(0.0, now))
        who.state = replace(who.state, time=at)
        memory = replace(who.face.memory, silent=at, horizon=at, eyes_until=at, place=f"joins@{at}")
        who.face = replace(who.face, time=at, memory=memory)
        return who, True

    def place(self, prepared: Prepared) -> Turn:
        """Place a group behind what was placed last."""
        group, ensemble = prepared.group, self.ensemble
        one = ensemble.performer(group.voice)
        before = one.state, one.face, ensemble.clock, ensemble.speaker
        self._number += 1
        spoken = Spoken(
            group=group, id=f"{BODY}.g{self._number}", place=self._places.key(emoticons.without(group.text)),
            parts=prepared.parts,
        )  # fmt: skip
        who = ensemble.step(spoken)
        made = self.drain()
        return Turn(
            prepared=prepared,
            spoken=spoken,
            who=who,
            before=before,
            events=[event for event in made if not isinstance(event, FACE)],
            shown=[event for event in made if isinstance(event, FACE)],
        )

    def drain(self) -> list[Event]:
        """What has been placed since the last time."""
        made = [event for who in self.performers for event in who.events]
        for who in self.performers:
            who.events.clear()
        return made

    def take_back(self, turn: Turn) -> None:
        """A group of whoever spoke last was not placed after all; what the face has decided until then stands."""
        before, face, clock, speaker = turn.before
        turn.who.face = taken_back(turn.who.face, face.memory.horizon)
        turn.who.state = before
        self.ensemble.clock, self.ensemble.speaker = clock, speaker
        self._places.take_back(emoticons.without(turn.prepared.group.text))
        if not turn.announced:
            self._number -= 1
