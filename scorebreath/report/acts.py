"""What a body does besides speaking and breathing for it, as captions: [sighs], [laughs]."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from scorebreath.curves.performed import performed
from scorebreath.score.document import Score
from scorebreath.score.events import Event, Expiration, Hold, Inspiration
from scorebreath.units import snap

CAPTIONS: Mapping[tuple[str, str], str] = MappingProxyType(
    {
        (Inspiration.type, "gasp"): "gasps",
        (Inspiration.type, "sigh"): "sighs",
        (Inspiration.type, "sniff"): "sniffs",
        (Expiration.type, "audible"): "exhales",
        (Expiration.type, "sigh"): "sighs",
        (Expiration.type, "laugh"): "laughs",
        (Hold.type, "held"): "holds breath",
    }
)
"""By type and kind; others need no word: they are seen to be breaths."""
TOGETHER = 0.3
"""s; what follows sooner and has the same caption is one: air in and out of a sigh, several sniffs"""


class Act(NamedTuple):
    """Something that has a caption."""

    caption: str
    onset: float
    """s"""
    end: float
    """s"""


def caption_of(event: Event) -> str | None:
    """The caption of an event, None where it has none.

    >>> caption_of(Event(id="e", body="body", onset=0.0, duration=1.0)) is None
    True
    """
    return CAPTIONS.get((event.type, getattr(event, "kind", "")))


def acts(score: Score, body: str) -> tuple[Act, ...]:
    """Everything a body does that has a caption, in order of time."""
    done = [
        Act(caption, event.onset, snap(event.end))
        for event in performed(score).events
        if event.body == body and event.duration > 0 and (caption := caption_of(event))
    ]
    found: list[Act] = []
    for act in sorted(done, key=lambda each: each.onset):
        if found and found[-1].caption == act.caption and act.onset - found[-1].end <= TOGETHER:
            found[-1] = found[-1]._replace(end=max(act.end, found[-1].end))
        else:
            found.append(act)
    return tuple(found)
