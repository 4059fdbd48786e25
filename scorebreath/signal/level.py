"""How loud a sound is: its level step by step, its active level, and where it begins and ends."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.units import FLOOR_DB

STEP = 0.01
"""s between two values of a level"""
GATE_DB = -40.0
"""Frames this far below the loudest one do not count as speech (physiology 9.2)."""
DIGITS = 2
"""A level is written to a hundredth of a dB."""


def step_edges(frames: int, sample_rate: float, step: float) -> NDArray[np.int64]:
    """Where each step of a sound begins, and where the last one ends.

    Args:
        frames: Length of the sound.
        sample_rate: Hz.
        step: s.

    Returns:
        (k + 1,) frame numbers from 0 to `frames`; the k steps cover the sound, the last one maybe in part, and each
        holds a frame.

    >>> step_edges(500, 22050, 0.01).tolist()
    [0, 221, 441, 500]
    """
    if frames <= 0:
        return np.zeros(1, dtype=np.int64)
    width = sample_rate * step
    inner = np.floor(np.arange(1, int(frames / width) + 1) * width + 0.5).astype(np.int64)
    return np.concatenate(([0], inner[inner < frames], [frames]))


def level_db(samples: NDArray[Any], sample_rate: float, step: float = STEP) -> NDArray[np.float64]:
    """Root mean square of each step, in dB re full scale.

    Args:
        samples: (n,) floats, full scale 1.
        sample_rate: Hz.
        step: s.

    Returns:
        (k,) one value for each of `step_edges`, the first at half a step; at least `FLOOR_DB`, to a hundredth.
    """
    power = _power(samples, sample_rate, step)
    floor = 10.0 ** (FLOOR_DB / 10)
    return np.asarray(np.round(10.0 * np.log10(np.maximum(power, floor)), DIGITS) + 0.0, dtype=np.float64)


def active_db(samples: NDArray[Any], sample_rate: float, step: float = STEP) -> float:
    """Level of the speech in a sound, pauses left out: the mean power of the steps within `GATE_DB` of the loudest.

    Args:
        samples: (n,) floats, full scale 1.
        sample_rate: Hz.
        step: s.

    Returns:
        dB re full scale, to a hundredth; `FLOOR_DB` for silence (physiology 9.2).
    """
    power = _power(samples, sample_rate, step)
    loudest = float(power.max(initial=0.0))
    if loudest <= 0:
        return FLOOR_DB
    active = power[power >= loudest * 10.0 ** (GATE_DB / 10)]
    return max(FLOOR_DB, round(float(10.0 * np.log10(active.mean())), DIGITS))


def sounding(samples: NDArray[Any], threshold: float) -> tuple[int, int]:
    """The part of a sound between its first and its last sample above a threshold.

    Args:
        samples: (n,)
        threshold: In the samples' own unit.

    Returns:
        Half-open frame range; (0, 0) when nothing is above.

    >>> sounding(np.array([0, 0, 3, 0, -4, 1]), 2)
    (2, 5)
    """
    loud = np.flatnonzero(np.abs(samples) > threshold)
    return (int(loud[0]), int(loud[-1]) + 1) if loud.size else (0, 0)


def _power(samples: NDArray[Any], sample_rate: float, step: float) -> NDArray[np.float64]:
    edges = step_edges(len(samples), sample_rate, step)
    if len(edges) == 1:
        return np.zeros(0, dtype=np.float64)
    squares = np.square(np.asarray(samples, dtype=np.float64))
    return np.asarray(np.add.reduceat(squares, edges[:-1]) / np.diff(edges), dtype=np.float64)
