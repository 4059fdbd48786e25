"""The catalogue against the graphs, and the sounds against physiology 3.4 and 3.5."""

from __future__ import annotations

import hashlib
import io
import itertools
import os
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from scorebreath.engine.offline import render, render_sounds
from scorebreath.engine.onsets import Onset
from scorebreath.media.store import MemoryStore
from scorebreath_synthdefs import CATALOGUE, RECORDING, SPEECH, TRACTS, Kind, Speaker, breath_name, synthdef
from tests.engine.listening import Signal, level_db, within
from tests.engine.sounding import inspiration, noise, samples, score
from tests.synthdefs.spectra import WINDOWS, above_trend, measures, outside

BREATHS = [breath_name(*key) for key in TRACTS]
HOLD = 12.0
LEVEL = 0.05


@cache
def hold_of(instrument: str, rate: int = 48000, scale: float = 1.0, engine: str = "embedded") -> Signal:
    """Twelve seconds of a breath that is held."""
    sound = Onset(
        time=0.0, duration=HOLD + 0.2, instrument=instrument, event="e",
        controls={"level": LEVEL, "attack": 0.1, "hold": HOLD, "release": 0.1, "seed": 4242.0, "scale": scale},
    )  # fmt: skip
    stream = io.BytesIO()
    render_sounds(
        [sound], MemoryStore(), stream, duration=HOLD + 0.2, sample_rate=rate, encoding="float32", engine=engine
    )
    return within(samples(stream.getvalue())[0], rate, 0.15, HOLD - 0.1)


@cache
def spectrum(instrument: str) -> dict[str, float]:
    """The measures of physiology 3.5: Welch 4096, 0.1..12 kHz."""
    return measures(hold_of(instrument))


SPEAKERS: tuple[Speaker, ...] = ("male", "female", "child")


@pytest.mark.parametrize("speaker", SPEAKERS)
@pytest.mark.parametrize("route", WINDOWS)
def test_spectra_lie_in_the_windows(route: Kind, speaker: Speaker) -> None:
    assert not outside(spectrum(breath_name(route, speaker)), route)


@pytest.mark.parametrize("speaker", SPEAKERS)
def test_the_nose_is_brighter_and_the_expiration_darker_than_the_mouth(speaker: Speaker) -> None:
    mouth, nose, out = (spectrum(breath_name(route, speaker))["centroid"] for route in ("mouth", "nose", "exhale"))
    assert nose > mouth + 500
    assert out < mouth - 300


def test_white_noise_would_fail() -> None:
    found = measures(np.random.default_rng(1).standard_normal(48000 * 12))
    for windows in WINDOWS.values():
        assert sum(not low <= found[name] <= high for name, (low, high) in windows.items()) >= 4


@pytest.mark.parametrize("speaker", SPEAKERS)
def test_peaks_of_the_mouth_are_there_and_weak(speaker: Speaker) -> None:
    """At least two 3 dB above the trend below 3 kHz, none 15 dB above it (physiology 3.5)."""
    frequency, above = above_trend(hold_of(breath_name("mouth", speaker)))
    peaks = np.flatnonzero((above[1:-1] > above[:-2]) & (above[1:-1] >= above[2:])) + 1
    low = [peak for peak in peaks if above[peak] >= 3 and frequency[peak] < 3000]
    assert len(low) >= 2
    assert above.max() < 15


def test_breathing_through_the_nose_brightens_step_by_step() -> None:
    found = []
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        stream = io.BytesIO()
        sound = noise(0.1, HOLD, 0.1, level_db=0.0)
        render(score([inspiration(0.0, sound, mouth=1 - share, nose=share)], HOLD), MemoryStore(), stream)
        found.append(measures(within(samples(stream.getvalue())[0], 48000, 0.2, HOLD - 0.4))["centroid"])
    assert found == sorted(found)
    assert found[-1] > found[0] + 500


@pytest.mark.parametrize("name", BREATHS)
def test_level_is_the_rms_over_the_hold(name: str) -> None:
    """Measures the calibration of the catalogue again."""
    assert level_db(hold_of(name)) == pytest.approx(20 * np.log10(LEVEL), abs=0.3)


@pytest.mark.parametrize("rate", [16000, 44100, 96000])
@pytest.mark.parametrize("name", ["scorebreath_mouth_male", "scorebreath_nose_male"])
def test_level_does_not_depend_on_the_rate(name: str, rate: int) -> None:
    assert level_db(hold_of(name, rate)) == pytest.approx(20 * np.log10(LEVEL), abs=0.4)


@pytest.mark.parametrize("scale", [0.8, 1.25, 1.5])
@pytest.mark.parametrize("name", ["scorebreath_mouth_male", "scorebreath_nose_male"])
def test_a_shorter_tract_is_brighter_and_as_loud(name: str, scale: float) -> None:
    sound = hold_of(name, 48000, scale)
    assert level_db(sound) == pytest.approx(20 * np.log10(LEVEL), abs=0.4)
    ratio = measures(sound)["centroid"] / spectrum(name)["centroid"]
    assert (ratio - 1) * (scale - 1) > 0
    assert 0.4 < np.log(ratio) / np.log(scale) < 1.2


def test_the_catalogue_names_every_tract() -> None:
    assert set(CATALOGUE) == {*BREATHS, RECORDING, SPEECH}
    assert set(TRACTS) == set(itertools.product(get_args(Kind), SPEAKERS))


@pytest.mark.parametrize("name", CATALOGUE)
def test_a_graph_has_the_controls_of_its_row(name: str) -> None:
    made, row = synthdef(name), CATALOGUE[name]
    found = {
        key: (parameter.value[0], parameter.rate.name == "SCALAR") for key, (parameter, _) in made.parameters.items()
    }
    assert found == {key: (control.default, control.fixed) for key, control in row.controls.items()}
    assert made.effective_name == name
    assert row.about
    assert all(control.about for control in row.controls.values())


@pytest.mark.parametrize("name", CATALOGUE)
def test_a_graph_holds_nothing_that_delays_or_shifts_its_onset(name: str) -> None:
    """`Out` starts on the block before, a limiter 20 ms late (engine notes)."""
    units = {type(unit).__name__ for unit in synthdef(name).ugens}
    assert "OffsetOut" in units
    assert not units & {"Out", "ReplaceOut", "Limiter", "Normalizer", "DelayN", "CombN"}
    assert ("RandSeed" in units) == ("WhiteNoise" in units) == (name not in {SPEECH, RECORDING})


def test_an_unknown_instrument_is_an_error() -> None:
    with pytest.raises(KeyError):
        synthdef("scorebreath_ears_male")


def test_graphs_are_the_same_bytes_in_every_process(root: Path) -> None:
    code = (
        "from scorebreath_synthdefs import CATALOGUE, synthdef; import hashlib;"
        "print(hashlib.sha256(b''.join(synthdef(name).compile() for name in CATALOGUE)).hexdigest())"
    )
    environment = {**os.environ, "PYTHONPATH": str(root / "synthdefs"), "PYTHONHASHSEED": "7"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment)
    here = hashlib.sha256(b"".join(synthdef(name).compile() for name in CATALOGUE)).hexdigest()
    assert done.stdout.strip() == here
