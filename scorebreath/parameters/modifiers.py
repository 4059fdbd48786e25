"""What a person and the states of the moment make of the neutral speaker's breathing (physiology 1.5, 4.2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from scorebreath.parameters.table import Parameters


@dataclass(frozen=True, slots=True, kw_only=True)
class Modifiers:
    """Factors are 1, shifts 0 and chances 0 for the neutral speaker; shares and times are what is in force."""

    syllables: float = 1.0
    """x preferred length of a breath group"""
    inspiration: float = 1.0
    """x length of an inspiration for speech"""
    volume: float = 1.0
    """x volume spent on a syllable"""
    start: float = 0.0
    """shift of the levels at which speech begins and ends, fraction of VC"""
    pause: float = 1.0
    """x silences before a breath"""
    delay: float = 1.0
    """x silence between a breath and the first phone"""
    thorax_share: float = 0.65
    """of the volume, 0..1"""
    nose_share: float = 0.35
    """of the air breathed in for speech, 0..1"""
    breath_db: float = 0.0
    """dB by which breaths are louder, on top of what their flow does"""
    variation: float = 0.15
    """coefficient of variation of resting cycles; speech breaths vary by as much more or less as this differs from 0.15"""
    brightness: float = 1.0
    """x resonances"""
    flare: float = 1.0
    """x nostril flare"""
    tremor: float = 0.0
    """share by which the thorax trembles"""
    rate: float = 1.0
    """x resting rate"""
    depth: float = 1.0
    """x resting tidal volume"""
    fraction: float = 0.40
    """inspiration's share of a resting cycle"""
    rest_pause: float = 0.3
    """s between a resting expiration and the next inspiration"""
    sigh_interval: float = 0.0
    """s between sighs; 0: none"""
    hold_chance: float = 0.0
    """chance that a breath is held before speech"""
    hold_length: float = 0.5
    """s that it then is held"""
    gasp_chance: float = 0.0
    """chance that an inspiration for speech is a gasp"""
    saccades: int = 1
    """parts in which an inspiration is drawn"""
    laugh_chance: float = 0.0
    """chance that laughter follows a group that ends its sentence"""
    puff_chance: float = 0.0
    """chance that a puff through the nose follows such a group"""
    exhale_chance: float = 0.0
    """chance that what is left in the lungs is let out audibly before the next breath"""


def modifiers(p: Parameters, states: Mapping[str, float]) -> Modifiers:
    """All that modifies breathing now.

    Args:
        p: Age, sex, posture, condition, loudness, rate, style; what was set by hand wins.
        states: Intensity of each state, 0..1 (`parameters.states`).
    """
    return Modifiers(thorax_share=1.0 - p.abdomen_share, nose_share=p.nose_share)
