"""Every instrument in one table: what it is, its controls, and the gain that makes its level mean what it says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Literal, get_args

from scorebreath_synthdefs.tracts import TRACTS, Kind, Speaker

if TYPE_CHECKING:
    from supriya import SynthDef

SPEECH = "scorebreath_speech"
"""Name of the speech player."""
RECORDING = "scorebreath_recording"
"""Name of the player of recorded breaths."""
RECORDING_DB = -20.0
"""RMS of a recorded breath, dB re full scale (physiology 9.2)."""
MOVER = "scorebreath_mover"
"""Name of what moves a body's ratios."""
PLACE = "scorebreath_place"
"""Name of what puts a body between the speakers."""
CLICK = "scorebreath_click"
"""Name of what plays a click and records what comes back."""
CLICK_LENGTH = 0.001
"""s"""
Route = Literal["speech", "mouth", "nose", "brightness"]
HEARD: tuple[Route, ...] = get_args(Route)
"""Ratios of a body, in the order of its control buses: gain of speech, of breaths through mouth and nose, and what
resonances and tilt of breaths are multiplied by."""
CEILING = 10 ** (-1 / 20)
"""Amplitude that nothing goes beyond live, as offline: -1 dB re full scale."""
LOOK_AHEAD = 0.02
"""s by which a limited master is late: SuperCollider's Limiter looks ahead twice its duration."""
NEVER = 1e9
"""`cut` of what is not cut, s."""


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
    """gain at which `level` 1 is an RMS of 1 over the hold, at 48 kHz: measured over 60 s of noise, or of its transfer
    function"""


def breath_name(kind: Kind, speaker: Speaker) -> str:
    """Name of the instrument for a kind of breath.

    >>> breath_name("mouth", "male")
    'scorebreath_mouth_male'
    """
    return f"scorebreath_{kind}_{speaker}"


def master_name(channels: int, limited: bool) -> str:
    """Name of the master for so many outputs.

    >>> master_name(2, True)
    'scorebreath_master_2_limited'
    """
    return f"scorebreath_master_{channels}{'_limited' * limited}"


_OUT = Control(default=0, unit="bus", about="where the sound goes")
SHARED: Mapping[str, Control] = MappingProxyType(
    {
        "heard": Control(default=-1, unit="bus", about="first of four of the body's ratios; below 0: all are 1"),
        "cut": Control(default=NEVER, unit="s", about="after its onset that it begins to end", fixed=False),
        "fade": Control(default=0.02, unit="s", about="from there to silence; then it frees itself", fixed=False),
    }
)
"""Controls of every instrument that sounds."""

_ABOUT: Mapping[Kind, str] = {
    "mouth": "inspiration through the open mouth",
    "nose": "inspiration through the nose",
    "exhale": "audible expiration",
    "sigh": "long expiration through a wide mouth that closes: falling formants",
    "gasp": "sudden inspiration through a wide mouth that opens: bright, rising formants",
    "sniff": "short inspiration through narrowed nostrils, bright",
    "laugh": "a puff of laughter: [h] before [a]",
    "hold": "the throat's soft catch as it shuts, low and dull",
}

NASAL: frozenset[Kind] = frozenset({"nose", "sniff"})
"""Kinds that sound through the nose."""

_RAMPS: Mapping[Kind, tuple[float, float, float]] = {
    "mouth": (0.15, 0.27, 0.18),
    "nose": (0.15, 0.27, 0.18),
    "exhale": (0.1, 0.15, 0.45),
    "sigh": (0.25, 0.25, 1.0),
    "gasp": (0.24, 0.12, 0.04),  # the end: at most 50 ms (physiology 3.3)
    "sniff": (0.05, 0.05, 0.08),
    "laugh": (0.015, 0.025, 0.085),
    "hold": (0.002, 0.003, 0.025),
}
"""Attack, hold and release of a typical one, s."""

_CALIBRATION: Mapping[tuple[Kind, Speaker], float] = {
    ("mouth", "male"): 9.2696,
    ("mouth", "female"): 8.6555,
    ("mouth", "child"): 7.9599,
    ("nose", "male"): 7.8715,
    ("nose", "female"): 7.4242,
    ("nose", "child"): 7.2907,
    ("exhale", "male"): 11.5285,
    ("exhale", "female"): 11.1519,
    ("exhale", "child"): 10.722,
    ("sigh", "male"): 12.2753,
    ("sigh", "female"): 11.8039,
    ("sigh", "child"): 11.2807,
    ("gasp", "male"): 6.4778,
    ("gasp", "female"): 6.2936,
    ("gasp", "child"): 6.0826,
    ("sniff", "male"): 4.6714,
    ("sniff", "female"): 4.5722,
    ("sniff", "child"): 4.4737,
    ("laugh", "male"): 13.3625,
    ("laugh", "female"): 12.8005,
    ("laugh", "child"): 12.1664,
    ("hold", "male"): 16.4724,
    ("hold", "female"): 15.7989,
    ("hold", "child"): 15.0553,
}

_LEVEL = Control(
    default=0.01, unit="amplitude", about="RMS over the hold, or over the loud part of a flow", fixed=False
)
_EXPONENT = Control(default=0, unit="", about="0: straight ramps; else amplitude is flow to this power, say 1.66")


