"""What must hold of a body's curves in every frame (physiology 10)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.curves.curve_set import CurveSet

FRAME = 0.02
"""s between two frames in which the curves' laws are looked at; also at half of it."""
LONGEST = 86_400.0
"""s; of a longer Score the first day is looked at."""
BLOCK = 1 << 17
"""Frames at once."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Laws:
    """What the curves of a body do from frame to frame."""

    sum_error: float
    """largest |thorax + abdomen - (lungs - rest)|, per cent of the largest excursion from rest"""
    flow: float
    """largest change of volume in a frame over the frame, L/s"""
    ratio: float
    """largest change in half a frame over the largest in a frame"""
    over_flow: float
    """largest change in a frame over what the highest flow around it could move"""


NAMES = ("lung_volume", "thorax_volume", "abdomen_volume", "airflow")


def laws(curves: CurveSet, duration: float, resting: float, capacity: float) -> Laws | None:
    """Look at every frame of a Score; None where nothing moves.

    A take that was cut off does not end at rest: what would be behind its end is nobody's movement.

    Args:
        curves: The body's.
        duration: s.
        resting: Fraction of VC.
        capacity: Vital capacity, L.
    """
    half = FRAME / 2.0
    frames = 2 * int(np.ceil(min(max(duration, FRAME), LONGEST) / FRAME))
    end = np.nextafter(max(duration, FRAME), 0.0)
    error = excursion = whole = halved = 0.0
    over = 0.0
    for first in range(-4, frames + 4, BLOCK):
        times = np.minimum(np.arange(first, min(first + BLOCK, frames + 4) + 3) * half, end)
        volume, thorax, abdomen, flow = curves.sample(times, NAMES).T
        above = volume - resting
        error = max(error, float(np.abs(thorax + abdomen - above).max()))
        excursion = max(excursion, float(np.abs(above).max()))
        halved = max(halved, float(np.abs(np.diff(volume)).max()))
        step = np.abs(volume[2:] - volume[:-2])
        whole = max(whole, float(step.max()))
        around = np.lib.stride_tricks.sliding_window_view(np.pad(np.abs(flow), 1, mode="edge"), 5).max(axis=1)
        possible = np.maximum(around[: len(step)] * FRAME, 1e-9)
        moved = step * capacity > 1e-4  # below a tenth of a millilitre rounding is all there is
        over = max(over, float((step * capacity / possible)[moved].max(initial=0.0)))
    if whole <= 0 or excursion <= 0:
        return None
    return Laws(
        sum_error=100.0 * error / excursion, flow=whole * capacity / FRAME, ratio=halved / whole, over_flow=over
    )
