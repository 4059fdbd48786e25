"""What a face carries from step to step, and what one step is given."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.parameters.table import Parameters
from scorebreath.score.events import Event
from scorebreath.script.marks import EmotionMark


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed:
    """What one step of compose has placed for a body: a group with its breath, a rest, an end."""

    events: tuple[Event, ...]
    place: str
    """key of its chance: a group's words and which occurrence of them it is"""
    marks: tuple[EmotionMark, ...] = ()
    """emotions that the text asks for before, in and behind the group"""


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceState:
    """All that is carried: what the face has decided, and what it still waits to know."""

    body: str
    seed: int
    parameters: Parameters
    language: str
    """BCP 47 primary language"""
    time: float = 0.0
    """s; the face is decided up to here"""
    waiting: tuple[Placed, ...] = ()
    """placed, but what follows must be known first: the pause behind a group, the phrase an emotion spans"""
