"""Makes the events of one face: ids, the grid, and how long movements take."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from scorebreath import chance
from scorebreath.equations.looking import saccade_time
from scorebreath.expression.neck import Turn, fitted
from scorebreath.expression.rules import because
from scorebreath.expression.state import FaceState, Memory
from scorebreath.parameters.faces import Face, face
from scorebreath.score.events import Blink, Brow, Event, Gaze, Head
from scorebreath.units import snap

SHORTEST = 1e-5
"""s; what is shorter is no time."""

LOOKS = ("glance at pause", "search")
"""Rules of gaze that blinks keep away from."""
RECENT = 1.0
"""s for which their onsets are remembered."""


@dataclass(slots=True)
class Actor:
    """A face at work."""

    state: FaceState
    over: float | None = None
    """s when all is over; None: not known yet"""
    memory: Memory = field(init=False)
    face: Face = field(init=False)
    events: list[Event] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Go on where the face is."""
        self.memory = self.state.memory
        self.face = face(self.state.parameters)

    def note(self, **changes: Any) -> None:
        """Remember."""
        self.memory = replace(self.memory, **changes)

    def draws(self, purpose: str, count: int, key: object = "") -> list[float]:
        """Numbers drawn evenly from [0, 1) for one purpose here; the first ones are the same whatever their count."""
        place = f"{self.memory.place}/{key}" if key != "" else self.memory.place
        return [
            float(u) for u in chance.stream(self.state.seed, self.state.body, f"face.{purpose}", place).random(count)
        ]

    def count(self, what: str) -> int:
        """How many of a kind there have been since the group began; one more from now on."""
        number = self.memory.numbers.get(what, 0)
        self.note(numbers=MappingProxyType({**self.memory.numbers, what: number + 1}))
        return number

    def blink(self, onset: float, parts: tuple[float, float, float], closed: float, rule: str, why: str = "") -> None:
        """Both lids close, stay and open, in so many seconds each."""
        close, hold, open_ = (snap(part) for part in parts)
        self._add(
            Blink, "blink", (onset, close + hold + open_), (rule, why), left=snap(closed), right=snap(closed),
            close=close, hold=hold, open=open_,
        )  # fmt: skip

    def brow(self, times: tuple[float, float, float, float], shape: Sequence[float], rule: str, why: str) -> None:
        """Brows: `times` are onset, apex, begin of the way back, end; `shape` left, right, frown."""
        onset, apex, back, end, share = self._in_time(times)
        left, right, frown = (snap(share * min(1.0, max(0.0, value))) for value in shape)
        self._add(
            Brow, "brow", (onset, end - onset), (rule, why), left=left, right=right, frown=frown,
            apex=snap(apex - onset), hold=snap(back - apex),
        )  # fmt: skip

    def head(self, times: tuple[float, float, float, float], pitch: float, roll: float, rule: str, why: str) -> None:
        """The head: `times` as with `brow`; degrees, as far as there is room beside its other movements."""
        onset, apex, back, end, share = self._in_time(times)
        wanted = Turn(onset=onset, apex=apex, back=back, end=end, pitch=share * pitch, roll=share * roll)
        turn = fitted(wanted, self.memory.turns)
        pitch, roll = snap(turn.pitch), snap(turn.roll)
        if pitch == 0.0 and roll == 0.0:
            return
        self.note(turns=(*(other for other in self.memory.turns if other.end > self.state.time), turn))
        self._add(
            Head, "head", (onset, end - onset), (rule, why), pitch=pitch, yaw=0.0, roll=roll,
            apex=snap(apex - onset), hold=snap(back - apex),
        )  # fmt: skip

    def _in_time(self, times: Sequence[float]) -> tuple[float, float, float, float, float]:
        """The times on the grid, and how much of the movement there is time for: it is back when all is over."""
        onset, apex, back, end = (snap(time) for time in times)
        if self.over is None or end <= self.over:
            return onset, apex, back, end, 1.0
        rise, fall, over = apex - onset, end - back, max(self.over, onset + 3 * SHORTEST)
        back = snap(max(onset, over - fall))
        if back < apex:  # no time for both: as much of either as there is
            apex = back = snap(onset + (over - onset) * rise / (rise + fall))
        return onset, apex, back, snap(over), min(1.0, (over - back) / fall)

    def gaze(self, until: float, eyes: tuple[float, float], target: str, rule: str, why: str = "") -> None:
        """The eyes turn, as soon as they are free, and stay until a time."""
        onset, (yaw, pitch) = self.memory.eyes_until, self.memory.eyes
        until = snap(until)
        if until - onset <= SHORTEST:
            return
        length, to = snap(until - onset), (snap(eyes[0]), snap(eyes[1]))
        move = saccade_time(math.hypot(to[0] - yaw, to[1] - pitch))
        if move > length:  # no time to get there
            to, target, move = (yaw, pitch), self.memory.target, 0.0
        self._add(
            Gaze, "gaze", (onset, length), (rule, why), target=target, yaw=to[0], pitch=to[1], from_yaw=yaw,
            from_pitch=pitch, move=snap(move),
        )  # fmt: skip
        self.note(eyes=to, target=target, eyes_until=until)
        if rule in LOOKS:
            kept = tuple(look for look in self.memory.looks if look > self.state.time - RECENT)
            self.note(looks=(*kept, onset))

    def _add(
        self, kind: type[Event], what: str, time: tuple[float, float], rule: tuple[str, str], **values: Any
    ) -> None:  # fmt: skip
        """`time` is onset and length; `rule` its name, and why."""
        number = self.count(what) + 1
        self.events.append(
            kind(
                id=f"{self.memory.group or self.state.body}.{what}{number}", body=self.state.body, onset=snap(time[0]),
                duration=snap(time[1]), group=self.memory.group, rule=because(*rule), **values,
            )
        )  # fmt: skip
