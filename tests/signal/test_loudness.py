"""Loudness against pyloudnorm, true peak against the sine it is of; both whatever the blocks are."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from scorebreath.signal.loudness import NOTHING, LoudnessMeter, TruePeak

pyloudnorm = pytest.importorskip("pyloudnorm", reason="the extra loudness is not installed")


def sound(rate: int, seconds: float, seed: int) -> NDArray[np.float32]:
    """Noise that comes and goes, with silences in it."""
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal(round(seconds * rate))
    level = np.interp(np.linspace(0, 1, len(noise)), np.linspace(0, 1, 12), 10 ** rng.uniform(-4, -0.5, 12))
    return (noise * level).astype(np.float32)


def measured(samples: NDArray[np.float32], rate: int, cuts: list[int]) -> float:
    meter = LoudnessMeter(rate)
    for block in np.split(samples, sorted(cut % (len(samples) + 1) for cut in cuts)):
        meter.add(block)
    return meter.integrated()


@pytest.mark.parametrize("rate", [22050, 44100, 48000, 96000])
@pytest.mark.parametrize("seconds", [0.4, 1.234, 7.77])
def test_it_is_what_pyloudnorm_says(rate: int, seconds: float) -> None:
    samples = sound(rate, seconds, 1)
    wanted = pyloudnorm.Meter(rate).integrated_loudness(samples.astype(np.float64))
    assert measured(samples, rate, []) == pytest.approx(wanted, abs=0.01)


@given(seed=st.integers(0, 99), cuts=st.lists(st.integers(0, 10**6), max_size=8))
def test_blocks_make_no_difference(seed: int, cuts: list[int]) -> None:
    samples = sound(8000, 3.1, seed)
    assert measured(samples, 8000, cuts) == pytest.approx(measured(samples, 8000, []), abs=1e-9)


def test_a_sine_at_1_khz_has_the_loudness_of_the_standard() -> None:
    """BS.1770-4: 0 dBFS at 997 Hz in one channel is -3.01 LKFS."""
    rate = 48000
    sine = np.sin(2 * np.pi * 997 * np.arange(3 * rate) / rate).astype(np.float32)
    assert measured(sine, rate, []) == pytest.approx(-3.01, abs=0.05)


def test_what_cannot_be_told_is_nothing() -> None:
    assert measured(np.zeros(48000, np.float32), 48000, []) == NOTHING
    assert measured(np.ones(100, np.float32), 48000, []) == NOTHING


@pytest.mark.parametrize("cuts", [[], [1], [1000, 1001, 30000]])
def test_a_true_peak_lies_between_the_samples(cuts: list[int]) -> None:
    """A sine at a quarter of the rate, a quarter of a turn on, is never sampled at its top: it is 3 dB higher."""
    rate = 48000
    sine = (0.5 * np.sin(np.pi / 2 * np.arange(rate) + np.pi / 4) * np.hanning(rate)).astype(np.float32)
    assert 20 * np.log10(np.abs(sine).max()) == pytest.approx(-9.03, abs=0.01)
    peak = TruePeak(rate)
    blocks = np.split(sine, cuts)
    for number, block in enumerate(blocks, 1):
        peak.add(block, last=number == len(blocks))
    assert peak.peak_db() == pytest.approx(-6.02, abs=0.05)
