"""Nostrils and mouth while breathing in: trapezoids within the inspiration (B9, X16)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from scorebreath.curves.tracks import TOUCH, Array, Track
from scorebreath.equations.shapes import trapezoid
from scorebreath.errors import ScoreError
from scorebreath.score.events import Inspiration


@dataclass(frozen=True, slots=True)
class FaceShape:
    """One shape's trapezoids, in order of their beginning, lead included."""

    begin: Array
    """(n,) s; onset less lead"""
    end: Array
    """(n,) s; of the inspiration"""
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


def face_shape(inspirations: Track[Inspiration], shape: Literal["mouth", "nostril"]) -> FaceShape:
    """The trapezoids of one shape.

    Raises:
        ScoreError: A lead is longer than an inspiration's reach, or a trapezoid longer than its inspiration.
    """
    for event in inspirations.events:
        _check(event)
    lead = inspirations.column(lambda e: float(getattr(e.lead, shape)))
    begin = inspirations.start - lead
    order = np.argsort(begin, kind="stable")
    begin, end = begin[order], inspirations.end[order]
    open_at_end = np.searchsorted(begin, end, side="right") - np.arange(len(begin))
    maximum = inspirations.column(lambda e: e.mouth_open if shape == "mouth" else e.nostril_flare)
    return FaceShape(
        begin=begin,
        end=end,
        maximum=maximum[order],
        attack=(inspirations.column(lambda e: e.face.attack) + lead)[order],
        hold=inspirations.column(lambda e: e.face.hold)[order],
        release=inspirations.column(lambda e: e.face.release)[order],
        depth=int(open_at_end.max(initial=0)),
    )


def _check(event: Inspiration) -> None:
    face = event.face
    total = face.attack + face.hold + face.release
    if total > event.duration + 2 * TOUCH:
        raise ScoreError(
            f"event {event.id!r}: face attack={face.attack:g}, hold={face.hold:g}, release={face.release:g} must be "
            f"together at most its duration, {event.duration:g} s"
        )
