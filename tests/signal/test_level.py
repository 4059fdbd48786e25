"""Level of a sound, step by step and over its speech."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.signal.level import active_db, level_db, sounding, step_edges
from scorebreath.units import FLOOR_DB

RATE = 16000


def sine(seconds: float, amplitude: float, rate: int = RATE) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return amplitude * np.sin(2 * np.pi * 200 * np.arange(round(seconds * rate)) / rate)


def test_a_sine_is_3_db_below_its_peak() -> None:
    levels = level_db(sine(0.1, 0.5), RATE)
    assert len(levels) == 10
    assert levels == pytest.approx([20 * math.log10(0.5 / math.sqrt(2))] * 10, abs=0.011)


def test_silence_is_at_the_floor() -> None:
    assert set(level_db(np.zeros(1000), RATE).tolist()) == {FLOOR_DB}
    assert active_db(np.zeros(1000), RATE) == FLOOR_DB
    assert level_db(np.zeros(0), RATE).size == 0
    assert active_db(np.zeros(0), RATE) == FLOOR_DB


def test_each_value_belongs_to_its_own_step() -> None:
    sound = np.concatenate((np.zeros(320), np.full(160, 0.1), np.zeros(320)))
    assert level_db(sound, RATE).tolist() == [FLOOR_DB, FLOOR_DB, -20.0, FLOOR_DB, FLOOR_DB]


def test_the_last_part_is_measured_over_its_own_length() -> None:
    assert level_db(np.full(170, 0.1), RATE).tolist() == [-20.0, -20.0]


def test_pauses_do_not_lower_the_active_level() -> None:
    speech = sine(0.5, 0.25)
    with_pause = np.concatenate((speech, np.zeros(RATE), speech))
    assert active_db(with_pause, RATE) == active_db(speech, RATE)


def test_the_gate_is_40_db_below_the_loudest_step() -> None:
    loud, heard, lost = (
        np.full(160, 0.5),
        np.full(160, 0.5 * 10 ** (-39.9 / 20)),
        np.full(160, 0.5 * 10 ** (-40.1 / 20)),
    )
    assert active_db(np.concatenate((loud, heard)), RATE) == pytest.approx(-6.02 - 3.01, abs=0.02)
    assert active_db(np.concatenate((loud, lost)), RATE) == pytest.approx(-6.02, abs=0.01)


@given(
    frames=st.integers(0, 30000), rate=st.sampled_from([8000, 11025, 16000, 22050, 44100, 48000]), ms=st.integers(1, 40)
)
def test_steps_cover_the_sound_and_none_is_empty(frames: int, rate: int, ms: int) -> None:
    edges = step_edges(frames, rate, ms / 1000)
    assert edges[0] == 0
    assert edges[-1] == frames
    if frames:
        assert np.diff(edges).min() >= 1
        assert np.abs(edges[:-1] - np.arange(len(edges) - 1) * rate * ms / 1000).max() <= 0.5


@given(st.lists(st.integers(-40, 40), max_size=60), st.integers(0, 30))
def test_sounding_is_the_smallest_range_with_all_that_is_loud(values: list[int], threshold: int) -> None:
    start, end = sounding(np.array(values, dtype=np.int16), threshold)
    loud = [index for index, value in enumerate(values) if abs(value) > threshold]
    assert (start, end) == ((loud[0], loud[-1] + 1) if loud else (0, 0))
