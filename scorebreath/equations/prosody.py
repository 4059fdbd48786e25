"""Pitch over a breath, and what pressure does to the voice (physiology 2.5, 5)."""

from __future__ import annotations

import math

OCTAVE = 12.0
"""semitones"""
LONG = 5.0
"""s; from here on a longer phrase falls no further"""
COMFORTABLE = 6.5
"""cmH2O below the larynx in ordinary speech (physiology 2.5)"""
DB_PER_DOUBLING = {"female": 11.1, "male": 9.3}
"""What twice the pressure gives (physiology 2.5: Björklund & Sundberg 2016)."""


def declination(seconds: float) -> float:
    r"""Slope of pitch over a phrase, st/s: -11 / (T + 1.5), and -8.5 / T from 5 s on.

    Physiology 5 ('t Hart, Collier & Cohen 1990).

    >>> declination(4.0), declination(10.0)
    (-2.0, -0.85)
    """
    return -8.5 / seconds if seconds > LONG else -11.0 / (seconds + 1.5)


def pressure(louder_db: float, sex: str) -> float:
    r"""Pressure below the larynx for a voice so much louder than comfortable, cmH2O: 6.5 * 2^(dB / k).

    Physiology 2.5.

    >>> round(pressure(9.3, "male"), 6), round(pressure(0.0, "female"), 6)
    (13.0, 6.5)
    """
    return COMFORTABLE * math.exp2(louder_db / DB_PER_DOUBLING[sex])


def pressed_semitones(louder_db: float, sex: str, hertz: float, per_pressure: float) -> float:
    r"""How much higher a voice is that is so much louder, st: 12 log2(1 + c (Ps - Ps0) / F0).

    Physiology 5.

    Args:
        louder_db: dB above comfortable.
        sex: `female` or `male`.
        hertz: F0, its usual pitch.
        per_pressure: c, Hz/cmH2O.

    >>> round(pressed_semitones(6.0, "male", 120.0, 4.0), 2), round(pressed_semitones(-6.0, "male", 120.0, 4.0), 2)
    (2.0, -1.41)
    """
    if hertz <= 0.0:
        return 0.0
    moved = per_pressure * (pressure(louder_db, sex) - COMFORTABLE)
    return OCTAVE * math.log2(max(0.5, 1.0 + moved / hertz))
