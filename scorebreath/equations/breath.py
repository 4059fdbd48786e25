"""Sound and length of a breath: physiology, one function an equation."""

from __future__ import annotations

from math import hypot, log10

NOSE_BELOW_MOUTH_DB = 6.0
"""Level of the nose's sound below the mouth's at equal flow (physiology 3.2)."""

ATTACK, RELEASE = 0.25, 0.30
"""Shares of a breath's length that its trapezoid rises and falls (physiology 3.3)."""


def mix_level(sound_mouth: float, sound_nose: float) -> float:
    r"""Level of mouth and nose together, dB re the mouth alone at gain 1 (physiology 3.2).

    The two noises are uncorrelated: :math:`20 \log_{10} \sqrt{m^2 + (n \cdot 10^{-6/20})^2}`.

    >>> mix_level(1.0, 0.0), round(mix_level(0.0, 1.0), 6)
    (0.0, -6.0)
    """
    return 20.0 * log10(hypot(sound_mouth, sound_nose * 10.0 ** (-NOSE_BELOW_MOUTH_DB / 20.0)))


def trapezoid(length: float) -> tuple[float, float, float]:
    """Attack, hold and release of a breath of `length` seconds (X17; physiology 3.3).

    >>> trapezoid(1.0)
    (0.25, 0.45, 0.3)
    """
    attack, release = ATTACK * length, RELEASE * length
    return attack, length - attack - release, release


def inspiration_length(base: float, per_syllable: float, syllables: float, deviation: float, site: float) -> float:
    r"""Length of a speech inspiration, 0.25..1.10 s (physiology 1.3): :math:`(T_0 + a N + \epsilon) \cdot s`.

    Args:
        base: :math:`T_0`, s.
        per_syllable: :math:`a`, s/syllable: longer utterances are breathed for longer (Fuchs et al. 2013).
        syllables: :math:`N`, of the coming utterance.
        deviation: :math:`\epsilon`, s: this breath's own.
        site: :math:`s`: 1 at an ordinary boundary, below at none, above after a paragraph.

    >>> round(inspiration_length(0.42, 0.01, 18, 0.0, 1.0), 6)
    0.6
    """
    return min(1.10, max(0.25, (base + per_syllable * syllables + deviation) * site))


def initiation_volume(termination: float, per_syllable: float, syllables: float) -> float:
    r"""Lung volume at which speech begins, fraction of VC (physiology 2.2): what will be spent, above the termination.

    >>> round(initiation_volume(0.36, 0.009, 18), 6)
    0.522
    """
    return min(0.95, termination + per_syllable * syllables)
