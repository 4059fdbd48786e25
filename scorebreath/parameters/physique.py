"""The body that breathes, from sex, age, height, posture and condition (physiology 2.1, 1.5, 2.3, 3.4)."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.equations.spirometry import fvc_ecsc_1993, fvc_gli_2022
from scorebreath.equations.vocal_tract import vocal_tract_length
from scorebreath.parameters.table import Parameters, bounds

RESTING_VOLUME = {"upright": 0.38, "reclined": 0.30, "supine": 0.22}
"""End-expiratory level, fraction of VC (physiology 2.2); reclined: half-way."""
THORAX_SHARE = {"upright": 0.65, "reclined": 0.475, "supine": 0.30}
"""Of the volume (physiology 2.3); reclined: half-way."""
WOMAN_THORAX, PARKINSON_THORAX = 0.05, -0.15
"""Shifts of that share (physiology 2.3, 1.5)."""
EQUATIONS = {"gli-2022": fvc_gli_2022, "ecsc-1993": fvc_ecsc_1993}
GRID = 100
"""Steps a litre and a centimetre: lungs and tracts are not known any better."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Physique:
    """What does not change while somebody speaks."""

    vital_capacity: float
    """L, on a grid of 0.01; without `capacity_lung`, which scales it"""
    resting_volume: float
    """end-expiratory level, fraction of VC"""
    thorax_share: float
    """0..1"""
    vocal_tract_length: float
    """cm"""


def physique(p: Parameters) -> Physique:
    """The body of these parameters; what was set by hand wins.

    Raises:
        ParameterError: The equation for vital capacity does not hold for this age; names what does.

    >>> physique(Parameters())
    Physique(vital_capacity=5.1, resting_volume=0.38, thorax_share=0.65, vocal_tract_length=17.0)
    >>> physique(Parameters(sex="female", height=165.0, posture="supine")).vital_capacity
    3.68
    """
    return Physique(
        vital_capacity=_predicted_capacity(p) if p.vital_capacity is None else p.vital_capacity,
        resting_volume=RESTING_VOLUME[p.posture] if p.resting_volume is None else p.resting_volume,
        thorax_share=thorax_share(p),
        vocal_tract_length=_predicted_tract(p) if p.vocal_tract_length is None else p.vocal_tract_length,
    )


def _predicted_capacity(p: Parameters) -> float:
    litres = EQUATIONS[p.capacity_equation](p.sex, p.age, p.height)
    return _within("vital_capacity", litres)


def _predicted_tract(p: Parameters) -> float:
    return _within("vocal_tract_length", vocal_tract_length(p.sex, p.age, p.height))


def thorax_share(p: Parameters) -> float:
    """The chest's share of a breath's volume, 0..1: by hand (`abdomen_share`), or by posture, sex and condition.

    >>> thorax_share(Parameters(sex="female")), thorax_share(Parameters(sex="female", abdomen_share=0.5))
    (0.7, 0.5)
    """
    if "abdomen_share" in p.model_fields_set:
        return 1.0 - p.abdomen_share
    share = THORAX_SHARE[p.posture]
    if p.sex == "female":
        share += WOMAN_THORAX
    if p.condition == "parkinson":
        share += PARKINSON_THORAX
    return round(share, 6)


def _within(name: str, value: float) -> float:
    """On the grid, and within what may be set by hand."""
    low, high = bounds(name) or (value, value)
    return min(high, max(low, round(value * GRID) / GRID))
