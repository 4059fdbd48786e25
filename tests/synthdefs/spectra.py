"""Measures of a breath's spectrum and the windows they must lie in: physiology 3.5."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.signal import welch

from scorebreath_synthdefs import Kind
from tests.engine.listening import Signal


def measures(signal: Signal) -> dict[str, float]:
    """Welch 4096, 0.1..12 kHz, at 48 kHz; of several sounds (n, frames) the mean power."""
    frequency, power = welch(np.atleast_2d(signal), 48000, nperseg=4096)
    power = power.mean(axis=0)
    heard = (frequency >= 100) & (frequency <= 12000)
    frequency, power = frequency[heard], power[heard]
    share = np.cumsum(power) / power.sum()

    def band(low: float, high: float) -> float:
        return float(10 * np.log10(power[(frequency >= low) & (frequency < high)].sum() / power.sum()))

    sloping = (frequency >= 1000) & (frequency <= 8000)
    slope = np.polyfit(np.log2(frequency[sloping]), 10 * np.log10(power[sloping]), 1)[0]
    return {
        "centroid": float((frequency * power).sum() / power.sum()),
        "median": float(frequency[np.searchsorted(share, 0.5)]),
        "roll-off": float(frequency[np.searchsorted(share, 0.85)]),
        "0.1-1": band(100, 1000),
        "1-3": band(1000, 3000),
        "3-6": band(3000, 6000),
        "6-12": band(6000, 12001),
        "slope": float(slope),
        "flatness": float(np.exp(np.log(power).mean()) / power.mean()),
    }


MOUTH_WINDOWS = {
    "centroid": (1100, 2400), "median": (900, 2200), "roll-off": (1800, 4000), "0.1-1": (-6, -2), "1-3": (-5, -2),
    "3-6": (-16, -6), "6-12": (-99, -12), "slope": (-9, -4), "flatness": (0.08, 0.35),
}  # fmt: skip
NOSE_WINDOWS = {
    "centroid": (2200, 3800), "median": (1800, 3600), "roll-off": (3300, 6000), "0.1-1": (-12, -4), "1-3": (-8, -2),
    "3-6": (-6, -1.5), "6-12": (-99, -10), "slope": (-5, -1), "flatness": (0.2, 0.45),
}  # fmt: skip
WINDOWS: dict[Kind, dict[str, tuple[float, float]]] = {"mouth": MOUTH_WINDOWS, "nose": NOSE_WINDOWS}


def outside(found: Mapping[str, float], kind: Kind) -> dict[str, object]:
    """What lies outside the windows of a kind."""
    return {
        name: (round(found[name], 2), window)
        for name, window in WINDOWS[kind].items()
        if not window[0] <= found[name] <= window[1]
    }


def above_trend(signal: Signal) -> tuple[Signal, Signal]:
    """Frequencies of 0.2..8 kHz, and how far the power there is above its trend, dB: a straight line over octaves."""
    frequency, power = welch(np.atleast_2d(signal), 48000, nperseg=1024)
    used = (frequency >= 200) & (frequency <= 8000)
    octave, db = np.log2(frequency[used]), 10 * np.log10(power.mean(axis=0)[used])
    return frequency[used], db - np.polyval(np.polyfit(octave, db, 1), octave)
