r"""Items of a list in prose: lines that begin with a bullet or a number.

A line's end is no place to breathe in prose, but in front of an item it is one. A bullet needs white space behind it, a
number a bracket, `1)`, or a full stop and another item before or after it with the next number, for a line may begin
with "3. May" by chance.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from scorebreath.spans import Span

_ITEM = re.compile(
    r"(?P<before>\A|\n)[ \t]*(?:(?P<bullet>[-–—*•‣◦▪●○])|\(?(?P<number>[0-9]{1,3}|[A-Za-z])(?P<close>[.)]))[ \t]+(?=\S)"
)


class Items(NamedTuple):
    """Where items begin."""

    newlines: list[int]
    """places of the newlines before them, ascending"""
    bullets: list[Span]
    """signs that are not spoken"""


def items(text: str) -> Items:
    r"""Items in a sentence, its own beginning included.

    >>> items("Buy\n- eggs\n* milk").newlines, items("1. eggs\n2. milk").newlines, items("on the\n3. May").newlines
    ([3, 10], [7], [])
    """
    found = [match for match in _ITEM.finditer(text) if match["bullet"] or match["number"]]
    numbers = {_number(match) for match in found if match["number"]}
    kept = [
        match
        for match in found
        if match["bullet"] or match["close"] == ")" or {_number(match) - 1, _number(match) + 1} & numbers
    ]
    return Items(
        [match.start() for match in kept if match["before"]],
        [Span(*match.span("bullet")) for match in kept if match["bullet"]],
    )


def _number(match: re.Match[str]) -> int:
    """An item's number; letters count from a thousand."""
    number = match["number"]
    return int(number) if number.isdecimal() else 1000 + ord(number)
