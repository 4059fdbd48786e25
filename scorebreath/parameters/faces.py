"""The face's rates in force: set by hand, or else as the face behaves."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cache

from scorebreath.parameters.columns import read_table
from scorebreath.parameters.table import Parameters


@dataclass(frozen=True, slots=True, kw_only=True)
class Face:
    """Each is a parameter of the same name, see `parameters.face_table`."""

    blink_interval: float
    blink_at_pause: float
    blink_double: float
    brow_at_maximum: float
    brow_interval: float
    brow_per_minute: float
    brow_height: float
    head_per_semitone: float
    head_highest: float
    head_at_maximum: float
    roll_at_raise: float
    roll_angle: float
    question_raise: float
    question_brow: float
    glance_at_accent: float
    glance_at_pause: float
    look_at_listener: float
    look_when_silent: float
    gaze_range: float
    gaze_away: float
    word_search: float


def face(p: Parameters) -> Face:
    """The rates in force.

    >>> face(Parameters(face="albrecht-2002")).brow_at_maximum, face(Parameters(brow_at_maximum=0.5)).brow_at_maximum
    (0.71, 0.5)
    """
    given = _faces()[p.face]
    by_hand = {field.name: getattr(p, field.name) for field in fields(Face)}
    return Face(**{name: given[name] if value is None else value for name, value in by_hand.items()})


@cache
def _faces() -> dict[str, dict[str, float]]:
    return read_table("faces.toml")
