"""A body at one moment of a performance, as streams send it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Protocol

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.rigs.table import rig_named

EVERYBODY = "*"
"""In place of a body: all of them."""


class Strip:
    """Curves at a few moments in a row, worked out together when somebody asks: that is hardly dearer than one.

    Args:
        curves: Of a body.
        times: s of the performance.
    """

    def __init__(self, curves: CurveSet, times: Sequence[float]) -> None:
        """Nothing is sampled yet."""
        self.curves, self.times = curves, tuple(times)
        self._values: dict[str, tuple[tuple[str, ...], Sequence[Sequence[float]]]] = {}

    def at(self, place: int, rig: str = "") -> Mapping[str, float]:
        """What is shown at one of the times: channels by name, or a rig's columns.

        Raises:
            InputError: There is no such rig.
        """
        if rig not in self._values:
            made = rig_named(rig) if rig else None
            names = made.columns if made else self.curves.channels
            values = made.sample(self.curves, self.times) if made else self.curves.sample(self.times)
            self._values[rig] = names, values.tolist()
        names, rows = self._values[rig]
        return MappingProxyType(dict(zip(names, rows[place], strict=True)))


@dataclass(frozen=True, kw_only=True)
class Picture:
    """One frame of one body; what it shows is worked out once, however many targets ask."""

    body: str
    name: str
    """what receivers know it by"""
    time: float
    """s of the performance, which are the Score's"""
    unix: float
    """when that is heard, s since 1970 (UTC)"""
    number: int
    """of the frame, from 0"""
    curves: CurveSet
    """of the body, valid at `time`"""
    strip: Strip | None = None
    """of those curves, with `time` among its times; None: one of its own"""

    @cached_property
    def channels(self) -> Mapping[str, float]:
        """Every channel by its name, in the order of the table."""
        return self._shown("")

    def rig(self, name: str) -> Mapping[str, float]:
        """Every column of a rig by its name, in the units of its table.

        Raises:
            InputError: There is no such rig.
        """
        if name not in self._rigs:
            self._rigs[name] = self._shown(name)
        return self._rigs[name]

    def _shown(self, rig: str) -> Mapping[str, float]:
        strip = self.strip or Strip(self.curves, [self.time])
        return strip.at(strip.times.index(self.time), rig)

    @cached_property
    def _rigs(self) -> dict[str, Mapping[str, float]]:
        return {}


class Target(Protocol):
    """Somewhere pictures go."""

    @property
    def name(self) -> str:
        """What it is, for people, such as `vmc://127.0.0.1:39539`."""

    def send(self, picture: Picture) -> None:
        """Send one picture, without waiting for anybody.

        Raises:
            OSError: It cannot be reached now; it will be tried again with the next picture.
        """

    def close(self) -> None:
        """Let go of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Stream:
    """A target, and which pictures it gets."""

    target: Target
    body: str = EVERYBODY
    """id of the only body it gets; EVERYBODY; or empty: whoever comes first"""
    rate: float | None = None
    """pictures of a body a second, at most those of the sender; None: all of them"""
