"""Speeds of eyes and lids stay below those of people; blinks come as they are said to."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.equations.looking import (
    BLINK_QUANTILE,
    BLINK_SHORTEST,
    blink_interval,
    blink_limit,
    movement_time,
    saccade_speed,
    saccade_time,
)
from scorebreath.equations.shapes import smooth_step


@given(st.floats(0.01, 40.0))
def test_a_saccade_keeps_to_the_main_sequence(angle: float) -> None:
    length = saccade_time(angle)
    assert length >= 0.021 + 0.0022 * angle
    times = np.linspace(0.0, length, 2001)
    speed = np.abs(np.diff(angle * smooth_step(times / length))).max() / (times[1] - times[0])
    assert speed <= saccade_speed(angle) * 1.0001
    assert saccade_speed(angle) < 500.0


@given(st.floats(0.01, 10.0), st.floats(1.0, 60.0), st.floats(0.01, 1.0))
def test_a_movement_stays_below_its_speed(amount: float, fastest: float, least: float) -> None:
    length = movement_time(amount, fastest, least)
    assert length >= least
    times = np.linspace(0.0, length, 2001)
    assert np.abs(np.diff(amount * smooth_step(times / length))).max() / (times[1] - times[0]) <= fastest * 1.0001


def test_the_limit_is_the_quantile_it_is_called() -> None:
    x = BLINK_QUANTILE
    assert 1.0 - math.exp(-x) * (1.0 + x + x * x / 2.0) == pytest.approx(0.999, abs=1e-8)


def test_blinks_come_on_average_as_asked() -> None:
    draws = np.random.default_rng(0).random((20_000, 3))
    found = np.array([blink_interval(4.8, tuple(row)) for row in draws.tolist()])
    assert found.mean() == pytest.approx(4.8, abs=0.05)
    assert found.std() == pytest.approx(4.8 / math.sqrt(3.0), abs=0.06)
    assert found.min() >= BLINK_SHORTEST and found.max() <= blink_limit(4.8)
