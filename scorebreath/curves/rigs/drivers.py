"""What a rig's columns can be made from besides channels: a few combinations of them, and visemes, each a row here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from scorebreath.curves.lips.visemes import VISEMES
from scorebreath.curves.tracks import Array

CONTACT = "contact"
"""1 while p, b or m must hold the lips shut, ramps of 62 ms beside, 0 elsewhere: `CurveSet.contact`, no channel."""
VISEME = "viseme_"
"""Before the name of a viseme: its share, of `CurveSet.visemes`, no channel."""


@dataclass(frozen=True, slots=True)
class Driver:
    """A function of channels."""

    channels: tuple[str, ...]
    """what it is given, in this order; or CONTACT, or VISEME and a name"""
    of: Callable[..., Array]
    """(n,) each in, (n,) out"""
    meaning: str


OPEN = 0.58
"""Value of jaw_open for aa."""

DRIVERS: Mapping[str, Driver] = MappingProxyType(
    {
        "mouth": Driver(
            ("jaw_open", "mouth_open"), np.maximum,
            "the mouth's opening, to speak or to breathe",
        ),
        "breath_share": Driver(
            ("jaw_open", "mouth_open"), lambda jaw, breath: np.clip((breath - jaw) / OPEN, 0.0, 1.0),
            "how much further the breath opens the mouth than speech: 1 as far as for aa",
        ),
        "aperture": Driver(
            ("jaw_open", "mouth_open", "lip_close"),
            lambda jaw, breath, close: np.maximum(jaw, breath) * (1.0 - close),
            "what of that opening the lips leave",
        ),
        "covered": Driver(
            ("jaw_open", "mouth_open", "lip_close"), lambda jaw, breath, close: np.maximum(jaw, breath) * close,
            "what of that opening the lips cover",
        ),
        "closing": Driver(
            (CONTACT, "lip_close"), np.minimum, "how far the lips are shut for p, b, m: 0 but for them and 62 ms beside"
        ),
        "unrounded": Driver(
            ("jaw_open", "lip_round"), lambda jaw, rounded: jaw * (1.0 - rounded), "jaw open behind spread lips (aa)"
        ),
        "shut_left": Driver(("lid_left",), lambda lid: np.maximum(lid, 0.0), "how far the left eye is shut"),
        "shut_right": Driver(("lid_right",), lambda lid: np.maximum(lid, 0.0), "how far the right eye is shut"),
        **{
            f"{channel}.{way}": Driver((channel,), of, f"degrees that the eyes look {way} in the head")
            for channel, ways in (
                ("eye_pitch", ("up", "down")), ("eye_yaw", ("left", "right")),
            )
            for way, of in zip(
                ways, (lambda angle: np.maximum(angle, 0.0), lambda angle: np.maximum(-angle, 0.0)), strict=True
            )
        },
        **{
            f"{VISEME}{name}": Driver((f"{VISEME}{name}",), np.asarray, f"share of the viseme {name}; all add up to 1")
            for name in VISEMES
        },
    }
)  # fmt: skip
"""By name; each 0 or more."""
