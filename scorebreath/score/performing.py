"""Events of performance: what was moved, commanded, cut, warned of and marked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from scorebreath.score.event import Event
from scorebreath.score.values import Number


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter(Event):
    """A parameter was moved."""

    type: ClassVar[str] = "parameter"
    name: str
    value: Number
    glide: Number = 0.0
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Command(Event):
    """A performer's command."""

    type: ClassVar[str] = "command"
    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Cut(Event):
    """An interruption: the targets end here, whatever they said."""

    type: ClassVar[str] = "cut"
    targets: tuple[str, ...]
    """event ids"""
    fade: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class WarningEvent(Event):
    """Something the reader of the Score should know."""

    type: ClassVar[str] = "warning"
    code: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Marker(Event):
    """A named place in time."""

    type: ClassVar[str] = "marker"
    name: str
