"""What arrives as a value, as the table of parameters wants it."""

from __future__ import annotations

import math
import struct

from scorebreath.errors import InputError, ParameterError, shortened
from scorebreath.live.controls.packets import Argument
from scorebreath.live.desk import Setting
from scorebreath.parameters.assign import parse_assignment
from scorebreath.parameters.table import Parameters, bounds, choices

LONGEST_GLIDE = 60.0
"""s"""
_LONGEST_WORD = 64


def tidy(value: float) -> float:
    """The decimal that somebody meant who sent a 32-bit float.

    A range that ends at 0.05 must take 0.05 from OSC, where it arrives as 0.05000000074505806.

    >>> tidy(0.05000000074505806), tidy(0.1234567890123)
    (0.05, 0.1234567890123)
    """
    if not math.isfinite(value) or abs(value) > 3.4e38 or struct.unpack("f", struct.pack("f", value))[0] != value:
        return value
    return float(f"{value:.7g}")


def setting(name: str, given: Argument) -> Setting | None:
    """A checked value for a parameter; None resets it.

    Flags take true and false, numbers from 0 to 1 (true from one half on), and words such as `on`; choices take a
    word or its place, from 0; numbers take numbers, flags (as 0 and 1) and texts.

    Raises:
        ParameterError: The value is wrong; names what is expected.

    >>> setting("nose_share", 1), setting("breath_sound", 0.0), setting("style", 1), setting("nose_share", None)
    (1.0, False, 'spontaneous', None)
    """
    if given is None:
        return None
    if isinstance(given, str):
        if len(given) > _LONGEST_WORD:
            raise ParameterError(f"{name}={shortened(given)!r} is too long for a value")
        value: Setting = parse_assignment(f"{name}={given}")[1]
        return value
    if choices(name):
        return _choice(name, given)
    if bounds(name) is None:
        if not 0.0 <= given <= 1.0:
            raise ParameterError(f"{name}={given!r} must be true or false, or a number in [0, 1]")
        return given >= 0.5
    if isinstance(given, int) and abs(given) > 2**53:
        raise ParameterError(f"{name}={given} is far outside its range")
    checked: float = getattr(Parameters(**{name: tidy(float(given))}), name)
    return checked


def seconds(given: Argument) -> float:
    """A glide.

    Raises:
        InputError: It is no number of seconds in range.
    """
    if isinstance(given, str) or given is None or not 0.0 <= given <= LONGEST_GLIDE:
        raise InputError(f"glide={given!r} must be a number of seconds in [0, {LONGEST_GLIDE:g}]")
    return tidy(float(given))


def _choice(name: str, given: float) -> str:
    words = choices(name)
    if not math.isfinite(given) or given != int(given) or not 0 <= given < len(words):
        raise ParameterError(f"{name}={given!r} must be {' or '.join(words)}, or a place in [0, {len(words) - 1}]")
    return words[int(given)]
