"""Finds breaths and speech in a WAV file, knowing nothing of how they were rendered."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Signal = NDArray[np.float64]
_ORDER = 40
_REACH = 0.012  # s looked at around the onset that is expected
_TELLING = 0.04  # s at either end of a breath that say where it is


@dataclass(frozen=True, slots=True, kw_only=True)
class Shape:
    """A breath as the Score has it, seconds."""

    onset: float
    attack: float
    hold: float
    release: float


def breath_onset(signal: Signal, rate: int, shape: Shape) -> float:
    """The most likely onset, in seconds, of Gaussian noise under the trapezoid in a silence.

    The sound is whitened by a linear prediction learnt from its own hold; its variance at time t is then that of the
    trapezoid squared over a floor (quantisation). The onset is where the likelihood of all samples is highest.
    """
    length = shape.attack + shape.hold + shape.release
    first = int((shape.onset - 2 * _REACH) * rate)
    part = signal[first : int((shape.onset + length + 2 * _REACH) * rate)]
    inside = slice(int((2 * _REACH + shape.attack) * rate), int((2 * _REACH + shape.attack + shape.hold) * rate))
    white = whitened(part, part[inside])
    power = white**2
    loud = float(power[inside].mean())
    floor = max(loud * 1e-12, float(np.median(power[: int(_REACH * rate)])))
    time = (np.arange(len(part)) + first) / rate
    edge = int((2 * _REACH + _TELLING) * rate)  # further in, a shift changes next to nothing
    ends = np.r_[:edge, max(edge, len(part) - edge) : len(part)]
    time, power = time[ends], power[ends]

    def unlikeliness(onset: float) -> float:
        since = time - onset
        gain = np.clip(np.minimum(since / shape.attack, (length - since) / shape.release), 0.0, 1.0)
        variance = loud * gain**2 + floor
        return float(np.sum(np.log(variance) + power / variance))

    best = shape.onset
    for span, step in ((_REACH, 4e-4), (5e-4, 5e-5), (6e-5, 5e-6)):
        tried = best + np.arange(-span, span + step / 2, step)
        best = float(tried[np.argmin([unlikeliness(onset) for onset in tried])])
    return best


def whitened(signal: Signal, example: Signal) -> Signal:
    """The signal through the prediction-error filter of an example (autocorrelation method)."""
    lags = np.array([np.dot(example[: len(example) - lag], example[lag:]) for lag in range(_ORDER + 1)])
    lags[0] *= 1 + 1e-9
    square = lags[np.abs(np.subtract.outer(np.arange(_ORDER), np.arange(_ORDER)))]
    predictor = np.linalg.solve(square, lags[1:])
    return np.convolve(signal, np.concatenate(([1.0], -predictor)))[: len(signal)]


def lag(signal: Signal, template: Signal, expected: int, reach: int = 400) -> int:
    """Frames by which the template lies later than expected, by cross-correlation."""
    around = signal[expected - reach : expected + len(template) + reach]
    size = 1 << (len(around) + len(template)).bit_length()
    spectrum = np.fft.rfft(around, size) * np.conj(np.fft.rfft(template, size))
    return int(np.argmax(np.fft.irfft(spectrum, size)[: 2 * reach + 1])) - reach


def level_db(signal: Signal) -> float:
    """RMS, dB re full scale."""
    return float(10 * np.log10(np.mean(signal**2)))


def within(signal: Signal, rate: int, start: float, seconds: float) -> Signal:
    return signal[int(start * rate) : int((start + seconds) * rate)]


def mean_square(parts: Sequence[Signal]) -> float:
    return float(np.mean([np.mean(part**2) for part in parts]))
