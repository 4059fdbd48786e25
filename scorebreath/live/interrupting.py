"""To interrupt a body: its events are cut, and it goes on from the volume, the mood and the look that it has then."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from scorebreath.compose.state import BodyState
from scorebreath.ensemble import Performer
from scorebreath.expression.interrupted import ENDED, FACE, interrupted
from scorebreath.expression.silence import LOOK_AHEAD
from scorebreath.live.deciding import BREATHS
from scorebreath.parameters.states import Blend
from scorebreath.score.cutting import endings
from scorebreath.score.events import (
    Command,
    Cut,
    Event,
    Marker,
    Parameter,
    State,
    Utterance,
    WarningEvent,
)
from scorebreath.units import snap

if TYPE_CHECKING:
    from scorebreath.live.performance import Performance

KEPT: tuple[type[Event], ...] = (Command, Cut, Parameter, WarningEvent)
"""Events that tell what was done to the body: nothing ends them."""
LONGEST_WORD = 0.8
"""s that an interruption waits for a word's end, at most."""


def interrupt(performance: Performance, who: Performer, at: float, *, fade: float, rule: str = "interrupted") -> None:
    """Cut what a body does, and take it to that moment.

    Args:
        performance: Whose decisions these are.
        who: The body.
        at: s; not before what is decided for good. Before the performance begins, its beginning is meant.
        fade: s in which sounds fade.
        rule: Why.
    """
    body, at = who.state.body, max(0.0, at)
    if who.state.time < at:  # the performer was held up for so long that nobody knows what the body did
        performance.decisions.counts.stalls += 1
        who.go_on(performance.company.ensemble.breathing.rest(who.state, at, "held_up"))
        performance.decisions.decide(performance.company.drain())
    # the face decides up to where it is cut only if it knows what would have followed
    while who.face.memory.eyes_until < at and who.state.time < at + LOOK_AHEAD:
        who.go_on(performance.company.ensemble.breathing.idle(who.state))
    performance.decisions.decide(performance.company.drain())
    near = performance.ledger.near(body)
    ends = endings(near)
    alive = [event for event in near if not isinstance(event, Cut)]
    alive = [event for event in alive if event.id not in ends or ends[event.id].time > at]
    targets = [event.id for event in alive if _ends(event, at)]
    volume = float(performance.ledger.curves(body).sample([at], ["lung_volume"])[0, 0])
    number = performance.decisions.cuts + 1
    performance.decisions.never_happens(body, at)
    if targets:
        performance.decisions.cut(body, at, targets, fade, rule)
    who.state = replace(
        who.state, time=at, volume=snap(min(1.0, max(0.0, volume))), opening=(), blend=_blend(who.state, alive, at)
    )
    who.face = interrupted(who.face, [event for event in alive if isinstance(event, FACE)], at, f"cut@{number}")
    performance.resting.discard(body)


def _ends(event: Event, at: float) -> bool:
    """Whether an interruption ends an event."""
    if isinstance(event, KEPT):
        return False
    if event.onset >= at:
        return True
    if isinstance(event, Marker) or (isinstance(event, FACE) and not isinstance(event, ENDED)):
        return False
    if isinstance(event, BREATHS):
        return snap(event.end) >= at  # one that touches, too: there is a border then in any case
    return snap(event.end) > at


def _blend(state: BodyState, alive: list[Event], at: float) -> Blend:
    """The moods it is in, without those that were to come."""
    coming = {event.name for event in alive if isinstance(event, State) and event.onset >= at}
    if not coming:
        return state.blend
    changes = {name: change for name, change in state.blend.changes.items() if name not in coming}
    return replace(state.blend, changes=changes)


class Break(NamedTuple):
    """Where speech can be broken off."""

    time: float
    """s"""
    place: int | None
    """of the first word that is not said any more, in the text; None: all is said"""


def next_break(events: list[Event], after: float) -> Break:
    """Where a word ends, or none is under way, at a time or soon behind it.

    Args:
        events: Of a body.
        after: s.
    """
    ends = endings(events)
    saying = [e for e in events if isinstance(e, Utterance) and e.id not in ends and snap(e.end) > after]
    for said in sorted(saying, key=lambda event: event.onset):
        words = [word for word in said.words if word.source and not word.merged]
        for word in words:
            begins = snap(said.onset + word.onset)
            if begins >= after:
                late = begins > after + LONGEST_WORD and said.onset < after
                return Break(after if late else begins, word.source[0] if word.source else None)
    last = max((snap(event.end) for event in saying), default=after)
    return Break(max(after, last) if last <= after + LONGEST_WORD else after, None)
