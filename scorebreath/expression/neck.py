"""How much of a movement the head has room for, beside those that it is in already.

Movements of the head are added up (`curves.looks`). Each alone keeps to its speed; here a new one is made as small as
it must be for the sum to keep to its speed and range as well, whatever rates are set.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from scorebreath.equations.looking import HEAD_LIMIT, HEAD_RANGE
from scorebreath.equations.shapes import Array, rise_and_fall

STEP = 0.004
"""s between the times looked at: speeds in between are less than 0.1 % higher."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Turn:
    """A movement of the head."""

    onset: float
    apex: float
    back: float
    """s; when it begins to come back"""
    end: float
    pitch: float = 0.0
    """degrees"""
    roll: float = 0.0
    """degrees"""

    def course(self, times: Array) -> Array:
        """How far it is at some times, 0..1; (n,)."""
        return rise_and_fall(times - self.onset, self.apex - self.onset, self.back - self.apex, self.end - self.back)


def fitted(turn: Turn, others: Sequence[Turn]) -> Turn:
    """The movement, as much of its pitch and of its roll as there is room for.

    Args:
        turn: What is to come.
        others: What has been decided, itself within the limits; what does not meet the new one changes nothing.
    """
    near = [other for other in others if other.onset < turn.end and turn.onset < other.end]
    if not near:
        return turn
    times = np.arange(turn.onset, turn.end + STEP, STEP)
    course = turn.course(times)
    ways = [(other, other.course(times)) for other in near]
    sizes = []
    for own, taken in (
        (turn.pitch, sum((other.pitch * way for other, way in ways), np.zeros_like(times))),
        (turn.roll, sum((other.roll * way for other, way in ways), np.zeros_like(times))),
    ):
        still = _room(own * course, taken, HEAD_RANGE)
        fast = _room(own * np.diff(course), np.diff(taken), HEAD_LIMIT * STEP)
        sizes.append(own * min(1.0, still, fast))
    return Turn(onset=turn.onset, apex=turn.apex, back=turn.back, end=turn.end, pitch=sizes[0], roll=sizes[1])


def _room(more: Array, taken: Array, limit: float) -> float:
    """How much of `more` can be added to `taken` within -limit to limit, 0 or more."""
    moves = more != 0.0
    free = limit - taken[moves] * np.sign(more[moves])
    return float(max(0.0, np.min(free / np.abs(more[moves]), initial=1.0)))