def _ramps(attack: float, hold: float, release: float) -> dict[str, Control]:
    return {
        "attack": Control(default=attack, unit="s", about="rise"),
        "hold": Control(default=hold, unit="s", about="full level"),
        "release": Control(default=release, unit="s", about="fall, then the sound frees itself"),
        "exponent": _EXPONENT,
    }


def _breath(kind: Kind) -> Mapping[str, Control]:
    return MappingProxyType(
        {
            "out": _OUT,
            "level": _LEVEL,
            **_ramps(*_RAMPS[kind]),
            "seed": Control(default=1, unit="", about="of the noise, 1..2^24-1: controls are float32"),
            "rand_id": Control(default=0, unit="", about="random generator 0..63; breaths that overlap need their own"),
            "scale": Control(
                default=1, unit="", about="of all resonances: length of the table's tract over this one's"
            ),
            "brightness": Control(default=1, unit="", about="of resonances and tilt: faster air is brighter"),
            **SHARED,
        }
    )


_PLAYER = MappingProxyType(
    {
        "out": _OUT,
        "buffer": Control(default=0, unit="buffer", about="mono, at the engine's rate, ending with a zero"),
        "start": Control(default=0, unit="s", about="where in the buffer it begins"),
        "gain": Control(default=1, unit="amplitude", about="gain", fixed=False),
        **SHARED,
    }
)

_RECORDING = MappingProxyType(
    {
        "out": _OUT,
        "buffer": Control(default=0, unit="buffer", about=f"mono, at the engine's rate, RMS {RECORDING_DB:g} dBFS"),
        "start": Control(default=0, unit="s", about="where in the buffer it begins"),
        "level": _LEVEL,
        **_ramps(*_RAMPS["mouth"]),
        **SHARED,
    }
)

CATALOGUE: Mapping[str, Instrument] = MappingProxyType(
    {
        SPEECH: Instrument(about="a buffer from its start to its end", controls=_PLAYER),
        RECORDING: Instrument(
            about="a recorded breath, played under an envelope",
            controls=_RECORDING,
            calibration=10 ** (-RECORDING_DB / 20),
        ),
        **{
            breath_name(kind, speaker): Instrument(
                about=f"{_ABOUT[kind]}, {speaker} tract",
                controls=_breath(kind),
                calibration=_CALIBRATION[kind, speaker],
            )
            for kind, speaker in TRACTS
        },
    }
)
"""All instruments that sound, by name."""

_MIX = Control(default=0, unit="bus", about="first of two that everything is mixed into")
HELPERS: Mapping[str, Instrument] = MappingProxyType(
    {
        MOVER: Instrument(
            about="moves a body's ratios",
            controls=MappingProxyType(
                {
                    "bus": Control(default=0, unit="bus", about="first of the four control buses"),
                    **{f"{route}_from": Control(default=1, unit="", about=f"{route} before") for route in HEARD},
                    **{route: Control(default=1, unit="", about=f"{route} afterwards") for route in HEARD},
                    "glide": Control(default=0, unit="s", about="from the one to the other"),
                    "stay": Control(default=0, unit="s", about="afterwards, while an older one still moves"),
                }
            ),
        ),
        PLACE: Instrument(
            about="a body between the speakers",
            controls=MappingProxyType(
                {
                    "bus": Control(default=0, unit="bus", about="where the body sounds"),
                    "out": _MIX,
                    "pan": Control(default=0, unit="", about="-1 left, 0 both alike, 1 right", fixed=False),
                }
            ),
        ),
        CLICK: Instrument(
            about="a click, and a recording of the first input from its first sample on",
            controls=MappingProxyType(
                {
                    "out": Control(default=0, unit="bus", about="first of two outputs"),
                    "buffer": Control(
                        default=0, unit="buffer", about="mono; when it is full, the recorder frees itself"
                    ),
                    "level": Control(default=0.5, unit="amplitude", about="of the click"),
                }
            ),
        ),
        **{
            master_name(channels, limited): Instrument(
                about=f"all bodies into {channels} output{'s' * (channels > 1)}{', limited' * limited}",
                controls=MappingProxyType(
                    {
                        "bus": _MIX,
                        "out": Control(default=0, unit="bus", about="first output"),
                        "gain": Control(default=1, unit="amplitude", about="of everything", fixed=False),
                    }
                ),
            )
            for channels in (1, 2)
            for limited in (False, True)
        },
    }
)
"""What does not sound by itself, by name."""
ALL: Mapping[str, Instrument] = MappingProxyType({**CATALOGUE, **HELPERS})


@cache
def synthdef(name: str) -> SynthDef:
    """Build an instrument of the catalogue; supriya is imported here.

    Raises:
        KeyError: The catalogue has no such name.
    """
    from scorebreath_synthdefs.breath import breath
    from scorebreath_synthdefs.loop import click
    from scorebreath_synthdefs.mixing import master, place
    from scorebreath_synthdefs.moving import mover
    from scorebreath_synthdefs.recording import recording
    from scorebreath_synthdefs.speech import speech

    instrument = ALL[name]
    makers = {SPEECH: speech, RECORDING: recording, MOVER: mover, PLACE: place, CLICK: click}
    if name in makers:
        return makers[name](name, instrument)
    for channels in (1, 2):
        for limited in (False, True):
            if name == master_name(channels, limited):
                return master(name, instrument, channels, limited)
    (kind, _), tract = next(row for row in TRACTS.items() if breath_name(*row[0]) == name)
    return breath(name, instrument, tract, "nose" if kind in NASAL else "mouth")
