"""The body that breathes, from sex, age, height, posture and condition (physiology 2.1, 1.5, 2.3, 3.4)."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.parameters.table import Parameters


@dataclass(frozen=True, slots=True, kw_only=True)
class Physique:
    """What does not change while somebody speaks."""

    vital_capacity: float
    """L, on a grid of 0.01; without `capacity_lung`, which scales it"""
    resting_volume: float
    """end-expiratory level, fraction of VC"""
    thorax_share: float
    """0..1"""
    vocal_tract: float
    """cm"""


def physique(p: Parameters) -> Physique:
    """The body of these parameters; what was set by hand wins."""
    return Physique(
        vital_capacity=p.vital_capacity or 5.1,
        resting_volume=p.resting_volume or 0.38,
        thorax_share=1.0 - p.abdomen_share,
        vocal_tract=p.vocal_tract_length or 17.0,
    )
