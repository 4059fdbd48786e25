"""Spectra of breaths, by Welch's method, from 0.1 to 12 kHz (physiology 3.5)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SEGMENT = 4096
"""Samples of a segment at 48 kHz; at another rate as many as last as long."""
LOWEST, HIGHEST = 100.0, 12_000.0
"""Hz; what lies outside is not looked at."""
BANDS = ((100.0, 1000.0), (1000.0, 3000.0), (3000.0, 6000.0), (6000.0, 12_000.0))
"""Hz"""
ROLL_OFF = 0.85
SILENT_DB = -100.0
"""Of a band that holds nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Spectrum:
    """Of several sounds."""

    centroid: Array
    """(n,) Hz; mean frequency, weighted by power"""
    median: Array
    """(n,) Hz; half of the power lies below it"""
    roll_off: Array
    """(n,) Hz; 85 % of the power lies below it"""
    bands: Array
    """(n, 4) dB; each of BANDS relative to all of it"""


def spectrum(sounds: Sequence[Array], rate: float) -> Spectrum:
    """Measure each sound.

    Args:
        sounds: Samples (n,) each, none of them silent.
        rate: Hz; below 24 kHz nothing is measured, as part of the range is missing.
    """
    heard = sounds if rate >= 2 * HIGHEST else []
    rows = [_measured(sound, rate) for sound in heard]
    table = np.array(rows, dtype=np.float64).reshape(-1, 3 + len(BANDS))
    return Spectrum(centroid=table[:, 0], median=table[:, 1], roll_off=table[:, 2], bands=table[:, 3:])


def _measured(sound: Array, rate: float) -> tuple[float, ...]:
    frequency, power = density(sound, rate)
    inside = (frequency >= LOWEST) & (frequency <= HIGHEST)
    frequency, power = frequency[inside], power[inside]
    total = power.sum()
    if not total > 0:
        return (np.nan,) * (3 + len(BANDS))
    share = np.cumsum(power) / total
    shares = [power[(frequency >= low) & (frequency < high)].sum() / total for low, high in BANDS]
    return (
        float((frequency * power).sum() / total),
        float(np.interp(0.5, share, frequency)),
        float(np.interp(ROLL_OFF, share, frequency)),
        *(10.0 * np.log10(max(part, 10.0 ** (SILENT_DB / 10))) for part in shares),
    )


def density(sound: Array, rate: float) -> tuple[Array, Array]:
    """Power of a sound at each frequency: Hann windows that overlap by half, their power spectra averaged.

    A sound shorter than a window is one window.

    Args:
        sound: (n,)
        rate: Hz.

    Returns:
        Frequencies, Hz, and power in any unit; (k,) each.
    """
    length = min(len(sound), round(SEGMENT * rate / 48_000.0))
    window = np.hanning(length + 2)[1:-1]
    pieces = np.lib.stride_tricks.sliding_window_view(sound, length)[:: max(1, length // 2)]
    power = np.square(np.abs(np.fft.rfft(pieces * window, axis=1))).mean(axis=0)
    return np.asarray(np.fft.rfftfreq(length, 1.0 / rate), dtype=np.float64), power
