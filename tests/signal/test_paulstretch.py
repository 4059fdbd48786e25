"""Stretching: what physiology 9.1 says of it."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from scorebreath.errors import InputError
from scorebreath.signal.paulstretch import paulstretch, stretched_frames, window_frames

RATE = 16000
Floats = NDArray[np.float64]


def noise(seconds: float, seed: int = 1, rate: int = RATE) -> Floats:
    return np.random.default_rng(seed).normal(0, 0.1, round(seconds * rate))


def decibels(samples: NDArray[np.floating[Any]]) -> float:
    return 10 * math.log10(float(np.mean(np.square(np.asarray(samples, dtype=np.float64)))))


def centroid(samples: NDArray[np.floating[Any]], rate: int = RATE) -> float:
    whole = np.asarray(samples, dtype=np.float64)
    frames = whole[: len(whole) // 1024 * 1024].reshape(-1, 1024) * np.hanning(1024)
    power = np.mean(np.abs(np.fft.rfft(frames)) ** 2, axis=0)
    return float(np.sum(power * np.fft.rfftfreq(1024, 1 / rate)) / np.sum(power))


def alike(one: NDArray[Any], two: NDArray[Any]) -> float:
    """Correlation, whatever its sign."""
    return abs(float(np.asarray(np.corrcoef(one, two))[0, 1]))


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 9000), st.floats(1.0, 20.0), st.floats(0.01, 0.2), st.sampled_from([8000, 16000]))
def test_the_length_is_the_fewest_half_windows_that_hold_it(
    frames: int, stretch: float, window: float, rate: int
) -> None:
    made = paulstretch(np.ones(frames), rate, stretch, seed=1, window=window)
    half = window_frames(window, rate) // 2
    assert (
        len(made)
        == stretched_frames(frames, rate, stretch, window)
        == math.ceil(frames / (half / Fraction(stretch))) * half
    )
    assert 0 <= len(made) - stretch * frames < half + 1e-6
    assert np.all(np.isfinite(made))


@settings(max_examples=40, deadline=None)
@given(st.floats(0.005, 0.5), st.integers(1000, 192_000))
def test_windows_fit_a_fast_transform(window: float, rate: int) -> None:
    size = window_frames(window, rate)
    assert size % 2 == 0
    assert size >= max(16, int(window * rate))
    left = size
    for prime in (2, 3, 5):
        while left % prime == 0:
            left //= prime
    assert left == 1


def test_noise_is_as_much_quieter_as_two_windows_make_it() -> None:
    """10 log10(0.4908 * 0.9817) = -3.2 dB."""
    sound = noise(3.0)
    made = paulstretch(sound, RATE, 2.0, seed=3)
    assert decibels(made[RATE:-RATE]) - decibels(sound) == pytest.approx(-3.2, abs=0.5)


@pytest.mark.parametrize("stretch", [2.0, 8.0])
def test_the_colour_stays(stretch: float) -> None:
    coloured = np.convolve(noise(2.0), [1.0, 0.9, 0.7, 0.4, 0.2], "same")
    made = paulstretch(coloured, RATE, stretch, seed=5)
    assert centroid(made) == pytest.approx(centroid(coloured), rel=0.05)


def test_a_tone_stays_a_tone() -> None:
    tone = np.sin(2 * np.pi * 1000 * np.arange(RATE) / RATE)
    made = np.asarray(paulstretch(tone, RATE, 8.0, seed=2, window=0.25), dtype=np.float64)
    power = np.abs(np.fft.rfft(made * np.hanning(len(made)))) ** 2
    hertz = np.fft.rfftfreq(len(made), 1 / RATE)
    assert hertz[np.argmax(power)] == pytest.approx(1000, abs=1.3)
    assert power[np.abs(hertz - 1000) < 20].sum() / power.sum() > 0.99


def test_seeds_make_different_sounds_and_one_seed_the_same() -> None:
    sound = noise(0.6)
    one, same, other = (paulstretch(sound, RATE, 8.0, seed=seed) for seed in (1, 1, 2))
    assert one.tobytes() == same.tobytes()
    assert alike(one, other) < 0.05


def test_no_stretch_leaves_the_length() -> None:
    sound = noise(1.0)
    made = paulstretch(sound, RATE, 1.0, seed=1)
    assert len(sound) <= len(made) < len(sound) + window_frames(0.1, RATE) // 2
    assert made.dtype == np.float32


def test_the_end_fades_and_so_does_the_beginning() -> None:
    made = paulstretch(np.ones(RATE) * noise(1.0), RATE, 4.0, seed=1)
    middle = decibels(made[RATE : 2 * RATE])
    assert decibels(made[:50]) < middle - 15
    assert decibels(made[-50:]) < middle - 10


def test_channels_are_stretched_side_by_side() -> None:
    left, right = noise(0.5, 1), np.zeros(RATE // 2)
    made = paulstretch(np.column_stack((left, right)), RATE, 3.0, seed=4)
    assert made.shape == (stretched_frames(RATE // 2, RATE, 3.0), 2)
    assert np.all(made[:, 1] == 0.0)
    assert decibels(made[:, 0]) > -30
    twice = paulstretch(np.column_stack((left, left)), RATE, 3.0, seed=4)
    assert alike(twice[:, 0], twice[:, 1]) < 0.05, "each channel draws its own phases"


def test_nothing_stretched_is_nothing() -> None:
    assert paulstretch(np.zeros(0), RATE, 3.0, seed=1).shape == (0,)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"stretch": 0.5}, r"stretch=0\.5 must be in \[1, 1000\]"),
        ({"stretch": math.nan}, r"stretch=nan must be in"),
        ({"window": 0.001}, r"window=0\.001 must be in \[0\.005, 10\] s"),
        ({"window": math.inf}, r"window=inf must be in"),
        ({"sample_rate": 0}, r"sample_rate=0 must be above 0"),
        ({"seed": -1}, r"seed=-1 must be at least 0"),
        ({"samples": np.array([0.0, math.nan])}, "finite"),
        ({"samples": np.zeros((2, 2, 2))}, r"shape \(2, 2, 2\)"),
        ({"samples": np.zeros(1_000_000), "stretch": 1000.0}, "at most 268435456 samples"),
    ],
)
def test_what_cannot_be_stretched_is_said(change: dict[str, object], words: str) -> None:
    plain: dict[str, object] = {"samples": np.zeros(100), "sample_rate": RATE, "stretch": 2.0, "seed": 1, "window": 0.1}
    with pytest.raises(InputError, match=words):
        paulstretch(**plain | change)  # type: ignore[arg-type]
