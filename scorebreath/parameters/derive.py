"""From abstract to low-level parameters: Eq. 1, value by value, hand-set values first."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.equations import bernardet as eq
from scorebreath.parameters.table import Parameters


@dataclass(frozen=True, slots=True, kw_only=True)
class LowLevel:
    """The low-level parameters in force (B31-B39, X12), each set by hand or derived."""

    amplitude_sound_nose: float
    amplitude_sound_mouth: float
    amplitude_nostril_flare: float
    amplitude_mouth_open: float
    volume_abdomen: float
    volume_thorax: float
    length_utterance: float
    """syllables"""
    length_inspiration: float
    """s"""
    urgency_limit: float
    """characters"""
    prosody_loudness: float
    """percent"""


def derive(p: Parameters) -> LowLevel:
    """Eq. 1 (S1 3.2.1) for every low-level parameter that was not set by hand.

    >>> low = derive(Parameters(capacity_lung=64.0, norm_syllables=20.0))
    >>> low.length_utterance, low.urgency_limit, low.length_inspiration
    (16.0, 32.0, 0.64)
    """

    def chosen(by_hand: float | None, derived: float) -> float:
        return derived if by_hand is None else by_hand

    utterance = chosen(p.length_utterance, eq.length_utterance(p.capacity_lung, p.speaking_loudness, p.norm_syllables))
    sound, opening = p.amplitude_breathing_sound, p.opening_inspiration_channels
    return LowLevel(
        amplitude_sound_nose=chosen(p.amplitude_sound_nose, eq.amplitude_sound_nose(p.nose_share, sound)),
        amplitude_sound_mouth=chosen(p.amplitude_sound_mouth, eq.amplitude_sound_mouth(p.nose_share, sound)),
        amplitude_nostril_flare=chosen(p.amplitude_nostril_flare, eq.amplitude_nostril_flare(p.nose_share, opening)),
        amplitude_mouth_open=chosen(p.amplitude_mouth_open, eq.amplitude_mouth_open(p.nose_share, opening)),
        volume_abdomen=chosen(p.volume_abdomen, eq.volume_abdomen(p.abdomen_share, p.capacity_lung)),
        volume_thorax=chosen(p.volume_thorax, eq.volume_thorax(p.abdomen_share, p.capacity_lung)),
        length_utterance=utterance,
        length_inspiration=chosen(p.length_inspiration, eq.length_inspiration(p.capacity_lung)),
        urgency_limit=chosen(p.urgency_limit, eq.urgency_limit(utterance)),
        prosody_loudness=chosen(p.prosody_loudness, p.speaking_loudness),
    )
