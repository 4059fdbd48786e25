"""Every instrument in one table: what it is, its controls, and the gain that makes its level mean what it says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING

from scorebreath_synthdefs.tracts import TRACTS, Route, Speaker

if TYPE_CHECKING:
    from supriya import SynthDef

SPEECH = "scorebreath_speech"
"""Name of the speech player."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Control:
    """One control of an instrument."""

    default: float
    unit: str
    about: str
    fixed: bool = True
    """read once, when the sound starts"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Instrument:
    """A row of the catalogue."""

    about: str
    controls: Mapping[str, Control]
    calibration: float = 1.0
    """gain at which `level` 1 is an RMS of 1 over the hold, measured at 48 kHz over 60 s of noise"""


def breath_name(route: Route, speaker: Speaker) -> str:
    """Name of the instrument for a breath through `route`.

    >>> breath_name("mouth", "male")
    'scorebreath_mouth_male'
    """
    return f"scorebreath_{route}_{speaker}"


_OUT = Control(default=0, unit="bus", about="where the sound goes")

_BREATH = MappingProxyType(
    {
        "out": _OUT,
        "level": Control(default=0.01, unit="amplitude", about="RMS over the hold", fixed=False),
        "attack": Control(default=0.15, unit="s", about="linear rise"),
        "hold": Control(default=0.27, unit="s", about="full level"),
        "release": Control(default=0.18, unit="s", about="linear fall, then the sound frees itself"),
        "seed": Control(default=1, unit="", about="of the noise, 1..2^24-1: controls are float32"),
        "rand_id": Control(default=0, unit="", about="random generator 0..63; breaths that overlap need their own"),
        "scale": Control(default=1, unit="", about="of all resonances: length of the table's tract over this one's"),
    }
)

_PLAYER = MappingProxyType(
    {
        "out": _OUT,
        "buffer": Control(default=0, unit="buffer", about="mono, at the engine's rate, ending with a zero"),
        "gain": Control(default=1, unit="amplitude", about="gain", fixed=False),
    }
)

_ABOUT: Mapping[Route, str] = {
    "mouth": "inspiration through the open mouth",
    "nose": "inspiration through the nose",
    "exhale": "audible expiration",
}

_CALIBRATION: Mapping[tuple[Route, Speaker], float] = {
    ("mouth", "male"): 9.2696,
    ("mouth", "female"): 8.6555,
    ("mouth", "child"): 7.9599,
    ("nose", "male"): 7.8715,
    ("nose", "female"): 7.4242,
    ("nose", "child"): 7.2907,
    ("exhale", "male"): 11.5285,
    ("exhale", "female"): 11.1519,
    ("exhale", "child"): 10.722,
}

CATALOGUE: Mapping[str, Instrument] = MappingProxyType(
    {
        SPEECH: Instrument(about="a buffer from its start to its end", controls=_PLAYER),
        **{
            breath_name(route, speaker): Instrument(
                about=f"{_ABOUT[route]}, {speaker} tract", controls=_BREATH, calibration=_CALIBRATION[route, speaker]
            )
            for route, speaker in TRACTS
        },
    }
)
"""All instruments by name."""


@cache
def synthdef(name: str) -> SynthDef:
    """Build an instrument of the catalogue; supriya is imported here.

    Raises:
        KeyError: The catalogue has no such name.
    """
    from scorebreath_synthdefs.breath import breath
    from scorebreath_synthdefs.speech import speech

    instrument = CATALOGUE[name]
    if name == SPEECH:
        return speech(name, instrument)
    tract = next(tract for key, tract in TRACTS.items() if breath_name(*key) == name)
    return breath(name, instrument, tract)
