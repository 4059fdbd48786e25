"""Numbers in markup: seconds, shares, decibels, multiples; each with the bounds within which it makes sense."""

from __future__ import annotations

import re

LONGEST_PAUSE = 60.0
"""s"""
LONGEST_RAMP = 600.0
"""s"""

_SECONDS = re.compile(r"\+?([0-9]{1,9}(?:\.[0-9]{0,9})?|\.[0-9]{1,9})\s*(ms|s|sec|secs|seconds?|)", re.IGNORECASE)
_NUMBER = re.compile(r"[0-9]{1,9}(?:\.[0-9]{0,9})?|\.[0-9]{1,9}")


def seconds(text: str, most: float, *, bare: bool = True) -> float | None:
    """A length of time, or None where it is none or not in `[0, most]`.

    Args:
        text: Such as `0.4`, `.4s`, `400ms`, `1 second`.
        most: s.
        bare: Whether a number without a unit is seconds.

    >>> seconds("400ms", 60), seconds("1.5 s", 60), seconds("2", 60), seconds("2", 60, bare=False), seconds("61", 60)
    (0.4, 1.5, 2.0, None, None)
    """
    match = _SECONDS.fullmatch(text.strip())
    if match is None or not (match[2] or bare):
        return None
    value = round(float(match[1]) / (1000.0 if match[2].lower() == "ms" else 1.0), 6)
    return value if value <= most else None


def number(text: str) -> float | None:
    """A decimal number without a sign.

    >>> number("0.8"), number(".5"), number("-1"), number("1e9"), number("x")
    (0.8, 0.5, None, None, None)
    """
    return float(text) if _NUMBER.fullmatch(text) else None


def share(text: str) -> float | None:
    """A number in 0..1, or a percentage.

    >>> share("0.8"), share("80%"), share("8")
    (0.8, 0.8, None)
    """
    value = number(text.removesuffix("%"))
    if value is not None and text.endswith("%"):
        value = round(value / 100.0, 9)
    return value if value is not None and value <= 1.0 else None
