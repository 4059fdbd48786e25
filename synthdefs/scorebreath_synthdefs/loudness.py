"""How loud white noise comes out of a tract, from its transfer function: keeps `level` true when the tract moves."""

from __future__ import annotations

from math import log, pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scorebreath_synthdefs.tracts import Dip, Tract

CALIBRATION_RATE = 48000.0
"""Hz: white noise of one amplitude is louder per hertz at lower rates, so levels are referred to one."""
_POINTS = 2048
_MOVED = tuple(2.0 ** (step / 2) for step in range(-2, 3))  # factors the law is fitted over, half to twice
_GLIDED = (0.8, 0.9, 1.1, 1.2)
_DIGITS = 4

Complex = NDArray[np.complex128]


class Law(NamedTuple):
    """Amplitude of the noise re that of the tract as it stands; x and y are logarithms of scale and brightness.

    `exp(x / 2 + scale x + scale2 x^2 + bright y + bright2 y^2 + both x y)` times `glide factor ** glide`.
    """

    scale: float
    """beside the half that noise power going with bandwidth gives"""
    scale2: float
    bright: float
    bright2: float
    both: float
    glide: float


def law(tract: Tract) -> Law:
    """The law of a tract, fitted to its transfer function within some hundredths of a dB for factors of 0.5 to 2."""
    at_rest = log(amplitude(tract))
    rows, values = [], []
    for scale in _MOVED:
        for brightness in _MOVED:
            x, y = log(scale), log(brightness)
            rows.append([x, x * x, y, y * y, x * y])
            values.append(log(amplitude(tract, scale=scale, brightness=brightness)) - at_rest - x / 2)
    fitted = np.linalg.lstsq(np.array(rows), np.array(values), rcond=None)[0]
    glides = [log(factor) for factor in _GLIDED]
    glided = [log(amplitude(tract, glide=factor)) - at_rest for factor in _GLIDED]
    glide = float(np.dot(glides, glided) / np.dot(glides, glides))
    return Law(*(round(float(number), _DIGITS) for number in (*fitted, glide)))


def amplitude(tract: Tract, *, scale: float = 1.0, brightness: float = 1.0, glide: float = 1.0) -> float:
    """RMS of white noise within -1..1 after the tract, at 48 kHz.

    Args:
        tract: Where it goes through.
        scale: Of resonances and dips.
        brightness: Of resonances, dips and the tilt.
        glide: What the tract's own glide has come to.
    """
    angle = (np.arange(_POINTS) + 0.5) * pi / _POINTS
    delay = np.exp(-1j * angle)  # z^-1
    passed = np.full(_POINTS, 10 ** (tract.floor_db / 20), dtype=np.complex128)
    for index, (frequency, bandwidth, gain_db) in enumerate(tract.resonances):
        moved = frequency * scale * brightness * (glide if index < tract.gliding else 1.0)
        sign = (-1) ** index
        passed += _band(delay, moved, bandwidth / frequency) * (sign * 10 ** (gain_db / 20))
    pole = _radius(2 * tract.tilt * brightness * glide)
    passed *= (1 - pole) / (1 - pole * delay) * _high(delay, tract.highpass)
    for dip in tract.dips:
        passed *= _dip(delay, dip, scale * brightness)
    return sqrt(float(np.mean(np.abs(passed) ** 2)) / 3)


def _band(delay: Complex, frequency: float, reciprocal_of_q: float) -> Complex:
    """SuperCollider's BPF."""
    angle = 2 * pi * frequency / CALIBRATION_RATE
    width = 1 / np.tan(reciprocal_of_q * angle / 2)
    first = 1 / (1 + width)
    below = 1 - 2 * np.cos(angle) * width * first * delay - (1 - width) * first * delay**2
    return np.asarray(first * (1 - delay**2) / below)


def _high(delay: Complex, frequency: float) -> Complex:
    """SuperCollider's HPF."""
    turn = float(np.tan(pi * frequency / CALIBRATION_RATE))
    first = 1 / (1 + sqrt(2) * turn + turn * turn)
    below = 1 - 2 * (1 - turn * turn) * first * delay + (1 - sqrt(2) * turn + turn * turn) * first * delay**2
    return np.asarray(first * (1 - delay) ** 2 / below)


def _dip(delay: Complex, dip: Dip, scale: float) -> Complex:
    cosine = float(np.cos(2 * pi * dip.frequency * scale / CALIBRATION_RATE))
    zero, pole = _radius(dip.zero_bandwidth * scale), _radius(dip.pole_bandwidth * scale)
    above, below = (1 - 2 * radius * cosine * delay + radius**2 * delay**2 for radius in (zero, pole))
    unity = (1 - 2 * pole * cosine + pole**2) / (1 - 2 * zero * cosine + zero**2)
    return np.asarray(unity * above / below)


def _radius(bandwidth: float) -> float:
    return float(np.exp(-pi * bandwidth / CALIBRATION_RATE))
