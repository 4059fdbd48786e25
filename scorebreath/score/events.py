"""All types of events by name, with their reach; the events themselves stand in the modules beside this one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from scorebreath.score.acting import (
    Blink,
    Brow,
    Emotion,
    Gaze,
    Head,
    State,
)
from scorebreath.score.breathing import (
    Expiration,
    Hold,
    Inspiration,
    Lead,
    Motion,
    Noise,
    Trapezoid,
)
from scorebreath.score.event import (
    Closing,
    Event,
    Extension,
    Origin,
    Part,
    PauseKind,
    Profile,
    SentenceType,
)
from scorebreath.score.performing import (
    Command,
    Cut,
    Heard,
    Marker,
    Parameter,
    WarningEvent,
)
from scorebreath.score.speaking import (
    Level,
    Pause,
    Phone,
    Phrase,
    Pitch,
    Utterance,
    Word,
)

__all__ = [
    "EVENTS",
    "Blink",
    "Brow",
    "Closing",
    "Command",
    "Cut",
    "Emotion",
    "Event",
    "Expiration",
    "Extension",
    "Gaze",
    "Head",
    "Heard",
    "Hold",
    "Inspiration",
    "Lead",
    "Level",
    "Marker",
    "Motion",
    "Noise",
    "Origin",
    "Parameter",
    "Part",
    "Pause",
    "PauseKind",
    "Phone",
    "Phrase",
    "Pitch",
    "Profile",
    "Reach",
    "SentenceType",
    "State",
    "Trapezoid",
    "Unknown",
    "Utterance",
    "WarningEvent",
    "Word",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Unknown(Event):
    """An event of a type that begins with `x_`: kept whole, understood by nobody here."""

    kind: str
    """its type"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reach:
    """How far outside its own time an event changes anything."""

    lead: float
    """s before its onset"""
    lag: float
    """s after its end"""


EVENTS: Mapping[str, tuple[type[Event], Reach]] = MappingProxyType(
    {
        kind.type: (kind, Reach(lead=lead, lag=lag))
        for kind, lead, lag in (
            (Inspiration, 0.5, 0.5),  # after it the mouth it opened is handed over to speech
            (Expiration, 0.5, 0.5),
            (Hold, 0.5, 0.0),
            (Utterance, 0.5, 0.5),
            (Phrase, 0.0, 0.0),
            (Pause, 0.0, 0.0),
            (Emotion, 0.0, 0.0),
            (State, 0.0, 0.0),
            (Blink, 0.0, 0.0),
            (Brow, 0.0, 0.0),
            (Head, 0.0, 0.0),
            (Gaze, 0.0, 0.0),
            (Parameter, 0.0, 0.0),
            (Command, 0.0, 0.0),
            (Cut, 0.0, 0.0),
            (WarningEvent, 0.0, 0.0),
            (Marker, 0.0, 0.0),
        )
    }
)
"""Every type of event with its reach: it changes nothing outside `[onset - lead, end + lag]`."""
