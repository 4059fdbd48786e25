"""Numbers of MaryXML: lengths in ms or s, rates, pitches, volumes.

What goes further than a voice can follow is taken as far as it goes: MaryTTS's rules for emotions write such values.
"""

from __future__ import annotations

import math
import re

from scorebreath.script.markup import values
from scorebreath.script.markup.quantities import LONGEST_PAUSE

MIDDLE_VOLUME = 50.0
"""Of MaryXML's scale from 0 to 100, where a voice is as loud as by itself."""
LEAST_MS = 10.0
"""A length with a decimal point below it is in seconds: nobody tells of a pause of some milliseconds."""
HIGHEST_INDEX = 6

_LENGTH = re.compile(r"([0-9]{1,9}(?:\.[0-9]{0,9})?|\.[0-9]{1,9})\s*(ms|s|)", re.IGNORECASE)
_CHANGE = re.compile(r"(?P<sign>[+-]?)(?P<number>[0-9]{1,9}(?:\.[0-9]{0,9})?)(?P<unit>%|st|)")
_HERTZ = re.compile(r"[0-9]{1,9}(?:\.[0-9]{0,9})?(?:hz|Hz|HZ)?")

LENGTH_FORM = f"a length in ms such as 200, or 200ms, 0.2s, at most {LONGEST_PAUSE:g} s"
RATE_FORM = f"{', '.join(values.RATES)}, or such as +20%, 1.2"
PITCH_FORM = f"{', '.join(values.PITCHES)}, or such as +20%, -2st, 120Hz"
VOLUME_FORM = f"{', '.join(values.VOLUMES)}, 0 to 100, or such as +10, +10%"
INDEX_FORM = f"none, or 1 to {HIGHEST_INDEX}"


def length(text: str) -> float | None:
    """Seconds of a silence; a bare number is milliseconds.

    >>> length("200"), length("200ms"), length("0.2s"), length("0.2"), length("70.0"), length("1h")
    (0.2, 0.2, 0.2, 0.2, 0.07, None)
    """
    match = _LENGTH.fullmatch(text)
    if match is None:
        return None
    value, unit = float(match[1]), match[2].lower()
    seconds = unit == "s" or (not unit and "." in match[1] and value < LEAST_MS)
    value = round(value if seconds else value / 1000.0, 6)
    return value if value <= LONGEST_PAUSE else None


def break_index(text: str) -> int | None:
    """Of a boundary; `none`: no more than between any two words.

    >>> break_index("4"), break_index("none"), break_index("7")
    (4, 1, None)
    """
    if text == "none":
        return 1
    return int(text) if text.isascii() and text.isdecimal() and 1 <= int(text) <= HIGHEST_INDEX else None


def rate(text: str) -> float | None:
    """A speaking rate as a factor.

    >>> rate("+20%"), rate("-90%"), rate("1.2"), rate("slow"), rate("+20"), rate("quick")
    (1.2, 0.5, 1.2, 0.8, 1.2, None)
    """
    return values.RATES[text] if text in values.RATES else _factor(text)


def pitch(text: str) -> float | None:
    """A change of pitch as a factor; hertz change nothing, for what they change depends on the voice.

    >>> pitch("-50%"), pitch("+12st"), pitch("120Hz"), pitch("120"), pitch("high"), pitch("up")
    (0.5, 2.0, 1.0, 1.0, 1.18, None)
    """
    if text in values.PITCHES:
        return values.PITCHES[text]
    return 1.0 if _HERTZ.fullmatch(text) else _factor(text)


def volume(text: str) -> float | None:
    """A change of level, dB.

    >>> volume("50"), volume("100"), volume("+0%"), volume("loud"), volume("0"), volume("max")
    (0.0, 6.0206, 0.0, 6.0, -60.0, None)
    """
    if text in values.VOLUMES:
        return values.VOLUMES[text]
    match = _CHANGE.fullmatch(text)
    if match is None or match["unit"] == "st":
        return None
    told = float(match["sign"] + match["number"])
    if match["unit"] == "%":
        told = MIDDLE_VOLUME * (1.0 + told / 100.0)
    elif match["sign"]:
        told += MIDDLE_VOLUME
    low, high = values.DECIBELS
    level = 20.0 * math.log10(told / MIDDLE_VOLUME) if told > 0.0 else low
    return round(min(max(level, low), high), 6) + 0.0


def _factor(text: str) -> float | None:
    """A change in percent (a sign makes it one) or semitones, or a factor, within bounds."""
    match = _CHANGE.fullmatch(text)
    if match is None:
        return None
    told, unit = float(match["sign"] + match["number"]), match["unit"]
    factor: float
    if unit == "st":
        factor = 2.0 ** (min(max(told, -99.0), 99.0) / 12.0)
    elif match["sign"]:
        factor = 1.0 + told / 100.0
    else:
        factor = told / 100.0 if unit else told
    low, high = values.FACTORS
    return round(min(max(factor, low), high), 6)
