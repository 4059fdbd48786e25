"""Vocal tracts that a breath sounds through: physiology 3.4 as data, and ours for the sounds that it does not list."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Literal, NamedTuple

Kind = Literal["mouth", "nose", "exhale", "sigh", "gasp", "sniff", "laugh", "hold"]
Speaker = Literal["male", "female", "child"]


class Resonance(NamedTuple):
    """A two-pole resonator of unity peak gain."""

    frequency: float
    """Hz"""
    bandwidth: float
    """Hz"""
    gain_db: float


class Dip(NamedTuple):
    """A pole-zero pair at one frequency, gain 1 at 0 Hz: what a side cavity takes out."""

    frequency: float
    """Hz"""
    zero_bandwidth: float
    """Hz"""
    pole_bandwidth: float
    """Hz, wider than the zero's"""


class Glide(NamedTuple):
    """What resonances and tilt are multiplied by in the course of a sound."""

    start: float
    full: float
    """from the end of the attack to the end of the hold"""
    end: float
    with_flow: bool
    """only under an envelope that follows the flow, and of the resonances only the first (physiology 3.3)"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tract:
    """White noise goes through parallel resonances of alternating sign and a floor, then tilt, high-pass and dips."""

    resonances: tuple[Resonance, ...]
    floor_db: float
    """dB, of the noise that passes beside the resonances"""
    tilt: float
    """Hz, cut-off of the one-pole low-pass"""
    highpass: float
    """Hz, cut-off of the second-order high-pass"""
    dips: tuple[Dip, ...]
    glide: Glide

    @property
    def gliding(self) -> int:
        """How many resonances the glide moves, from the lowest."""
        return 1 if self.glide.with_flow else len(self.resonances)

    def scaled(self, factor: float) -> Tract:
        """The same tract, shorter by `factor`: resonances and dips times it; tilt and high-pass belong to the noise."""
        return replace(
            self,
            resonances=tuple(r._replace(frequency=r[0] * factor, bandwidth=r[1] * factor) for r in self.resonances),
            dips=tuple(Dip(*(value * factor for value in dip)) for dip in self.dips),
        )


FOLLOWING = Glide(0.9, 1.1, 1.0, True)
"""F1 and tilt follow the flow (physiology 3.3; Werner 2021)."""
FALLING, RISING, CLOSING = Glide(1.15, 1.05, 0.75, False), Glide(0.8, 1.1, 1.2, False), Glide(1.0, 1.0, 0.8, False)
"""The mouth closes on a sigh, opens on a gasp; ours."""
LENGTHS: Mapping[Speaker, float] = MappingProxyType({"male": 17.0, "female": 14.5, "child": 12.0})
"""Vocal tracts of a man, a woman and an eight-year-old, cm (physiology 3.4)."""


def nearest(length: float) -> Speaker:
    """The speaker whose vocal tract is nearest in length.

    Args:
        length: cm.

    >>> nearest(17.5), nearest(14.0), nearest(6.0)
    ('male', 'female', 'child')
    """
    return min(LENGTHS, key=lambda speaker: abs(LENGTHS[speaker] - length))


def _tract(
    *rows: tuple[float, float, float],
    floor: float,
    tilt: float,
    highpass: float,
    dips: tuple[Dip, ...] = (),
    glide: Glide = FOLLOWING,
) -> Tract:
    return Tract(
        resonances=tuple(Resonance(*row) for row in rows),
        floor_db=floor,
        tilt=tilt,
        highpass=highpass,
        dips=dips,
        glide=glide,
    )


# fmt: off
_MOUTH_MALE = _tract(
    (600, 250, 0), (1500, 250, 0), (2500, 300, -4), (3500, 400, -8), floor=-16, tilt=2500, highpass=120,
)
_MOUTH_FEMALE = _tract(
    (700, 280, 0), (1750, 280, 0), (2850, 340, -4), (4000, 450, -8), floor=-16, tilt=3000, highpass=150,
)
_MOUTH_CHILD = _tract(
    (850, 320, 0), (2100, 340, 0), (3500, 420, -4), (4800, 520, -8), floor=-16, tilt=3600, highpass=180,
)
_NOSE_MALE = _tract(
    (680, 250, 0), (1150, 350, -5), (2100, 450, -4), (2900, 500, 0), (4300, 800, -6),
    floor=-14, tilt=3000, highpass=150, dips=(Dip(480, 120, 400), Dip(1500, 200, 600)),
)
_NOSE_FEMALE = _tract(
    (750, 270, 0), (1300, 380, -5), (2350, 500, -4), (3250, 550, 0), (4800, 900, -6),
    floor=-14, tilt=3400, highpass=170, dips=(Dip(540, 130, 450), Dip(1700, 220, 650)),
)
_EXHALE = _tract((550, 300, 0), (1450, 300, -3), (2450, 350, -9), floor=-20, tilt=1500, highpass=100)
_SIGH = _tract(
    (680, 240, 0), (1150, 240, -2), (2500, 320, -9), (3500, 450, -14),
    floor=-20, tilt=1900, highpass=110, glide=FALLING,
)  # a wide open [a]-like mouth, soft
_GASP = _tract(
    (780, 300, -2), (1650, 300, 0), (2800, 340, 0), (3900, 450, -2), (5300, 700, -5),
    floor=-13, tilt=4500, highpass=220, glide=RISING,
)  # a wide open mouth and fast air
_SNIFF = _tract(
    (700, 320, -6), (1250, 400, -8), (2400, 500, -3), (3300, 550, 0), (4900, 900, 0), (7000, 1300, -3),
    floor=-12, tilt=6500, highpass=300, dips=(Dip(480, 120, 400), Dip(1500, 200, 600)),
)  # nostrils drawn in: narrow, and the jet is bright
_LAUGH = _tract(
    (720, 150, 0), (1250, 170, -1), (2500, 220, -8), (3500, 320, -12),
    floor=-24, tilt=2400, highpass=160, glide=CLOSING,
)  # an [h] before [a]
_HOLD = _tract((320, 180, 0), (900, 260, -8), (2200, 400, -16), floor=-24, tilt=900, highpass=70, glide=CLOSING)
# the folds meet under a still tract: low and dull
# fmt: on

_MALES: Mapping[Kind, Tract] = {
    "exhale": _EXHALE, "sigh": _SIGH, "gasp": _GASP, "sniff": _SNIFF, "laugh": _LAUGH, "hold": _HOLD,
}  # fmt: skip
_BY_FEMALE = 1.15  # rows of women in physiology 3.4 are about those of men by this
_BY_CHILD = LENGTHS["female"] / LENGTHS["child"]

TRACTS: Mapping[tuple[Kind, Speaker], Tract] = MappingProxyType(
    {
        ("mouth", "male"): _MOUTH_MALE,
        ("mouth", "female"): _MOUTH_FEMALE,
        ("mouth", "child"): _MOUTH_CHILD,
        ("nose", "male"): _NOSE_MALE,
        ("nose", "female"): _NOSE_FEMALE,
        ("nose", "child"): _NOSE_FEMALE.scaled(_BY_CHILD),
        **{(kind, "male"): tract for kind, tract in _MALES.items()},
        **{(kind, "female"): tract.scaled(_BY_FEMALE) for kind, tract in _MALES.items()},
        **{(kind, "child"): tract.scaled(_BY_FEMALE * _BY_CHILD) for kind, tract in _MALES.items()},
    }
)
"""Rows of physiology 3.4; where it has none, the nearest row scaled by the length of the tract."""
