"""Moments that a uniform sampling may miss: the edges of closures, and very short phones (A15, A16)."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.tracks import Array
from scorebreath.units import GRID, snap_array


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
    frames = np.asarray(np.arange(count) * fps.denominator / fps.numerator)
    added = snap_array(np.concatenate([_between(curve_set, number, fps) for number in range(len(curve_set.scenes))]))
    added = np.unique(added[(added >= 0.0) & (added <= duration)])
    beside = added[~np.isin(_micros(added), _micros(frames))]
    return np.sort(np.concatenate([frames, beside]))


def _between(curve_set: CurveSet, number: int, fps: Fraction) -> Array:
    """Moments beside the frames in one of the epochs that cuts make."""
    lips = curve_set.scenes.sources(number).lips
    edges = [lips.closures.begin, lips.closures.end, lips.tucks.begin, lips.tucks.end]
    found = np.concatenate([*edges, _missed(lips.string.phone, fps)])
    begin, end = curve_set.scenes.window(number)
    return np.asarray(found[(found >= begin) & (found < end)])


def _missed(phones: Array, fps: Fraction) -> Array:
    """Middles of the phones into which no frame falls."""
    start, end = phones[:, 0], phones[:, 1]
    frame = np.ceil(start * fps.numerator / fps.denominator) * fps.denominator / fps.numerator
    without = frame >= end
    return np.asarray(((start + end) / 2)[without])


def _micros(times: Array) -> NDArray[np.int64]:
    return np.floor(times * GRID + 0.5).astype(np.int64)
