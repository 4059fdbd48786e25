"""Nostrils and mouth while breathing: trapezoids within the inspiration (B9, X16), or within an expiration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from scorebreath.curves.tracks import TOUCH, Array
from scorebreath.equations.shapes import trapezoid
from scorebreath.errors import ScoreError
from scorebreath.score.events import Expiration, Inspiration, Trapezoid
from scorebreath.units import snap


@dataclass(frozen=True, slots=True)
class FaceShape:
    """One shape's trapezoids, in order of their beginning, lead included."""

    begin: Array
    """(n,) s; onset less lead"""
    end: Array
    """(n,) s; of the breath"""
    maximum: Array
    """(n,) 0..1"""
    attack: Array
    """(n,) s; lead included"""
    hold: Array
    """(n,) s"""
    release: Array
    """(n,) s"""
    depth: int
    """the most of them under way at once"""

    def sample(self, times: Array) -> Array:
        """The highest of the trapezoids under way at each time, 0 where there is none; shaped like `times`."""
        value = np.zeros(times.shape)
        last = np.searchsorted(self.begin, times, side="right") - 1
        for back in range(self.depth):
            index = np.maximum(last - back, 0)
            since = times - self.begin[index]
            shape = trapezoid(since, self.attack[index], self.hold[index], self.release[index])
            under_way = (last >= back) & (times <= self.end[index])
            value = np.where(under_way, np.maximum(value, self.maximum[index] * shape), value)
        return value


def face_shape(breaths: Sequence[Inspiration | Expiration], shape: Literal["mouth", "nostril"]) -> FaceShape:
    """The trapezoids of one shape: of inspirations with their leads, and of expirations that move the face.

    Args:
        breaths: Of one body, in any order; in those without duration nothing happens.
        shape: Which.

    Raises:
        ScoreError: A trapezoid is longer than its breath.
    """
    rows: list[tuple[float, ...]] = []
    for event in breaths:
        if event.duration <= 0 or event.face is None:
            continue
        _check(event, event.face)
        lead = float(getattr(event.lead, shape)) if isinstance(event, Inspiration) else 0.0
        highest = event.mouth_open if shape == "mouth" else event.nostril_flare
        face = event.face
        rows.append((event.onset - lead, snap(event.end), highest, face.attack + lead, face.hold, face.release))
    table = np.array(sorted(rows), dtype=np.float64).reshape(-1, 6)
    begin, end, maximum, attack, hold, release = table.T.copy()
    open_at_end = np.searchsorted(begin, end, side="right") - np.arange(len(table))
    return FaceShape(
        begin=begin, end=end, maximum=maximum, attack=attack, hold=hold, release=release,
        depth=int(open_at_end.max(initial=0)),
    )  # fmt: skip


def _check(event: Inspiration | Expiration, face: Trapezoid) -> None:
    total = face.attack + face.hold + face.release
    if total > event.duration + 2 * TOUCH:
        raise ScoreError(
            f"event {event.id!r}: face attack={face.attack:g}, hold={face.hold:g}, release={face.release:g} must be "
            f"together at most its duration, {event.duration:g} s"
        )
