"""Extreme stretching of a sound that has no beat, after Paul Nasca: spectra kept, phases drawn anew (B45)."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import InputError
from scorebreath.units import plain

WINDOW = 0.1
"""s; breaths are stationary for no longer than 0.08-0.15 s (physiology 9.1)"""
WINDOWS = (0.005, 10.0)
"""s, shortest and longest"""
STRETCHES = (1.0, 1000.0)
LONGEST = 1 << 28
"""Samples of a result: 1 GiB"""
FADE = 0.05
"""s over which the input's end fades"""
SMALLEST = 16
POWER = 1.25
"""Of the window 1 - x^2: two of them, half a window apart, have the same power everywhere within 0.11 dB."""

Samples = NDArray[np.float32]


def paulstretch(
    samples: NDArray[Any], sample_rate: float, stretch: float, *, seed: int, window: float = WINDOW
) -> Samples:
    """Make a sound longer without moving its pitch (physiology 9.1).

    Pieces of the input, each multiplied by a window, are overlapped further apart than they were taken, every
    frequency at its amplitude and a random phase. The input's last 50 ms fade to nothing, and the first half window of
    the result fades in. Noise comes out 3.2 dB quieter.

    Args:
        samples: (n,) or (n, channels) floats.
        sample_rate: Hz.
        stretch: How much longer, 1..1000.
        seed: Of the phases, 0 or more; equal arguments give equal bits on one machine.
        window: s, 0.005..10.

    Returns:
        (`stretched_frames`,) or (`stretched_frames`, channels), float32, full scale not enforced.

    Raises:
        InputError: A value is outside its range, a sample is not finite, or the result would be endless.
    """
    given = np.asarray(samples, dtype=np.float64)
    if given.ndim not in (1, 2) or not np.all(np.isfinite(given)):
        raise InputError(f"samples of shape {given.shape} must be finite, (n,) or (n, channels)")
    if seed < 0:
        raise InputError(f"seed={seed} must be at least 0")
    size = window_frames(window, sample_rate)
    half = size // 2
    total = stretched_frames(len(given), sample_rate, stretch, window)
    if total * (given.size // max(1, len(given))) > LONGEST:
        raise InputError(f"stretch={plain(stretch)} makes {total} frames of {len(given)}; at most {LONGEST} samples")
    sound = np.zeros((len(given) + size, *given.shape[1:]))
    sound[: len(given)] = given * _fade(len(given), sample_rate).reshape(-1, *[1] * (given.ndim - 1))
    across = (size, *[1] * (given.ndim - 1))
    shape = ((1.0 - np.linspace(-1.0, 1.0, size) ** 2) ** POWER).reshape(across)
    random = np.random.Generator(np.random.Philox(seed))
    made = np.empty((total, *given.shape[1:]), dtype=np.float32)
    before = np.zeros((half, *given.shape[1:]))
    for number in range(total // half):
        start = int(number * half / stretch)
        spectrum = np.abs(np.fft.rfft(sound[start : start + size] * shape, axis=0))
        phases = random.uniform(0.0, 2.0 * np.pi, spectrum.shape)
        piece = np.fft.irfft(spectrum * np.exp(1j * phases), size, axis=0) * shape
        made[number * half : (number + 1) * half] = piece[:half] + before
        before = piece[half:]
    return made


def window_frames(window: float, sample_rate: float) -> int:
    """Length of the window: the next even number with no prime factor beyond 5, at least 16.

    Raises:
        InputError: A value is outside its range.

    >>> window_frames(0.1, 48000), window_frames(0.0851, 48000), window_frames(0.005, 1000)
    (4800, 4096, 16)
    """
    if not 0 < sample_rate <= 1e6:
        raise InputError(f"sample_rate={plain(sample_rate)} must be above 0 and at most 1000000 Hz")
    if not WINDOWS[0] <= window <= WINDOWS[1]:
        raise InputError(f"window={plain(window)} must be in [{plain(WINDOWS[0])}, {plain(WINDOWS[1])}] s")
    size = max(SMALLEST, int(window * sample_rate))
    while size % 2 or not _smooth(size):
        size += 1
    return size


def stretched_frames(frames: int, sample_rate: float, stretch: float, window: float = WINDOW) -> int:
    """Length of the result: whole half windows, the fewest that hold `stretch * frames`.

    Raises:
        InputError: A value is outside its range.

    >>> stretched_frames(30000, 48000, 8.0)
    240000
    """
    if not (isfinite(stretch) and STRETCHES[0] <= stretch <= STRETCHES[1]):
        raise InputError(f"stretch={plain(stretch)} must be in [{plain(STRETCHES[0])}, {plain(STRETCHES[1])}]")
    half = window_frames(window, sample_rate) // 2
    return ceil(Fraction(stretch) * frames / half) * half


def _smooth(number: int) -> bool:
    for prime in (2, 3, 5):
        while number % prime == 0:
            number //= prime
    return number == 1


def _fade(frames: int, sample_rate: float) -> NDArray[np.float64]:
    gains = np.ones(frames)
    length = min(frames, int(FADE * sample_rate))
    gains[frames - length :] = np.linspace(1.0, 0.0, length)
    return gains
