"""Peak limiting: below the ceiling nothing happens, above it little, and never twice differently."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from scorebreath.signal.limit import CEILING_DB, PeakLimiter
from scorebreath.units import amplitude

CEILING = amplitude(CEILING_DB)
SOUNDS = st.tuples(st.integers(0, 2**31), st.integers(0, 6000), st.floats(0.01, 3.0))
CUTS = st.lists(st.integers(0, 6000), max_size=8)


def sound(seed: int, length: int, loudness: float) -> NDArray[np.float32]:
    """Noise with bursts."""
    rng = np.random.default_rng(seed)
    swell = 0.1 + (np.sin(np.arange(length) / 300) > 0.8)
    return (rng.standard_normal(length) * loudness * swell).astype(np.float32)


def limited(*blocks: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.concatenate([np.zeros(0, np.float32), *PeakLimiter().limit(blocks)])


@settings(max_examples=50)
@given(SOUNDS, CUTS)
def test_it_is_under_the_ceiling_as_long_as_before_and_the_same_in_any_blocks(
    made: tuple[int, int, float], cuts: list[int]
) -> None:
    whole = sound(*made)
    out = limited(whole)
    assert len(out) == len(whole)
    assert np.abs(out).max(initial=0.0) <= CEILING * (1 + 1e-6)
    np.testing.assert_array_equal(limited(*np.split(whole, sorted(cuts))), out)


@settings(max_examples=50)
@given(SOUNDS)
def test_it_only_takes_away_and_never_turns_a_sign(made: tuple[int, int, float]) -> None:
    whole = sound(*made)
    out = limited(whole)
    assert np.all(np.abs(out) <= np.abs(whole))
    assert np.all(out * whole >= 0)


def test_quiet_sound_passes_bit_for_bit() -> None:
    quiet = np.clip(sound(1, 5000, 1.0), -CEILING, CEILING).astype(np.float32) * np.float32(0.999)
    np.testing.assert_array_equal(limited(quiet), quiet)


def test_far_from_a_peak_nothing_changes() -> None:
    quiet = sound(2, 9000, 0.05)
    loud = quiet.copy()
    loud[4500] = 2.0
    out = limited(loud)
    changed = np.flatnonzero(out != loud)
    assert out[4500] == pytest.approx(CEILING, rel=1e-5)
    assert changed.min() >= 4500 - 1024
    assert changed.max() <= 4500 + 1024


def test_the_gain_is_smooth() -> None:
    """A steady tone shows the gain: no step of it is a click."""
    steady = np.full(9000, 0.1, np.float32)
    steady[4500] = 2.0
    gain = np.delete(limited(steady), 4500) / 0.1
    assert np.abs(np.diff(gain)).max() < 0.005
    assert gain.min() == pytest.approx(CEILING / 2, rel=0.02)


def test_it_says_what_it_found() -> None:
    limiter = PeakLimiter(ceiling_db=-6.0)
    list(limiter.limit([np.array([0.0, -0.9, 0.1], np.float32)]))
    assert limiter.peak == pytest.approx(0.9)
    assert limiter.reduction_db == pytest.approx(6.0 - 0.915, abs=0.01)
    untouched = PeakLimiter()
    list(untouched.limit([np.zeros(3, np.float32)]))
    assert (untouched.peak, untouched.reduction_db) == (0.0, 0.0)
