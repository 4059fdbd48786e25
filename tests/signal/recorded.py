"""Breaths as a microphone has them, made of noise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scorebreath.equations.shapes import flow_envelope

RATE = 16000
Floats = NDArray[np.float64]


def hiss(seconds: float, seed: int = 1) -> Floats:
    """Coloured noise of about unit level."""
    return np.asarray(
        np.convolve(np.random.default_rng(seed).normal(0, 1, round(seconds * RATE)), [0.6, 0.6, 0.5], "same"),
        dtype=np.float64,
    )


def breath(seconds: float, amplitude: float = 0.1, seed: int = 1) -> Floats:
    """Noise whose flow rises over 0.4 of its length and falls over the rest."""
    sound = hiss(seconds, seed)
    shape = flow_envelope(np.arange(len(sound)) / RATE, 0.4 * seconds, 0.0, 0.6 * seconds, 1.66)
    return np.asarray(amplitude * shape * sound, dtype=np.float64)


def among(*parts: Floats | float) -> Floats:
    """Sounds, and seconds of near silence."""
    whole = np.concatenate([np.zeros(round(p * RATE)) if isinstance(p, float) else p for p in parts])
    return np.asarray(whole + 1e-4 * hiss(len(whole) / RATE, 99)[: len(whole)], dtype=np.float64)
