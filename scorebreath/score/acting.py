"""Events of face and state: emotion, breathing states, blinks, brows, head, gaze."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from scorebreath.score.event import Event
from scorebreath.score.values import Number


@dataclass(frozen=True, slots=True, kw_only=True)
class Emotion(Event):
    """An emotion that rises to its apex and falls."""

    type: ClassVar[str] = "emotion"
    name: str
    apex: Number
    """s"""
    intensity: Number
    """0..1"""
    phrases: tuple[str, ...] = ()
    """ids of the phrases it spans"""


@dataclass(frozen=True, slots=True, kw_only=True)
class State(Event):
    """A breathing state (anxious, exertion, ...) that moves from one intensity to another."""

    type: ClassVar[str] = "state"
    name: str
    start: Number
    """intensity at the onset, 0..1"""
    target: Number
    """intensity after the ramp, 0..1"""
    ramp: Number
    """s"""
    recovery: Number = 0.0
    """time constant with which it fades by itself after the ramp, s; 0: it stays"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Blink(Event):
    """Lids close, stay, open."""

    type: ClassVar[str] = "blink"
    left: Number
    """amplitude, 0..1"""
    right: Number
    close: Number
    """s"""
    hold: Number
    """s"""
    open: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Brow(Event):
    """Brows rise or frown and come back."""

    type: ClassVar[str] = "brow"
    left: Number
    right: Number
    frown: Number
    apex: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Head(Event):
    """The head turns and comes back."""

    type: ClassVar[str] = "head"
    pitch: Number
    """degrees"""
    yaw: Number
    roll: Number
    apex: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Gaze(Event):
    """The eyes go to a target, in the chest's frame."""

    type: ClassVar[str] = "gaze"
    target: str
    yaw: Number
    """degrees"""
    pitch: Number
    """degrees"""
