"""Pitch on a regular grid."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from scorebreath.signal import pitch
from scorebreath.signal.level import step_edges
from scorebreath.signal.pitch import STEP, on_grid, pitch_hertz


def tone(hertz: NDArray[np.float64], rate: int) -> NDArray[np.float64]:
    """A buzz that follows a pitch given for each frame."""
    phase = 2 * np.pi * np.cumsum(hertz) / rate
    return np.asarray(0.3 * sum(np.sin(k * phase) / k for k in range(1, 6)), dtype=np.float64)


@pytest.mark.parametrize("rate", [16000, 22050, 24000, 48000])
@pytest.mark.parametrize("seconds", [0.0613, 0.2, 0.7301])
def test_praat_finds_its_frames_on_the_grid(rate: int, seconds: float) -> None:
    """A glide of 200 Hz/s: half a step beside the grid would be 0.5 Hz off."""
    frames = round(seconds * rate)
    glide = 120 + 200 * np.arange(frames) / rate
    found = pitch_hertz(tone(glide, rate), rate)
    assert len(found) == len(step_edges(frames, rate, STEP)) - 1
    times = (np.arange(len(found)) + 0.5) * STEP
    inner = slice(6, len(found) - 6) if len(found) > 20 else slice(5, len(found) - 5)
    assert found[inner] == pytest.approx(120 + 200 * times[inner], abs=0.3)


def test_silence_and_noise_have_no_pitch() -> None:
    noise = np.random.default_rng(1).normal(0, 0.1, 8000)
    assert np.count_nonzero(pitch_hertz(np.zeros(8000), 16000)) == 0
    assert np.count_nonzero(pitch_hertz(noise, 16000)) < 0.1 * 100


def test_a_sound_shorter_than_the_window_is_no_error() -> None:
    assert pitch_hertz(np.zeros(3), 16000).tolist() == [0.0]
    assert pitch_hertz(np.zeros(0), 16000).tolist() == []


def test_the_floor_can_be_lowered_for_a_deep_voice() -> None:
    deep = tone(np.full(8000, 60.0), 16000)
    assert np.median(pitch_hertz(deep, 16000, floor=50)) == pytest.approx(60, abs=0.5)
    assert np.count_nonzero(np.abs(pitch_hertz(deep, 16000) - 60) < 1) == 0


def test_values_are_hundredths() -> None:
    found = pitch_hertz(tone(np.full(4000, 123.456), 16000), 16000)
    assert found.tolist() == [round(value, 2) for value in found.tolist()]


def test_frames_beside_the_grid_go_to_the_nearest_point() -> None:
    found = on_grid(np.array([-0.001, 0.0024, 0.0074, 0.0126, 0.03]), np.array([1.0, 2.0, 3.0, 4.0, 5.0]), 4, 0.005)
    assert found.tolist() == [2.0, 3.0, 4.0, 0.0]


def test_the_rate_at_which_it_is_looked_for_makes_no_difference(monkeypatch: pytest.MonkeyPatch) -> None:
    rate, frames = 44100, 44100
    sung = tone(150 + 60 * np.sin(np.arange(frames) * 2 * np.pi * 2 / rate), rate)
    found = pitch_hertz(sung, rate)
    monkeypatch.setattr(pitch, "RATE", rate)
    whole = pitch_hertz(sung, rate)
    voiced = (found > 0) & (whole > 0)
    assert voiced.mean() > 0.95
    assert np.abs(found[voiced] / whole[voiced] - 1).max() < 0.002
    assert np.mean((found > 0) != (whole > 0)) < 0.01
