"""A pitch track as a melody: without the tracker's errors, through unvoiced stretches, as few straight lines (A24)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

TOLERANCE = 2.0
"""Semitones that a stylised contour may miss the melody by: Praat's own default for stylising pitch."""
OCTAVE = 12.0
"""Semitones."""
STRAY = 8.0
"""Semitones from the melody around it, beyond which a value is an error of the tracker (an octave, a twelfth) rather
than a movement."""
AROUND = 0.4
"""s of voiced speech, the value in its middle, whose median is the melody around it."""
SMOOTHED = 0.02
"""s over which the melody is averaged. More takes away accents: with 0.05 s, a tenth of the turns is lost."""

BLOCK = 4096
"""Values whose medians are looked for together."""


def melody(hertz: NDArray[Any], step: float) -> NDArray[np.float64]:
    """Pitch without gaps.

    Values that stray are left out; they and unvoiced stretches are crossed in a straight line. Before the first voiced
    value and behind the last one it stays where it is.

    Args:
        hertz: (n,) Hz; 0 where unvoiced.
        step: s between two of them.

    Returns:
        (n,) semitones above 1 Hz; all 0 where nothing is voiced.

    >>> melody(np.array([0.0, 100.0, 0.0, 50.0, 100.0, 0.0]), 0.01).round(1).tolist()
    [79.7, 79.7, 79.7, 79.7, 79.7, 79.7]
    """
    hertz = np.asarray(hertz, dtype=np.float64)
    places = np.flatnonzero(hertz > 0)
    if places.size == 0:
        return np.zeros(hertz.size)
    found = OCTAVE * np.log2(hertz[places])
    around = _running_median(found, round(AROUND / step))
    kept = np.abs(found - around) <= STRAY
    if not kept.any():  # two values far apart: their median is neither
        kept[:] = True
    whole = np.interp(np.arange(hertz.size), places[kept], found[kept])
    return _averaged(whole, round(SMOOTHED / step))


def stylise(values: NDArray[Any], tolerance: float = TOLERANCE) -> NDArray[np.intp]:
    """Corners of a polygon through some of the values that misses none by more than a tolerance.

    Lines are divided where they miss most; then every corner goes that can be spared.

    Args:
        values: (n,) at equal steps, n > 0.
        tolerance: In the unit of the values.

    Returns:
        Ascending indices, the first 0 and the last n - 1; none of those between can be left out.

    >>> stylise(np.array([0.0, 1.0, 2.0, 3.0, 2.0, 1.0]), 0.5).tolist()
    [0, 3, 5]
    """
    values = np.asarray(values, dtype=np.float64)
    corners = {0, values.size - 1}
    open_lines = [(0, values.size - 1)]
    while open_lines:
        first, last = open_lines.pop()
        worst, missed = _worst(values, first, last)
        if missed > tolerance:
            corners.add(worst)
            open_lines += [(first, worst), (worst, last)]
    return np.array(_spared(values, sorted(corners), tolerance), dtype=np.intp)


def _spared(values: NDArray[np.float64], corners: list[int], tolerance: float) -> list[int]:
    """The corners that are needed; after one has gone, the one before it may be spared, too."""
    kept: list[int] = []
    for corner in corners:
        while len(kept) > 1 and _worst(values, kept[-2], corner)[1] <= tolerance:
            kept.pop()
        kept.append(corner)
    return kept


def _worst(values: NDArray[np.float64], first: int, last: int) -> tuple[int, float]:
    """Where a straight line misses most, and by how much."""
    if last - first < 2:
        return first, 0.0
    line = np.linspace(values[first], values[last], last - first + 1)
    missed = np.abs(values[first : last + 1] - line)
    worst = int(np.argmax(missed))
    return first + worst, float(missed[worst])


def _running_median(values: NDArray[np.float64], width: int) -> NDArray[np.float64]:
    """Median of the values around each, fewer at the ends; in blocks, so that memory stays bounded."""
    half = max(1, width // 2)
    padded = np.pad(values, half, constant_values=np.nan)
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1)
    counts = np.count_nonzero(~np.isnan(windows), axis=1)
    rows = np.arange(BLOCK)
    medians = np.empty(values.size)
    for at in range(0, values.size, BLOCK):
        ordered = np.sort(windows[at : at + BLOCK], axis=1)  # what is missing comes last
        count, row = counts[at : at + BLOCK], rows[: len(ordered)]
        medians[at : at + BLOCK] = 0.5 * (ordered[row, (count - 1) // 2] + ordered[row, count // 2])
    return medians


def _averaged(values: NDArray[np.float64], width: int) -> NDArray[np.float64]:
    """Averaged over a raised cosine; the ends stay."""
    half = width // 2
    if half < 1:
        return values
    window = np.hanning(2 * half + 3)[1:-1]
    padded = np.pad(values, half, mode="edge")
    return np.convolve(padded, window / window.sum(), mode="valid")
