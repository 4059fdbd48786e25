"""Frames: exact rates, exact times, and what is sampled at them, block by block."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import InputError
from scorebreath.units import GRID

BLOCK = 4096
"""Frames sampled and written at a time: bounds the memory whatever the length."""
HIGHEST = 100_000
"""frames a second"""
Floats = NDArray[np.float64]
Sample = Callable[[Floats], Floats]
"""Times (n,) in seconds to values (n, columns)."""


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


def blocks(sample: Sample, duration: float, fps: Fraction) -> Iterator[tuple[Floats, Floats]]:
    """Frame i at i / fps seconds, i = 0, 1, ..., in blocks.

    Yields:
        Times (n,) in seconds and values (n, columns).

    Raises:
        InputError: The rate is out of range.
    """
    count = frame_count(duration, check_rate(fps))
    for first in range(0, count, BLOCK):
        seconds = np.arange(first, min(first + BLOCK, count)) * fps.denominator / fps.numerator
        yield seconds, sample(seconds)


def blocks_at(sample: Sample, times: Floats) -> Iterator[tuple[Floats, Floats]]:
    """Any moments, (n,) seconds, in blocks like those of `blocks`."""
    for first in range(0, len(times), BLOCK):
        seconds = times[first : first + BLOCK]
        yield seconds, sample(seconds)
