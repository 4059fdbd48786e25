"""What a face carries from step to step, and what one step is given."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from scorebreath.expression.neck import Turn
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
    until: float = 0.0
    """s up to which the body is placed, where that is later than its last event"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Memory:
    """What the face has done, as far as it matters for what it does next."""

    place: str = "start"
    """key of chance: the group that is or was spoken last"""
    group: str | None = None
    """its id"""
    numbers: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    """how many of each kind were made since that group began, by what their ids say"""
    silent: float | None = 0.0
    """s since when nobody is heard; None: a group is being decided"""
    entered: bool = False
    """whether the pause's own blink and glance are decided"""
    felt: bool = False
    """whether the next group's emotions are"""
    asked: bool = False
    """whether what was said last is a question"""
    held: float = 0.0
    """s; when what the last question raised is let go"""
    horizon: float = 0.0
    """s up to which events have been placed"""
    eyes: tuple[float, float] = (0.0, 0.0)
    """yaw and pitch, degrees"""
    target: str = "listener"
    eyes_until: float = 0.0
    """s; gaze is decided up to here"""
    run_until: float | None = None
    """s; until then a silent body looks where it does, but for small shifts"""
    run: tuple[float, float] = (0.0, 0.0)
    """the middle of those small shifts, degrees"""
    blink_due: float | None = None
    """s; when the eyes need a blink; None: not drawn yet"""
    blink_end: float = -1.0
    """s; when the last blink is over"""
    looks: tuple[float, ...] = ()
    """s; onsets of glances at pauses and of searches that blinks keep away from"""
    winks: tuple[tuple[float, float], ...] = ()
    """s; onsets and ends of winks to come"""
    head_until: float = -1.0
    """s; when the head is back from the last question"""
    turns: tuple[Turn, ...] = ()
    """movements of the head that may not be over yet"""
    raised: tuple[float, ...] = ()
    """s; onsets of the last minute's raises of the brows"""


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
    """groups that were placed, but what follows them must be known first"""
    memory: Memory = Memory()
