"""A body at one moment of a performance, as streams send it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Protocol

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.rigs.table import rig_named

EVERYBODY = "*"
"""In place of a body: all of them."""


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

    @cached_property
    def channels(self) -> Mapping[str, float]:
        """Every channel by its name, in the order of the table."""
        values = self.curves.sample([self.time])[0]
        return MappingProxyType(dict(zip(self.curves.channels, map(float, values), strict=True)))

    def rig(self, name: str) -> Mapping[str, float]:
        """Every column of a rig by its name, in the units of its table.

        Raises:
            InputError: There is no such rig.
        """
        if name not in self._rigs:
            rig = rig_named(name)
            values = rig.sample(self.curves, [self.time])[0]
            self._rigs[name] = MappingProxyType(dict(zip(rig.columns, map(float, values), strict=True)))
        return self._rigs[name]

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
