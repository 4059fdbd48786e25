"""Pitch contours: errors of the tracker do not move them, and few straight lines stand for them (A24)."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from scorebreath.signal.contour import TOLERANCE, melody, stylise

STEP = 0.005
RNG = np.random.default_rng(4)
VALUES = arrays(np.float64, st.integers(1, 80), elements=st.floats(-20.0, 20.0))


def speech(seconds: float = 3.0) -> NDArray[Any]:
    """Hz of somebody who declines and accents twice a second."""
    time = np.arange(round(seconds / STEP)) * STEP
    hertz: NDArray[Any] = 110.0 * np.exp2((4.0 - 1.2 * time + 1.5 * np.sin(4 * np.pi * time)) / 12.0)
    return hertz


def with_gaps(hertz: NDArray[Any], share: float = 0.3) -> NDArray[Any]:
    """The same with unvoiced stretches of 50 ms."""
    unvoiced = np.repeat(RNG.random(len(hertz) // 10 + 1) < share, 10)[: len(hertz)]
    return np.where(unvoiced, 0.0, hertz)


def test_unvoiced_stretches_are_crossed_in_a_straight_line() -> None:
    hertz = np.concatenate((np.full(60, 100.0), np.zeros(40), np.full(60, 141.42135623)))
    found = melody(hertz, STEP)
    middle = found[65:95]
    assert np.allclose(np.diff(middle, 2), 0.0, atol=1e-9)
    assert middle[0] < found[98] and 0.4 < (middle[15] - found[0]) / 6.0 < 0.6
    assert found[0] == pytest.approx(12 * np.log2(100.0))
    assert found[-1] - found[0] == pytest.approx(6.0)


def test_before_the_first_and_behind_the_last_voiced_value_it_stays() -> None:
    found = melody(np.concatenate((np.zeros(30), np.full(30, 200.0), np.zeros(30))), STEP)
    assert np.ptp(found) == pytest.approx(0.0, abs=1e-9)


def test_nothing_voiced_is_level() -> None:
    assert melody(np.zeros(50), STEP).tolist() == [0.0] * 50
    assert melody(np.zeros(0), STEP).size == 0


@pytest.mark.parametrize("factor", [0.5, 2.0, 4.0, 3.0])
def test_errors_of_the_tracker_do_not_move_it(factor: float) -> None:
    """Stretches of up to 50 ms an octave, two octaves or a twelfth off, in one place in ten."""
    clean = with_gaps(speech())
    wrong = clean.copy()
    for start in range(20, len(wrong) - 10, 60):
        wrong[start : start + 6] *= factor
    assert np.abs(melody(wrong, STEP) - melody(clean, STEP)).max() < 1.0
    raw = wrong[(clean > 0) & (wrong != clean)]
    assert raw.size  # there was something to repair


def test_two_values_far_apart_are_all_there_is() -> None:
    found = melody(np.array([100.0, 400.0]), 0.1)
    assert found.tolist() == pytest.approx((12 * np.log2([100.0, 400.0])).tolist())


def test_another_voice_has_the_same_melody() -> None:
    hertz = with_gaps(speech())
    assert np.allclose(melody(hertz * 1.5, STEP) - melody(hertz, STEP), 12 * np.log2(1.5))


def test_accents_survive() -> None:
    """Smoothing takes less than a tenth of movements of accents' length."""
    found, clean = melody(speech(), STEP), 12 * np.log2(speech())
    assert np.abs(found - clean)[10:-10].max() < 0.15


def test_the_blocks_of_a_long_track_meet_without_a_seam() -> None:
    hertz = np.tile(speech(1.0), 30)
    whole, part = melody(hertz, STEP), melody(hertz[3000:5000], STEP)
    assert np.allclose(whole[3100:4900], part[100:1900])


@given(VALUES, st.floats(0.1, 5.0))
def test_a_stylised_contour_misses_nothing_by_more_than_the_tolerance(values: NDArray[Any], tolerance: float) -> None:
    corners = stylise(values, tolerance)
    assert corners[0] == 0 and corners[-1] == len(values) - 1 and (np.diff(corners) > 0).all()
    lines = np.interp(np.arange(len(values)), corners, values[corners])
    assert np.abs(lines - values).max() <= tolerance + 1e-9


@given(VALUES, st.floats(0.1, 5.0))
def test_no_corner_can_be_spared(values: NDArray[Any], tolerance: float) -> None:
    corners = stylise(values, tolerance).tolist()
    for before, after in zip(corners[:-2], corners[2:], strict=True):
        line = np.linspace(values[before], values[after], after - before + 1)
        assert np.abs(line - values[before : after + 1]).max() > tolerance - 1e-9


def test_two_semitones_keep_an_accent_and_leave_a_tremble() -> None:
    time = np.linspace(0.0, 1.0, 201)
    accent = 5.0 * np.exp(-(((time - 0.4) / 0.06) ** 2))
    tremble = 0.5 * np.sin(2 * np.pi * 7 * time)
    corners = stylise(accent + tremble, TOLERANCE)
    assert 3 <= len(corners) <= 6
    assert np.abs(time[corners] - 0.4).min() < 0.03
    assert stylise(tremble, TOLERANCE).tolist() == [0, 200]
