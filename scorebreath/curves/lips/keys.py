"""Moments that a uniform sampling may miss: the edges of closures, and very short phones (A15, A16)."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.tracks import Array
from scorebreath.units import GRID


def key_times(curve_set: CurveSet, duration: float, fps: Fraction) -> Array:
    """The frames `i / fps` and, beside them, when closures begin and end and the middles of phones between frames.

    Args:
        curve_set: Whose speech.
        duration: s; the last frame is at it or before.
        fps: Frames a second, exact.

    Returns:
        (n,) s, ascending, no two the same on the grid of 1e-6 s. Frames are where a uniform sampling has them, moments
        beside them on the grid.
    """
    count = round(duration * GRID) * fps.numerator // (GRID * fps.denominator) + 1
    return np.asarray(np.arange(count) * fps.denominator / fps.numerator)
