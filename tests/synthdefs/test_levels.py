"""`level` is the RMS of the loud part, whatever the envelope, the speaker, the rate, the scale and the brightness."""

from __future__ import annotations

import dataclasses
from math import log10

import numpy as np
import pytest

from scorebreath.equations.breath import flow_loudness
from scorebreath.equations.shapes import flow_envelope
from scorebreath_synthdefs import CATALOGUE, RECORDING, TRACTS, Kind, Speaker, breath_name
from scorebreath_synthdefs.loudness import amplitude
from tests.engine.listening import Signal, level_db
from tests.synthdefs.playing import FLOW, LEVEL, STORE, onset, played, recorded, several
from tests.synthdefs.spectra import above_trend, measures, outside

BREATHS = [breath_name(*key) for key in TRACTS]
SOME = ["scorebreath_mouth_male", "scorebreath_nose_child", "scorebreath_sigh_female", "scorebreath_sniff_male"]
LONG = {"attack": 0.3, "hold": 0.2, "release": 0.4}


def loud_part(name: str, *, rate: int = 48000, exponent: float = FLOW, **controls: float) -> Signal:
    """Samples where the envelope is at least half as high as its highest, of sixteen seeds."""
    ramps = LONG | {ramp: controls.pop(ramp) for ramp in LONG if ramp in controls}
    sound = several(name, 16, rate, exponent=exponent, **ramps, **controls)
    gain = flow_envelope(np.arange(sound.shape[1]) / rate, ramps["attack"], ramps["hold"], ramps["release"], exponent)
    return sound[:, gain >= 0.5]


def rms(values: Signal) -> float:
    return float(np.sqrt(np.mean(values**2)))


def off(sound: Signal) -> float:
    """dB by which a sound misses its level."""
    return abs(level_db(sound) - 20 * log10(LEVEL))


@pytest.mark.parametrize("name", BREATHS)
def test_the_loud_part_of_a_flow_has_the_level(name: str) -> None:
    assert off(loud_part(name)) < 0.5


@pytest.mark.parametrize("scale", [0.8, 1.0, 1.25, 1.5])
@pytest.mark.parametrize("rate", [44100, 48000])
@pytest.mark.parametrize("name", SOME)
def test_the_level_holds_for_any_rate_and_tract(name: str, rate: int, scale: float) -> None:
    assert off(loud_part(name, rate=rate, scale=scale)) < 0.5


@pytest.mark.parametrize("brightness", [0.7, 1.4])
@pytest.mark.parametrize("name", SOME)
def test_the_level_holds_for_any_brightness(name: str, brightness: float) -> None:
    assert off(loud_part(name, brightness=brightness)) < 0.5
    assert off(loud_part(name, brightness=brightness, scale=1.25)) < 0.5


@pytest.mark.parametrize("ramps", [(0.4, 0.0, 0.6), (0.0, 0.0, 1.0), (0.9, 0.0, 0.05), (0.05, 0.9, 0.05)])
@pytest.mark.parametrize("exponent", [1.0, 1.3, FLOW, 2.0])
def test_the_level_holds_for_any_flow(exponent: float, ramps: tuple[float, float, float]) -> None:
    attack, hold, release = ramps
    sound = loud_part(SOME[0], exponent=exponent, attack=attack, hold=hold, release=release)
    assert off(sound) < 0.5
    time = np.linspace(0, attack + hold + release, 20001)
    gain = flow_envelope(time, attack, hold, release, exponent)
    assert flow_loudness(attack, hold, release, exponent) == pytest.approx(
        np.sqrt(np.mean(gain[gain >= 0.5] ** 2)), abs=1e-3
    )


@pytest.mark.parametrize("key", TRACTS)
def test_calibrations_are_those_of_the_transfer_function(key: tuple[Kind, Speaker]) -> None:
    assert 20 * log10(CATALOGUE[breath_name(*key)].calibration * amplitude(TRACTS[key])) == pytest.approx(0, abs=0.03)


@pytest.mark.parametrize("speaker", ["male", "female", "child"])
@pytest.mark.parametrize("kind", ["mouth", "nose"])
def test_spectra_under_a_flow_lie_in_the_windows(kind: Kind, speaker: Speaker) -> None:
    """Mean of sixteen breaths of 0.6 s (physiology 3.5)."""
    assert not outside(measures(several(breath_name(kind, speaker), exponent=FLOW)), kind)


@pytest.mark.parametrize("name", BREATHS)
def test_peaks_are_weak(name: str) -> None:
    """None 15 dB above the trend (physiology 3.5)."""
    assert above_trend(loud_part(name))[1].max() < 15


@pytest.mark.parametrize("name", SOME)
def test_brightness_moves_the_spectrum_up(name: str) -> None:
    found = [measures(loud_part(name, brightness=by))["centroid"] for by in (0.7, 0.85, 1.0, 1.2, 1.4)]
    assert found == sorted(found)
    assert 1.3 < found[-1] / found[0] < 2.0


def test_a_recording_is_played_as_it_is() -> None:
    name, start = recorded(2.0), 0.5
    for exponent in (0.0, FLOW):
        sound = onset(RECORDING, 0.0, start=start, exponent=exponent, attack=0.1, hold=0.3, release=0.2)
        signal = played([sound], 0.7)
        inner = slice(4800 + 64, 4800 + 14400 - 64)
        kept = STORE.get(name).samples.astype(np.float64)[24000 : 24000 + len(signal)]
        gain = LEVEL * 10 / (flow_loudness(0.1, 0.3, 0.2, FLOW) if exponent else 1.0)
        np.testing.assert_allclose(signal[inner], kept[inner] * gain, atol=2e-6)
        assert not signal[28801:].any()


@pytest.mark.parametrize("exponent", [0.0, FLOW])
def test_a_recording_has_the_level(exponent: float) -> None:
    sound = loud_part(RECORDING, exponent=exponent) if exponent else several(RECORDING, exponent=0.0)[:, 7200:20000]
    assert off(sound) < 0.3


def test_a_recording_that_ends_begins_again() -> None:
    short = recorded(0.25, seed=9)
    sound = onset(RECORDING, 0.0, start=0.0, attack=0.01, hold=0.7, release=0.01)
    signal = played([dataclasses.replace(sound, media=short, media_duration=0.25)], 0.8)
    period = int(0.25 * 48000)
    again = slice(2000, 9000)
    found = [np.corrcoef(signal[again], signal[period + d :][again])[0, 1] for d in (0, 1, 2)]
    assert max(found) > 0.99
    assert level_db(signal[24000:33000]) == pytest.approx(20 * log10(LEVEL), abs=0.5)
