"""What moves of parameters do to what sounds already, as gains over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from scorebreath.curves.tracks import Acts, Array
from scorebreath.score.cutting import Ending, never
from scorebreath.score.events import Heard, Parameter
from scorebreath.units import FLOOR_DB

GAINS = ("speech", "mouth", "nose")
"""The columns of gains, fields of `Heard`."""


@dataclass(frozen=True, slots=True)
class Gains:
    """The moves of one body that are heard, in order of time: each goes to its gains in a straight line."""

    start: Array
    """(n,) s, ascending"""
    glide: Array
    """(n,) s"""
    before: Array
    """(n, 3) gains at the start, of GAINS"""
    after: Array
    """(n, 3) gains after the glide"""

    def at(self, times: Array, name: str) -> Array:
        """The gain of one of GAINS at each time, 1 before the first move; (n,)."""
        column = GAINS.index(name)
        found = np.searchsorted(self.start, times, side="right") - 1
        index = np.maximum(found, 0)
        glide = self.glide[index]
        gone = np.where(glide > 0, np.minimum((times - self.start[index]) / np.maximum(glide, 1e-9), 1.0), 1.0)
        begin = self.before[index, column]
        return np.where(found >= 0, begin + (self.after[index, column] - begin) * gone, 1.0)


def gains(score: Acts, body: str, ends: Mapping[str, Ending]) -> Gains | None:
    """The moves of one body that are heard; None where there are none."""
    moves: list[tuple[Parameter, Heard]] = [
        (move, move.heard) for move in score.of(Parameter, body) if move.heard is not None and not never(move, ends)
    ]
    if not moves:
        return None
    moves.sort(key=lambda pair: pair[0].onset)  # of those at once the Score's last one counts
    now = np.ones(len(GAINS))
    before: list[Array] = []
    for place, (move, _) in enumerate(moves):
        if place:
            last, heard = moves[place - 1]
            gone = min((move.onset - last.onset) / last.glide, 1.0) if last.glide > 0 else 1.0
            now = before[-1] + (_of(heard) - before[-1]) * gone
        before.append(now)
    return Gains(
        start=np.array([move.onset for move, _ in moves]),
        glide=np.array([move.glide for move, _ in moves]),
        before=np.array(before),
        after=np.array([_of(heard) for _, heard in moves]),
    )


def _of(heard: Heard) -> Array:
    return np.array([getattr(heard, name) for name in GAINS], dtype=np.float64)


def in_decibels(gain: Array) -> Array:
    """DB of gains, no lower than twice the floor; (n,)."""
    return np.asarray(20.0 * np.log10(np.maximum(gain, 10.0 ** (2 * FLOOR_DB / 20.0))))
