"""What a performer moves while it sounds: ratios of a body, in lines from one value to the next, without any engine."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from scorebreath.score.cutting import endings
from scorebreath.score.document import Score
from scorebreath.score.performing import Heard, Parameter
from scorebreath.units import snap
from scorebreath_synthdefs.catalogue import HEARD

AS_WRITTEN = Heard()
"""Nothing is moved."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Move:
    """A body's ratios go from one value to another."""

    time: float
    """s from the Score's start"""
    glide: float
    """s"""
    body: str
    before: Heard
    after: Heard
    stay: float = 0.0
    """s afterwards in which an older move would still be under way"""

    @property
    def end(self) -> float:
        """Seconds from the Score's start: nothing moves any more."""
        return self.time + self.glide + self.stay

    def at(self, time: float) -> Heard:
        """What the ratios are then; before its beginning, what they were."""
        if time < self.time:
            return self.before
        if time >= self.time + self.glide:
            return self.after
        share = (time - self.time) / self.glide
        return Heard(
            **{
                route: snap(getattr(self.before, route) * (1 - share) + getattr(self.after, route) * share)
                for route in HEARD
            }
        )

    def controls(self, bus: int) -> dict[str, float]:
        """Settings of the mover that does it."""
        return {
            "bus": float(bus), "glide": self.glide, "stay": self.stay,
            **{f"{route}_from": float(getattr(self.before, route)) for route in HEARD},
            **{route: float(getattr(self.after, route)) for route in HEARD},
        }  # fmt: skip


class Ratios:
    """What every body's ratios are: told of moves in order of time. It grows, so it changes."""

    def __init__(self, moves: Iterable[Move] = ()) -> None:
        """Begin with moves that were made."""
        self._last: dict[str, Move] = {}
        for move in moves:
            self._last[move.body] = move

    def at(self, body: str, time: float) -> Heard:
        """What they are then, after the last move."""
        last = self._last.get(body)
        return AS_WRITTEN if last is None else last.at(time)

    def move(self, *, time: float, body: str, heard: Heard, glide: float) -> Move:
        """From what they are at a time to something else; whatever was on its way stops there.

        Args:
            time: s; of a body, not before its last one.
            body: Whose.
            heard: What they come to.
            glide: s in which they do.
        """
        last = self._last.get(body)
        stay = 0.0 if last is None else max(0.0, snap(last.end - (time + glide)))
        made = Move(time=time, glide=glide, body=body, before=self.at(body, time), after=heard, stay=stay)
        self._last[body] = made
        return made


def moves(score: Score) -> tuple[Move, ...]:
    """All that parameters move while it sounds, in order of time."""
    ends = endings(score.events)
    ratios = Ratios()
    told = [
        event
        for event in score.events
        if isinstance(event, Parameter)
        and event.heard is not None
        and not (event.id in ends and ends[event.id].prevents(event))
    ]
    return tuple(
        ratios.move(time=event.onset, body=event.body, heard=event.heard, glide=event.glide)
        for event in sorted(told, key=lambda event: event.onset)
        if event.heard is not None
    )


def buses(moved: Iterable[Move]) -> Mapping[str, int]:
    """The first control bus of every body that is moved."""
    bodies = sorted({move.body for move in moved})
    return {body: len(HEARD) * place for place, body in enumerate(bodies)}
