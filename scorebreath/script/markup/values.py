"""Values of SSML's attributes, as tables: what a word such as `x-loud` means in numbers.

SSML 1.1 leaves the numbers to the processor. Pauses, rates and levels here are ours: steps that can be told apart.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

BREAKS: Mapping[str, float] = {"x-weak": 0.1, "weak": 0.2, "medium": 0.4, "strong": 0.8, "x-strong": 1.2}
"""s; SSML 1.1, 3.2.3. `none` is no pause and no breath."""
RATES: Mapping[str, float] = {
    "x-slow": 0.6, "slow": 0.8, "medium": 1.0, "default": 1.0, "fast": 1.25, "x-fast": 1.6,
}  # fmt: skip
PITCHES: Mapping[str, float] = {
    "x-low": 0.7, "low": 0.85, "medium": 1.0, "default": 1.0, "high": 1.18, "x-high": 1.4,
}  # fmt: skip
VOLUMES: Mapping[str, float] = {
    "silent": -60.0, "x-soft": -12.0, "soft": -6.0, "medium": 0.0, "default": 0.0, "loud": 6.0, "x-loud": 12.0,
}  # fmt: skip
"""dB"""
BREATH_LEVELS: Mapping[str, float] = {name: level for name, level in VOLUMES.items() if name != "silent"}
"""dB; `volume` of Amazon's breaths"""
BREATH_LENGTHS: Mapping[str, float] = {
    "x-short": 0.5, "short": 0.75, "medium": 1.0, "default": 1.0, "long": 1.4, "x-long": 1.8,
}  # fmt: skip
"""`duration` of Amazon's breaths"""
BREATH_FREQUENCIES: Mapping[str, float] = {
    "x-low": 0.5, "low": 0.7, "medium": 1.0, "default": 1.0, "high": 1.4, "x-high": 2.0,
}  # fmt: skip
"""`frequency` of Amazon's breaths"""
FACTORS = (0.5, 2.0)
"""Rate and pitch: least, most."""
DECIBELS = (-60.0, 20.0)


@dataclass(frozen=True, slots=True)
class Prosody:
    """How the voice speaks, relative to by itself."""

    rate: float = 1.0
    pitch: float = 1.0
    volume_db: float = 0.0
    emphasis: bool = False

    def then(self, other: Prosody) -> Prosody:
        """What is in force inside both: the product, within `FACTORS` and `DECIBELS`."""
        return Prosody(
            _within(self.rate * other.rate, FACTORS),
            _within(self.pitch * other.pitch, FACTORS),
            _within(self.volume_db + other.volume_db, DECIBELS),
            other.emphasis,
        )


EMPHASES: Mapping[str, Prosody] = {
    "strong": Prosody(0.85, 1.1, 3.0, True),
    "moderate": Prosody(0.92, 1.05, 1.5, True),
    "none": Prosody(),
    "reduced": Prosody(1.08, 0.97, -2.0),
}

_FACTOR = re.compile(r"(?P<sign>[+-]?)(?P<number>[0-9]{1,6}(?:\.[0-9]{0,6})?|\.[0-9]{1,6})(?P<unit>%|st|dB|db|)")

RATE_FORM = f"{', '.join(RATES)}, or such as 80%, +10%, 1.2, at least {FACTORS[0]:g}, at most {FACTORS[1]:g}"
PITCH_FORM = f"{', '.join(PITCHES)}, or such as +2st, +10%, 1.2, at least {FACTORS[0]:g}, at most {FACTORS[1]:g}"
VOLUME_FORM = f"{', '.join(VOLUMES)}, or such as +6dB, at least {DECIBELS[0]:g}, at most {DECIBELS[1]:g} dB"


def rate(text: str) -> float | None:
    """A speaking rate as a factor, or None.

    >>> rate("slow"), rate("80%"), rate("+10%"), rate("1.2"), rate("9"), rate("quick")
    (0.8, 0.8, 1.1, 1.2, None, None)
    """
    return RATES[text] if text in RATES else _factor(text)


def pitch(text: str) -> float | None:
    """A change of pitch as a factor, or None; hertz are none, for what they change depends on the voice.

    >>> pitch("+12st"), pitch("-10%"), pitch("high"), pitch("200Hz")
    (2.0, 0.9, 1.18, None)
    """
    return PITCHES[text] if text in PITCHES else _factor(text)


def volume(text: str) -> float | None:
    """A change of level in dB, or None.

    >>> volume("+6dB"), volume("-3.5dB"), volume("x-soft"), volume("50")
    (6.0, -3.5, -12.0, None)
    """
    if text in VOLUMES:
        return VOLUMES[text]
    match = _FACTOR.fullmatch(text)
    if match is None or match["unit"].lower() != "db":
        return None
    level = float(match["sign"] + match["number"]) + 0.0
    return level if DECIBELS[0] <= level <= DECIBELS[1] else None


def _factor(text: str) -> float | None:
    """A factor, a percentage (with a sign: a change), or semitones (with a sign), within bounds."""
    match = _FACTOR.fullmatch(text)
    if match is None:
        return None
    sign, value, unit = match["sign"], float(match["number"]), match["unit"]
    signed = -value if sign == "-" else value
    if unit == "%":
        factor = 1.0 + signed / 100.0 if sign else value / 100.0
    elif unit == "st" and sign:
        factor = 2.0 ** (min(signed, 99.0) / 12.0)
    elif not unit and not sign:
        factor = value
    else:
        return None
    factor = round(factor, 6)
    return factor if FACTORS[0] <= factor <= FACTORS[1] else None


def _within(value: float, bounds: tuple[float, float]) -> float:
    return round(min(max(value, bounds[0]), bounds[1]), 6)
