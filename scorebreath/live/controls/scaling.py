"""From the way of a knob, 0..1, to a parameter's values, and back."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from scorebreath.errors import InputError
from scorebreath.live.desk import Setting
from scorebreath.parameters.table import bounds, choices
from scorebreath.units import plain, snap


@dataclass(frozen=True, slots=True, kw_only=True)
class Curve:
    """How a knob's way is bent: both functions go from 0..1 to 0..1, and undo each other."""

    about: str
    bend: Callable[[float], float]
    straighten: Callable[[float], float]


CURVES: Mapping[str, Curve] = MappingProxyType(
    {
        "linear": Curve(about="even", bend=lambda way: way, straighten=lambda share: share),
        "slow": Curve(
            about="fine at the beginning: the square of the way", bend=lambda way: way * way, straighten=math.sqrt
        ),
        "fast": Curve(
            about="fine at the end: the root of the way", bend=math.sqrt, straighten=lambda share: share * share
        ),
    }
)
"""Curve by its name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scale:
    """The values on a knob's way: a range, or words (flags too) with equal zones."""

    low: float = 0.0
    high: float = 1.0
    words: tuple[Setting, ...] = ()
    curve: str = "linear"

    def value(self, way: float) -> Setting:
        """The value at a place on the way, 0..1.

        >>> Scale(low=10.0, high=20.0).value(0.25), Scale(words=(False, True)).value(0.5)
        (12.5, True)
        """
        share = CURVES[self.curve].bend(min(1.0, max(0.0, way)))
        if self.words:
            return self.words[min(int(share * len(self.words)), len(self.words) - 1)]
        least, most = sorted((self.low, self.high))
        return min(most, max(least, snap(self.low + (self.high - self.low) * share)))

    def way(self, value: Setting) -> float:
        """The place of a value, 0..1; of one outside the range, the nearest end; of a word, the middle of its zone.

        >>> Scale(low=10.0, high=20.0).way(12.5), Scale(words=(False, True)).way(True)
        (0.25, 0.75)
        """
        if self.words:
            place = self.words.index(value) if value in self.words else 0
            share = (place + 0.5) / len(self.words)
        else:
            share = (float(value) - self.low) / (self.high - self.low)
        return CURVES[self.curve].straighten(min(1.0, max(0.0, share)))

    def same(self, way: float, value: Setting) -> bool:
        """Whether a knob at this place already says this word; never, where there are numbers."""
        return bool(self.words) and self.value(way) == value


def scale_of(name: str, low: float | None = None, high: float | None = None, curve: str = "linear") -> Scale:
    """The scale of a parameter, or of a part of its range.

    Raises:
        InputError: The part is empty or outside the range, or the parameter has none.

    >>> scale_of("nose_share", 0.2, 0.8).value(1.0), scale_of("style").value(0.9)
    (0.8, 'spontaneous')
    """
    limits = bounds(name)
    if limits is None:
        if low is not None or high is not None:
            raise InputError(f"{name} is no number: low and high are for numbers")
        return Scale(words=choices(name) or (False, True), curve=curve)
    begin = limits[0] if low is None else float(low)
    end = limits[1] if high is None else float(high)
    for key, value in (("low", begin), ("high", end)):
        if not limits[0] <= value <= limits[1]:
            raise InputError(
                f"{key}={plain(value)} must be a number in [{plain(limits[0])}, {plain(limits[1])}] ({name})"
            )
    if abs(end - begin) < 1e-5:
        raise InputError(f"{name}: low and high are both {plain(begin)}")
    return Scale(low=begin, high=end, curve=curve)
