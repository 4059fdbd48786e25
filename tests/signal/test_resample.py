"""Another rate, the same sound, nothing moved in time."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from scorebreath.signal.resample import Resampler, resample
from scorebreath.units import frame_count

RATES = st.sampled_from([8000, 16000, 22050, 24000, 44100, 48000, 96000])


@settings(max_examples=40)
@given(st.integers(0, 3000), RATES, RATES)
def test_the_length_is_rounded(frames: int, source: int, target: int) -> None:
    made = resample(np.zeros(frames, np.float32), source, target)
    assert made.dtype == np.float32
    assert len(made) == frame_count(frames * target / source, 1.0)


@pytest.mark.parametrize(("source", "target"), [(22050, 48000), (16000, 44100), (24000, 48000), (48000, 22050)])
def test_a_tone_stays_where_it_is(source: int, target: int) -> None:
    def tone(rate: int) -> NDArray[np.float32]:
        time = np.arange(rate) / rate
        return np.asarray(np.sin(2 * np.pi * 1000 * time) * np.hanning(rate), np.float32)

    np.testing.assert_allclose(resample(tone(source), source, target), tone(target), atol=2e-4)


def test_at_the_same_rate_it_is_the_same() -> None:
    sound = np.random.default_rng(0).standard_normal(100).astype(np.float32)
    assert resample(sound, 44100, 44100) is sound


def test_it_is_the_same_every_time() -> None:
    sound = np.random.default_rng(0).standard_normal(5000).astype(np.float32)
    np.testing.assert_array_equal(resample(sound, 22050, 48000), resample(sound, 22050, 48000))


@settings(max_examples=40)
@given(st.integers(1, 20_000), RATES, RATES, st.lists(st.floats(0, 1), max_size=8))
def test_in_blocks_it_is_the_same_sound(frames: int, source: int, target: int, cuts: list[float]) -> None:
    sound = np.random.default_rng(frames).uniform(-1, 1, frames).astype(np.float32)
    places = [0, *sorted(int(cut * frames) for cut in cuts), frames]
    blocks = Resampler(source, target)
    made = [blocks.resample(sound[a:b]) for a, b in itertools.pairwise(places)]
    together = np.concatenate([*made, blocks.resample(sound[:0], last=True)])
    whole = resample(sound, source, target)
    shared = min(len(whole), len(together))
    assert abs(len(together) - len(whole)) <= 1
    np.testing.assert_allclose(together[:shared], whole[:shared], atol=1e-6)
