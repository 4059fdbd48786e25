"""A wanted loudness, and stems: measured by others, with the real engine."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
import soundfile
import soxr
from numpy.typing import NDArray

from scorebreath.engine.master import LOUDNESS, MOST_LIMITED, STEMS, Mastered, render_mastered
from scorebreath.engine.offline import render
from scorebreath.errors import InputError
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.score.document import Score
from scorebreath.speech.voices import open_voice

pyloudnorm = pytest.importorskip("pyloudnorm", reason="the extra loudness is not installed")

TEXT = "The rain came in from the west, and stayed until the evening. Nobody had asked it to, and nobody minded."
STEP = 2.0**-23
"""of a sample of 24 bits"""


@pytest.fixture(scope="module")
def score() -> tuple[Score, MemoryStore]:
    media = MemoryStore()
    with open_voice("espeak", "en") as voice:
        return compile_text(TEXT, voice=voice, media=media), media


def made(
    score: tuple[Score, MemoryStore], loudness: float | None, *, stems: bool = False
) -> tuple[Mastered, NDArray[np.float64], dict[str, NDArray[np.float64]], bytes]:
    mix, parts = io.BytesIO(), {name: io.BytesIO() for name in STEMS}
    told = render_mastered(*score, mix, loudness=loudness, stems=parts if stems else None)
    found = {name: soundfile.read(io.BytesIO(part.getvalue()))[0] for name, part in parts.items()} if stems else {}
    return told, soundfile.read(io.BytesIO(mix.getvalue()))[0], found, mix.getvalue()


def true_peak(samples: NDArray[np.float64]) -> float:
    """By a finer resampling than the program's own."""
    return float(20 * np.log10(np.abs(soxr.resample(samples, 48000, 8 * 48000, quality="VHQ")).max()))


@pytest.mark.parametrize("wanted", [-16.0, -19.0, -23.0, -40.0])
def test_the_mix_is_as_loud_as_wanted_and_its_peaks_are_low(score: tuple[Score, MemoryStore], wanted: float) -> None:
    told, mix, _, _ = made(score, wanted)
    found = pyloudnorm.Meter(48000).integrated_loudness(mix)
    assert found == pytest.approx(wanted, abs=0.1)
    assert told.loudness == pytest.approx(found, abs=0.01)
    assert true_peak(mix) <= -1.0
    assert told.true_peak_db is not None
    assert told.true_peak_db == pytest.approx(true_peak(mix), abs=0.05)
    assert len(mix) == told.frames


def test_what_cannot_be_that_loud_is_not_squashed(score: tuple[Score, MemoryStore]) -> None:
    told, mix, _, _ = made(score, LOUDNESS[1])
    assert told.loudness is not None
    assert told.loudness < LOUDNESS[1] - 1
    assert told.limited_db <= MOST_LIMITED + 1
    assert true_peak(mix) <= -1.0


@pytest.mark.parametrize("wanted", [None, -23.0, -14.0])
def test_stems_add_up_to_the_mix(score: tuple[Score, MemoryStore], wanted: float | None) -> None:
    """Each sample within the three roundings, wherever the limiter works."""
    told, mix, parts, _ = made(score, wanted, stems=True)
    assert np.abs(parts["speech"] + parts["breath"] - mix).max() <= 2 * STEP
    if wanted == -14.0:
        assert told.limited_db > 1
    for part in parts.values():
        assert len(part) == len(mix)
        assert np.abs(part).max() > 0.001


def test_stems_hold_what_they_are_called(score: tuple[Score, MemoryStore]) -> None:
    _, _, parts, _ = made(score, None, stems=True)
    for event in score[0].events:
        if event.type not in ("utterance", "inspiration"):
            continue
        start, end = (round((event.onset + share * event.duration) * 48000) for share in (0.2, 0.8))
        other = parts["breath" if event.type == "utterance" else "speech"]
        assert not other[start:end].any(), event.id


def test_without_a_loudness_the_mix_is_the_same_file(score: tuple[Score, MemoryStore]) -> None:
    plain = io.BytesIO()
    render(*score, plain)
    assert made(score, None)[3] == plain.getvalue()
    assert made(score, None, stems=True)[3] == plain.getvalue()


def test_equal_scores_give_equal_bytes(score: tuple[Score, MemoryStore]) -> None:
    assert made(score, -16.0)[3] == made(score, -16.0)[3]


def test_the_least_and_the_most(score: tuple[Score, MemoryStore]) -> None:
    for wanted in (-61.0, 0.0, float("nan")):
        with pytest.raises(InputError, match="must be in"):
            made(score, wanted)


def test_silence_stays_silent() -> None:
    media = MemoryStore()
    with open_voice("tone", "en") as voice:
        silent = compile_text("[pause 0.5]", voice=voice, media=media, parameters=Parameters(breath_sound=False))
    told, mix, _, _ = made((silent, media), -16.0)
    assert told.loudness is None
    assert not mix.any()


def test_a_take_of_an_older_rendering_can_be_mastered(score: tuple[Score, MemoryStore], tmp_path: Path) -> None:
    """The rate of the engine is any."""
    mix = io.BytesIO()
    told = render_mastered(*score, mix, loudness=-20.0, sample_rate=44100)
    samples, rate = soundfile.read(io.BytesIO(mix.getvalue()))
    assert rate == 44100
    assert pyloudnorm.Meter(rate).integrated_loudness(samples) == pytest.approx(-20.0, abs=0.1)
    assert told.frames == len(samples)
