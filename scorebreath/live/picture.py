"""A body at one moment of a performance, as streams send it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Protocol

from scorebreath.curves.curve_set import CurveSet


@dataclass(frozen=True, kw_only=True)
class Picture:
    """One frame of one body."""

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
