"""Every kind of breath has a spectrum and an envelope of its own, measured in its sound; others do not have them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import get_args

import numpy as np
import pytest

from scorebreath_synthdefs import LENGTHS, Kind, Speaker, breath_name
from tests.engine.listening import Signal
from tests.synthdefs.playing import FLOW, several

KINDS: tuple[Kind, ...] = get_args(Kind)
SPEAKERS: tuple[Speaker, ...] = get_args(Speaker)
Window = tuple[float, float]
RATE = 48000
_TRACT_POWER = 0.7  # centroids go with the tract's length to this power: tilt and floor do not


@dataclass(frozen=True, slots=True, kw_only=True)
class Spectrum:
    """Where the sound's power lies, Hz of a man's tract."""

    centroid: Window
    roll_off: Window
    """85 %"""
    drift: Window
    """centroid of the last third over that of the first"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shape:
    """Lengths of the envelope, s."""

    loud: Window
    """from the first to the last moment at half the amplitude"""
    rise: Window
    """from a tenth to four fifths"""
    fall: Window
    """back"""


SPECTRA: dict[Kind, Spectrum] = {
    "mouth": Spectrum(centroid=(1300, 1650), roll_off=(2200, 2900), drift=(0.95, 1.06)),
    "nose": Spectrum(centroid=(2450, 2950), roll_off=(3900, 4700), drift=(0.95, 1.06)),
    "exhale": Spectrum(centroid=(870, 1060), roll_off=(1250, 1480), drift=(0.955, 1.08)),
    "sigh": Spectrum(centroid=(950, 1150), roll_off=(1100, 1330), drift=(0.76, 0.88)),
    "gasp": Spectrum(centroid=(2750, 3350), roll_off=(4850, 5700), drift=(1.07, 1.2)),
    "sniff": Spectrum(centroid=(4050, 4850), roll_off=(5500, 6500), drift=(0.95, 1.06)),
    "laugh": Spectrum(centroid=(1060, 1270), roll_off=(1230, 1500), drift=(0.88, 0.95)),
    "hold": Spectrum(centroid=(380, 500), roll_off=(520, 700), drift=(0.72, 0.92)),
}
BREATH = Shape(loud=(0.42, 0.47), rise=(0.065, 0.1), fall=(0.08, 0.115))
SHAPES: dict[Kind, Shape] = {
    "mouth": BREATH,
    "nose": BREATH,  # mouth and nose sound at once, under one envelope
    "exhale": Shape(loud=(0.41, 0.47), rise=(0.04, 0.065), fall=(0.2, 0.26)),
    "sigh": Shape(loud=(0.85, 1.0), rise=(0.11, 0.16), fall=(0.45, 0.58)),
    "gasp": Shape(loud=(0.25, 0.29), rise=(0.11, 0.145), fall=(0.012, 0.03)),
    "sniff": Shape(loud=(0.105, 0.13), rise=(0.018, 0.036), fall=(0.034, 0.055)),
    "laugh": Shape(loud=(0.07, 0.095), rise=(0.004, 0.014), fall=(0.035, 0.062)),
    "hold": Shape(loud=(0.01, 0.022), rise=(0.0005, 0.004), fall=(0.006, 0.02)),
}


@cache
def spectrum(kind: Kind, speaker: Speaker) -> dict[str, float]:
    """Measured, for a man's tract; the mean of sixteen seeds."""
    sound = several(breath_name(kind, speaker), exponent=FLOW)
    third = sound.shape[1] // 3
    size = (LENGTHS["male"] / LENGTHS[speaker]) ** _TRACT_POWER
    centroid, roll_off = _measured(sound)
    return {
        "centroid": centroid / size,
        "roll_off": roll_off / size,
        "drift": _measured(sound[:, -third:])[0] / _measured(sound[:, :third])[0],
    }


def _measured(sound: Signal) -> tuple[float, float]:
    """Centroid and 85 % roll-off within 0.1..12 kHz."""
    size = max(8192, sound.shape[1])
    power = np.mean(np.abs(np.fft.rfft(sound * np.hanning(sound.shape[1]), size)) ** 2, axis=0)
    frequency = np.fft.rfftfreq(size, 1 / RATE)
    heard = (frequency >= 100) & (frequency <= 12000)
    power, frequency = power[heard], frequency[heard]
    below = np.cumsum(power) / power.sum()
    return float((power * frequency).sum() / power.sum()), float(frequency[np.searchsorted(below, 0.85)])


@cache
def shape(kind: Kind, speaker: Speaker) -> dict[str, float]:
    """Measured, from the mean power of sixteen seeds."""
    sound = several(breath_name(kind, speaker), exponent=FLOW)
    frames = sound.shape[1]
    window = max(8, frames // 60)
    level = np.sqrt(np.convolve((sound**2).mean(axis=0), np.ones(window) / window, "same"))
    level /= np.sort(level)[-frames // 10 :].mean()
    half, tenth, most = (np.flatnonzero(level > share)[[0, -1]] / RATE for share in (0.5, 0.1, 0.8))
    return {"loud": half[1] - half[0], "rise": most[0] - tenth[0], "fall": tenth[1] - most[1]}


def outside(found: dict[str, float], windows: Spectrum | Shape) -> dict[str, tuple[float, Window]]:
    """What lies outside its window."""
    return {
        name: (round(value, 4), window)
        for name, value in found.items()
        if not (window := getattr(windows, name))[0] <= value <= window[1]
    }


@pytest.mark.parametrize("speaker", SPEAKERS)
@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_its_spectrum(kind: Kind, speaker: Speaker) -> None:
    assert not outside(spectrum(kind, speaker), SPECTRA[kind])


@pytest.mark.parametrize("speaker", SPEAKERS)
@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_its_envelope(kind: Kind, speaker: Speaker) -> None:
    assert not outside(shape(kind, speaker), SHAPES[kind])


@pytest.mark.parametrize("speaker", SPEAKERS)
@pytest.mark.parametrize("kind", KINDS)
def test_no_kind_passes_for_another(kind: Kind, speaker: Speaker) -> None:
    taken = [other for other in KINDS if other != kind and not outside(spectrum(kind, speaker), SPECTRA[other])]
    assert not taken
    shapes = [other for other in KINDS if SHAPES[other] != SHAPES[kind]]
    assert not [other for other in shapes if not outside(shape(kind, speaker), SHAPES[other])]


def test_a_gasp_rises_and_breaks_off_and_a_sigh_does_the_reverse() -> None:
    gasp, sigh = shape("gasp", "male"), shape("sigh", "male")
    assert gasp["rise"] > 4 * gasp["fall"]
    assert sigh["fall"] > 3 * sigh["rise"]
    assert spectrum("gasp", "male")["drift"] > 1.05 > 0.9 > spectrum("sigh", "male")["drift"]
