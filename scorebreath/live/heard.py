"""What moving a parameter does to what sounds already: the ratio of what it would be now to what it was made with."""

from __future__ import annotations

from scorebreath.parameters.derive import derive
from scorebreath.parameters.table import Parameters
from scorebreath.score.performing import MOST_HEARD, Heard
from scorebreath.units import amplitude, snap

AS_MADE = Heard()
"""Everything sounds as its events say."""


def heard(made: Parameters, now: Parameters) -> Heard:
    """How what was made with some parameters sounds with others.

    Gains are ratios; what was silent stays so until the next breath. `breath_sound` off is silence.

    >>> heard(Parameters(), Parameters(breath_level=-18.0)).mouth
    1.995262
    >>> heard(Parameters(), Parameters(nose_share=0.7)).nose
    2.0
    """
    was, are = derive(made), derive(now)
    level = amplitude(now.breath_level - made.breath_level) if now.breath_sound or not made.breath_sound else 0.0
    return Heard(
        speech=_ratio(are.prosody_loudness, was.prosody_loudness),
        mouth=_ratio(level * are.amplitude_sound_mouth, was.amplitude_sound_mouth),
        nose=_ratio(level * are.amplitude_sound_nose, was.amplitude_sound_nose),
        brightness=snap(min(4.0, max(0.25, now.breath_brightness / made.breath_brightness))),
    )


def _ratio(now: float, made: float) -> float:
    return snap(min(MOST_HEARD, now / made)) if made > 0.0 else 1.0
