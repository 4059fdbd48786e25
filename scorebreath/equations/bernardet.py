r"""The equations of Bernardet et al. 2017 (S2) and 2019 (S1): Eq. 1 and the driver.

Percent are percent: capacity and loudness are 100 for a healthy adult at a comfortable level (X3).
"""

from __future__ import annotations

from math import sqrt

from scorebreath.errors import ParameterError


def amplitude_sound_nose(nose_share: float, amplitude_breathing_sound: float) -> float:
    r"""Eq. 1 (S1 3.2.1, B31): :math:`amplitude_{sound\,nose} = MouthVsNose \cdot amplitude_{breathing\,sound}`.

    >>> amplitude_sound_nose(0.25, 0.8)
    0.2
    """
    return nose_share * amplitude_breathing_sound


def amplitude_sound_mouth(nose_share: float, amplitude_breathing_sound: float) -> float:
    r"""Eq. 1 (S1 3.2.1, B32): :math:`(1 - MouthVsNose) \cdot amplitude_{breathing\,sound}`.

    >>> round(amplitude_sound_mouth(0.25, 0.8), 6)
    0.6
    """
    return (1.0 - nose_share) * amplitude_breathing_sound


def amplitude_nostril_flare(nose_share: float, opening_inspiration_channels: float) -> float:
    r"""Eq. 1 (S1 3.2.1, B33): :math:`MouthVsNose \cdot opening_{inspiration\,channels}`.

    >>> amplitude_nostril_flare(0.5, 0.3)
    0.15
    """
    return nose_share * opening_inspiration_channels


def amplitude_mouth_open(nose_share: float, opening_inspiration_channels: float) -> float:
    r"""Eq. 1 (S1 3.2.1, B34): :math:`(1 - MouthVsNose) \cdot opening_{inspiration\,channels}`.

    >>> amplitude_mouth_open(0.5, 0.3)
    0.15
    """
    return (1.0 - nose_share) * opening_inspiration_channels


def volume_abdomen(abdomen_share: float, capacity_lung: float) -> float:
    r"""Eq. 1 (S1 3.2.1, B35): :math:`ThoraxVsAbdomen \cdot capacity_{lung} / 100`.

    >>> volume_abdomen(0.25, 64)
    0.16
    """
    return abdomen_share * capacity_lung / 100.0


def volume_thorax(abdomen_share: float, capacity_lung: float) -> float:
    r"""Eq. 1 (S1 3.2.1, B36): :math:`(1 - ThoraxVsAbdomen) \cdot capacity_{lung} / 100`.

    >>> volume_thorax(0.25, 64)
    0.48
    """
    return (1.0 - abdomen_share) * capacity_lung / 100.0


def length_utterance(capacity_lung: float, speaking_loudness: float, norm_syllables: float) -> float:
    r"""Eq. 1 (S1 3.2.1, B37, X2): :math:`\sqrt{capacity_{lung} / speaking_{loudness}} \cdot norm_{syllables}`.

    Args:
        capacity_lung: Percent.
        speaking_loudness: Percent, above 0 (X3).
        norm_syllables: Syllables said on a breath at capacity = loudness.

    Returns:
        Syllables.

    Raises:
        ParameterError: The loudness is 0 or below.

    >>> length_utterance(64, 100, 20)
    16.0
    """
    if speaking_loudness <= 0:
        raise ParameterError(f"speaking_loudness={speaking_loudness:g} must be above 0: Eq. 1 divides by it")
    return sqrt(capacity_lung / speaking_loudness) * norm_syllables


def length_inspiration(capacity_lung: float) -> float:
    r"""Eq. 1 (S1 3.2.1, B38, X1): :math:`capacity_{lung} / 100`, seconds.

    >>> length_inspiration(64)
    0.64
    """
    return capacity_lung / 100.0


def urgency_limit(length_utterance: float) -> float:
    r"""Eq. 1 (S1 3.2.1, B39, X4): :math:`2 \cdot length_{utterance}`, compared with characters.

    >>> urgency_limit(16)
    32.0
    """
    return 2.0 * length_utterance


def volume_lung(capacity_lung: float, syllables: float, length_utterance: float) -> float:
    r"""The breath's volume as "a function of the length of the upcoming speech" (S1 3.2, B7; our reading of X14).

    :math:`capacity_{lung}/100 \cdot \min(1, syllables / length_{utterance})`: full for a full utterance, less for less.

    >>> volume_lung(64, 8, 16)
    0.32
    """
    return capacity_lung / 100.0 * min(1.0, syllables / length_utterance)


def slope_inspiration(volume_lung: float, length_inspiration: float) -> float:
    r"""Slope of the driver LF while breathing in (S1 3.2, B6): :math:`volume_{lung} / length_{inspiration}`, 1/s.

    >>> slope_inspiration(0.32, 0.64)
    0.5
    """
    return volume_lung / length_inspiration


def slope_expiration(volume_lung: float, length_speech: float) -> float:
    r"""Slope of the driver while speaking (S1 3.2, B12): :math:`-volume_{lung} / length_{speech}`, 1/s.

    >>> slope_expiration(0.32, 1.28)
    -0.25
    """
    return -volume_lung / length_speech
