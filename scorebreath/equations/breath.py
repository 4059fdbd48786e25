"""Sound and length of a breath: physiology, one function an equation."""

from __future__ import annotations

from math import asin, hypot, log10, pi, sqrt

NOSE_BELOW_MOUTH_DB = 6.0
"""Level of the nose's sound below the mouth's at equal flow (physiology 3.2)."""

ATTACK, RELEASE = 0.25, 0.30
"""Shares of a breath's length that its trapezoid rises and falls (physiology 3.3)."""

FLOW_EXPONENT = 1.66
"""Power of the flow that a breath's amplitude goes with (Gavriely & Cugell 1996, physiology 3.1)."""
LOUD = 0.5
"""Share of the highest amplitude from which a breath under the envelope `flow` counts as loud."""
QUIETEST_DB = -120.0
"""What `flow_level` gives for next to no flow."""
LOUD_SQUARE = (0.67995, 0.02678)
"""Mean square over the loud part of a quarter sine to the power a: first + second / a, to 3e-4 for 0.8..3."""
BRIGHTENING = 0.2
"""Power of the flow that the resonances go with: faster air is brighter (Werner 2021, physiology 3.1; power ours)."""
DARKEST, BRIGHTEST = 0.7, 1.4


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


def flow_level(flow: float, reference: float, exponent: float) -> float:
    r"""Level of a breath re that at a reference flow (physiology 3.1, 3.2): :math:`20 a \log_{10}(F / F_0)`, dB.

    Args:
        flow: :math:`F`, highest of the breath, in any unit; its sign does not matter.
        reference: :math:`F_0`, in the same unit, above 0.
        exponent: :math:`a`: amplitude goes with flow to this power (1.66, Gavriely & Cugell 1996).

    Returns:
        dB, at least `QUIETEST_DB`.

    >>> [round(flow_level(flow, 1.0, 1.66), 1) for flow in (0.5, 1.0, 1.5, 2.0)]
    [-10.0, 0.0, 5.8, 10.0]
    >>> flow_level(0.0, 1.0, 1.66)
    -120.0
    """
    ratio = abs(flow) / reference
    return max(QUIETEST_DB, 20.0 * exponent * log10(ratio)) if ratio > 0 else QUIETEST_DB


def brightness(flow: float, reference: float) -> float:
    r"""What resonances and tilt are multiplied by at a flow: :math:`(F / F_0)^{0.2}`, within 0.7..1.4.

    Formants and centre of gravity rise with the speed of inhalation (Werner 2021, physiology 3.1).

    Args:
        flow: :math:`F`, highest of the breath, in any unit; its sign does not matter.
        reference: :math:`F_0`, in the same unit, above 0.

    >>> [round(brightness(flow, 1.0), 3) for flow in (0.0, 0.5, 1.0, 2.0, 9.0)]
    [0.7, 0.871, 1.0, 1.149, 1.4]
    """
    return min(BRIGHTEST, max(DARKEST, float((abs(flow) / reference) ** BRIGHTENING)))


def loud_share(exponent: float) -> float:
    r"""Share of a quarter sine of flow in which :math:`\sin^a` is at least half: the loud part of a rise or a fall.

    >>> round(loud_share(1.66), 4)
    0.5423
    """
    return 1.0 - asin(LOUD ** (1.0 / exponent)) * 2.0 / pi


def flow_loudness(attack: float, hold: float, release: float, exponent: float) -> float:
    r"""RMS over the loud part of the envelope `flow`, whose highest value is 1.

    The loud part is where amplitude is at least half: all of the hold, and the upper share of either ramp.

    Args:
        attack: s.
        hold: s.
        release: s.
        exponent: Above 0.

    Returns:
        0.5..1; 1 for an envelope of no length.

    >>> flow_loudness(0.0, 1.0, 0.0, 1.66), round(flow_loudness(0.2, 0.0, 0.3, 1.66), 4)
    (1.0, 0.8343)
    """
    ramps = loud_share(exponent) * (attack + release)
    square = LOUD_SQUARE[0] + LOUD_SQUARE[1] / exponent
    return sqrt((hold + square * ramps) / (hold + ramps)) if hold + ramps > 0 else 1.0
