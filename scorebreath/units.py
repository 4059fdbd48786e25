"""Units: the time grid, decibels, semitones, frames."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

GRID = 1_000_000
"""Steps per unit of every number in a Score: a millionth."""

FLOOR_DB = -80.0
"""The level written for silence, dB."""


def snap(value: float) -> float:
    """The nearest number on the 1e-6 grid, never -0.0.

    >>> snap(0.1 + 0.2), snap(-1e-9)
    (0.3, 0.0)
    """
    return math.floor(value * GRID + 0.5) / GRID + 0.0


def snap_array(values: NDArray[Any]) -> NDArray[np.float64]:
    """`snap` for an array of any shape."""
    return np.asarray(np.floor(np.asarray(values, dtype=np.float64) * GRID + 0.5) / GRID + 0.0, dtype=np.float64)


def decibels(ratio: float) -> float:
    """Amplitude ratio to dB; 0 and below give `FLOOR_DB`.

    >>> decibels(1.0), decibels(0.0)
    (0.0, -80.0)
    """
    return max(FLOOR_DB, 20.0 * math.log10(ratio)) if ratio > 0 else FLOOR_DB


def amplitude(db: float) -> float:
    """Amplitude ratio of a level in dB.

    >>> round(amplitude(-6.0206), 6)
    0.5
    """
    return float(10.0 ** (db / 20.0))


def semitones(hertz: float, reference: float) -> float:
    """Interval from `reference` to `hertz` in semitones.

    >>> semitones(440.0, 220.0)
    12.0
    """
    return 12.0 * math.log2(hertz / reference)


def plain(value: float) -> str:
    """A number as people write it: large ones with all their digits, none with a needless ".0".

    >>> plain(16777216.0), plain(1234567.5), plain(0.25), plain(1e-6)
    ('16777216', '1234567.5', '0.25', '1e-06')
    """
    if abs(value) < 1e6 or not math.isfinite(value):
        return f"{value:g}"
    return f"{value:.0f}" if float(value).is_integer() else repr(float(value))


def frame_count(duration: float, rate: float) -> int:
    """Frames in `duration` seconds at `rate` per second, rounded to the nearest."""
    return math.floor(duration * rate + 0.5)
