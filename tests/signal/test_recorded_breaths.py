"""A recorded breath is found, brought to its level, and made to last."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from scorebreath.signal import breaths
from scorebreath.signal.breaths import Span
from scorebreath.signal.level import level_db
from tests.signal.recorded import RATE, among, breath, hiss


def decibels(samples: NDArray[Any]) -> float:
    return 10 * math.log10(float(np.mean(np.square(np.asarray(samples, dtype=np.float64)))))


@settings(max_examples=25, deadline=None)
@given(st.floats(0.3, 1.5), st.floats(0.005, 0.9), st.floats(0.0, 2.0))
def test_a_breath_is_found_in_its_recording(seconds: float, amplitude: float, before: float) -> None:
    (span,) = breaths.sounding_spans(among(before, breath(seconds, amplitude), 1.0), RATE)
    begin, end = span.start / RATE - before, span.stop / RATE - before
    assert 0.0 <= begin <= 0.15 * seconds + 0.03
    assert 0.8 * seconds - 0.03 <= end <= seconds + 0.02


def test_sounds_far_apart_are_several_and_the_loudest_counts() -> None:
    recording = among(0.2, breath(0.5, 0.05), 0.7, breath(0.8, 0.2), 0.7, breath(0.5, 0.1, 3), 0.2, breath(0.3, 0.1))
    spans = breaths.sounding_spans(recording, RATE)
    assert len(spans) == 3, "the last two are less than half a second apart"
    assert breaths.loudest(recording, spans) == spans[1]
    assert spans[1].start / RATE == pytest.approx(1.4, abs=0.1)


def test_silence_holds_no_sound() -> None:
    assert breaths.sounding_spans(np.zeros(RATE), RATE) == ()
    assert breaths.sounding_spans(np.zeros(0), RATE) == ()
    assert breaths.sounding_spans(np.full(RATE, 1e-6), RATE) == ()


def test_the_hold_is_the_part_at_least_half_as_loud() -> None:
    """sin^1.66 is a half at 0.458 of a quarter."""
    span = breaths.hold_span(breath(2.0), RATE)
    assert span.start / RATE == pytest.approx(0.458 * 0.8, abs=0.08)
    assert span.stop / RATE == pytest.approx(2.0 - 0.458 * 1.2, abs=0.08)
    assert Span(3, 9).frames == 6


@settings(max_examples=25, deadline=None)
@given(st.floats(0.3, 2.0), st.floats(0.001, 0.9), st.integers(1, 99))
def test_every_hold_comes_out_at_minus_twenty(seconds: float, amplitude: float, seed: int) -> None:
    made, gain = breaths.at_target(breath(seconds, amplitude, seed), RATE)
    assert breaths.hold_db(made, RATE) == pytest.approx(-20.0, abs=0.5)
    assert made.dtype == np.float32
    assert np.abs(made).max() <= 0.9
    assert gain == pytest.approx(-20.0 - breaths.hold_db(breath(seconds, amplitude, seed), RATE))
    assert abs(made[0]) < 1e-2


def test_a_click_moves_no_level_and_is_limited() -> None:
    plain, clicked = breath(0.8, 0.02), breath(0.8, 0.02)
    clicked[5000:5010] = 0.8
    assert breaths.hold_db(clicked, RATE) == pytest.approx(breaths.hold_db(plain, RATE), abs=0.2)
    made, _ = breaths.at_target(clicked, RATE)
    assert np.abs(made).max() <= 10 ** (-1 / 20) + 1e-6


@pytest.mark.parametrize("seconds", [0.21, 0.6, 1.4, 6.0])
def test_a_hold_becomes_five_seconds_of_one_level_and_the_same_colour(seconds: float) -> None:
    held = 0.1 * hiss(seconds) * np.linspace(0.6, 1.2, round(seconds * RATE))
    made, stretch = breaths.sustained(held, RATE, 5.0, seed=1)
    assert len(made) == 5 * RATE
    assert (stretch == 1.0) == (seconds > 5)
    levels = level_db(made, RATE, 0.25)
    assert np.ptp(levels) < 1.5
    assert np.max(np.abs(level_db(made[: RATE // 2], RATE, 0.05) - levels.mean())) < 2.5, "it begins as loud"
    assert np.max(np.abs(level_db(made[-RATE // 2 :], RATE, 0.05) - levels.mean())) < 2.5, "it ends as loud"
    assert centroid(made) == pytest.approx(centroid(held), rel=0.05)


def centroid(samples: NDArray[Any]) -> float:
    power = np.abs(np.fft.rfft(np.asarray(samples, dtype=np.float64))) ** 2
    return float(np.sum(power * np.fft.rfftfreq(len(samples), 1 / RATE)) / np.sum(power))


def test_even_keeps_the_whole_and_what_is_quick() -> None:
    tone = np.sin(2 * np.pi * 200 * np.arange(RATE) / RATE)
    assert breaths.even(tone, RATE) == pytest.approx(tone, abs=0.02)
    swelling = tone * np.linspace(0.2, 1.0, RATE)
    made = breaths.even(swelling, RATE)
    assert decibels(made) == pytest.approx(decibels(swelling), abs=0.3)
    assert np.ptp(level_db(made[2000:-2000], RATE, 0.05)) < 1.0
    assert np.all(np.isfinite(breaths.even(np.zeros(100), RATE)))
