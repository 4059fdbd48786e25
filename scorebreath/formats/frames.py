"""Frames: exact rates, exact times, and the curves at them, block by block."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from scorebreath.curves.curve_set import CurveSet
from scorebreath.errors import InputError
from scorebreath.units import GRID

BLOCK = 4096
"""Frames sampled and written at a time: bounds the memory whatever the length."""
HIGHEST = 100_000
"""frames a second"""
Micros = NDArray[np.int64]


def check_rate(fps: Fraction) -> Fraction:
    """The rate itself.

    Raises:
        InputError: It is not above 0 and at most 100,000.
    """
    if not 0 < fps <= HIGHEST:
        raise InputError(f"fps={fps} must be above 0 and at most {HIGHEST}")
    return fps


def frame_count(duration: float, fps: Fraction) -> int:
    """Frames from time 0 to `duration`, both included: what lies past the end is left out.

    >>> frame_count(1.0, Fraction(60)), frame_count(1.0, Fraction(30000, 1001))
    (61, 30)
    """
    return round(duration * GRID) * fps.numerator // (GRID * fps.denominator) + 1


def blocks(
    curve_set: CurveSet, duration: float, fps: Fraction, names: Sequence[str] | None = None
) -> Iterator[tuple[Micros, Micros]]:
    """Frame i at i / fps seconds, i = 0, 1, ..., in blocks.

    Yields:
        Times (n,) and values (n, channels), both in millionths, rounded to the nearest.
    """
    count = frame_count(duration, check_rate(fps))
    for first in range(0, count, BLOCK):
        frames = np.arange(first, min(first + BLOCK, count))
        seconds = frames * fps.denominator / fps.numerator
        values = curve_set.sample(seconds, names)
        yield _micros(seconds), _micros(values)


def _micros(values: NDArray[np.float64]) -> Micros:
    return np.floor(values * GRID + 0.5).astype(np.int64)
