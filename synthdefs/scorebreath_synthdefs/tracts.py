"""Vocal tracts that a breath sounds through: physiology 3.4 as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Literal, NamedTuple

Route = Literal["mouth", "nose", "exhale"]
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
    dips: tuple[Dip, ...] = ()

    def scaled(self, factor: float) -> Tract:
        """The same tract, shorter by `factor`: resonances and dips times it; tilt and high-pass belong to the noise."""
        return replace(
            self,
            resonances=tuple(r._replace(frequency=r[0] * factor, bandwidth=r[1] * factor) for r in self.resonances),
            dips=tuple(Dip(*(value * factor for value in dip)) for dip in self.dips),
        )


def _tract(
    *rows: tuple[float, float, float], floor: float, tilt: float, highpass: float, dips: tuple[Dip, ...]
) -> Tract:
    return Tract(
        resonances=tuple(Resonance(*row) for row in rows), floor_db=floor, tilt=tilt, highpass=highpass, dips=dips
    )


FEMALE_LENGTH, CHILD_LENGTH = 14.5, 12.0
"""Vocal tracts of a woman and an eight-year-old, cm (physiology 3.4)."""

# fmt: off
_MOUTH_MALE = _tract(
    (600, 250, 0), (1500, 250, 0), (2500, 300, -4), (3500, 400, -8), floor=-16, tilt=2500, highpass=120, dips=(),
)
_MOUTH_FEMALE = _tract(
    (700, 280, 0), (1750, 280, 0), (2850, 340, -4), (4000, 450, -8), floor=-16, tilt=3000, highpass=150, dips=(),
)
_MOUTH_CHILD = _tract(
    (850, 320, 0), (2100, 340, 0), (3500, 420, -4), (4800, 520, -8), floor=-16, tilt=3600, highpass=180, dips=(),
)
_NOSE_MALE = _tract(
    (680, 250, 0), (1150, 350, -5), (2100, 450, -4), (2900, 500, 0), (4300, 800, -6),
    floor=-14, tilt=3000, highpass=150, dips=(Dip(480, 120, 400), Dip(1500, 200, 600)),
)
_NOSE_FEMALE = _tract(
    (750, 270, 0), (1300, 380, -5), (2350, 500, -4), (3250, 550, 0), (4800, 900, -6),
    floor=-14, tilt=3400, highpass=170, dips=(Dip(540, 130, 450), Dip(1700, 220, 650)),
)
_EXHALE = _tract((550, 300, 0), (1450, 300, -3), (2450, 350, -9), floor=-20, tilt=1500, highpass=100, dips=())
# fmt: on

TRACTS: Mapping[tuple[Route, Speaker], Tract] = MappingProxyType(
    {
        ("mouth", "male"): _MOUTH_MALE,
        ("mouth", "female"): _MOUTH_FEMALE,
        ("mouth", "child"): _MOUTH_CHILD,
        ("nose", "male"): _NOSE_MALE,
        ("nose", "female"): _NOSE_FEMALE,
        ("nose", "child"): _NOSE_FEMALE.scaled(FEMALE_LENGTH / CHILD_LENGTH),
        ("exhale", "male"): _EXHALE,
        ("exhale", "female"): _EXHALE.scaled(1.15),
        ("exhale", "child"): _EXHALE.scaled(1.15 * FEMALE_LENGTH / CHILD_LENGTH),
    }
)
"""Rows of physiology 3.4; where it has none, the nearest row scaled by the length of the tract."""
