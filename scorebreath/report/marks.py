"""What was done to a performance: cuts, commands, moves of parameters, warnings; and which words they broke off."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from scorebreath.score.cutting import endings, never
from scorebreath.score.document import Score
from scorebreath.score.events import Command, Cut, Event, Parameter, Utterance, WarningEvent
from scorebreath.score.performing import GIVES_WAY
from scorebreath.units import plain

DASH = "—"
"""Behind a word that was broken off."""


class Mark(NamedTuple):
    """Something that was done."""

    time: float
    """s"""
    kind: str
    """type of the event"""
    text: str


def _parameter(event: Parameter) -> str:
    said = event.text if event.value is None else plain(event.value)
    return f"{event.name} {said or 'reset'}"


_SAID: Mapping[str, Callable[[Any], str]] = MappingProxyType(
    {
        Cut.type: lambda event: "cut",
        Command.type: lambda event: event.name,
        Parameter.type: _parameter,
        WarningEvent.type: lambda event: f"! {event.code}",
    }
)
"""How each is told in a word or two, by type of event."""


def marks(score: Score, body: str) -> tuple[Mark, ...]:
    """Everything that was done to a body, in order of time."""
    ends = endings(score.events)
    found = [
        Mark(event.onset, event.type, _SAID[event.type](event))
        for event in score.events
        if event.body == body and event.type in _SAID and not never(event, ends) and not _silent(event)
    ]
    return tuple(sorted(found, key=lambda mark: mark.time))


def _silent(event: Event) -> bool:
    """Whether it only keeps the sound as it was moved; cuts of a breath at rest are no interruptions either."""
    if isinstance(event, Cut):
        return event.rule == GIVES_WAY
    return isinstance(event, Parameter) and not event.name


def broken_off(score: Score, body: str) -> frozenset[tuple[str, float]]:
    """Words in the midst of which a cut came: of which utterance, and their onset in it, s."""
    ends = endings(score.events)
    return frozenset(
        (said.id, word.onset)
        for said in (score.of(Utterance, body) if ends else ())
        if said.id in ends and ends[said.id].shortens(said)
        for word in said.words
        if word.onset < ends[said.id].time - said.onset < word.onset + word.duration
    )
