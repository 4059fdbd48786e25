"""A face whose body is interrupted: what it had decided for later never happens, and it goes on from where it is."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from scorebreath.expression.state import FaceState, Placed
from scorebreath.score.events import Blink, Brow, Emotion, Event, Gaze, Head

FACE: tuple[type[Event], ...] = (Emotion, Blink, Brow, Head, Gaze)
"""Events that a face makes."""
ENDED: tuple[type[Event], ...] = (Emotion, Gaze)
"""Of those, what an interruption ends in its middle; the others are short, or come back by themselves."""


def interrupted(state: FaceState, shown: Iterable[Event], at: float, place: str) -> FaceState:
    """The face at a moment at which everything that it was about to do is cut.

    Args:
        state: As it has decided, up to that moment at least.
        shown: Its events.
        at: s.
        place: Key of chance for what follows.

    Returns:
        The face at that moment, silent. Eyes look where they look, and turn from there.
    """
    begun = [event for event in shown if event.onset < at]
    looks = [event for event in begun if isinstance(event, Gaze)]
    last = max(looks, key=lambda event: event.onset, default=None)
    blinks = [event.end for event in begun if isinstance(event, Blink)]
    moved = [event.end for event in begun if isinstance(event, Head | Brow)]
    memory = state.memory
    return replace(
        state,
        time=at,
        waiting=(),
        memory=replace(
            memory,
            place=place,
            group=None,
            silent=at,
            entered=True,
            felt=False,
            asked=False,
            held=min(memory.held, at),
            horizon=at,
            eyes=(last.yaw, last.pitch) if last else (0.0, 0.0),
            target=last.target if last else "listener",
            eyes_until=at,
            run_until=None,
            blink_due=None,
            blink_end=max(blinks, default=-1.0),
            looks=tuple(look for look in memory.looks if look < at),
            winks=(),
            head_until=min(memory.head_until, max(moved, default=-1.0)),
            turns=tuple(turn for turn in memory.turns if turn.onset < at),
            raised=tuple(time for time in memory.raised if time < at),
        ),
    )


def taken_back(state: FaceState, horizon: float) -> FaceState:
    """The face as if the group that waits had never been placed; what was decided until then stands.

    Args:
        state: With one group waiting.
        horizon: s up to which events remain placed.
    """
    memory = replace(state.memory, felt=False, horizon=horizon, winks=())
    if memory.silent is None:  # the silence before the group was decided
        memory = replace(memory, silent=state.time, entered=True, group=None)
    waiting: tuple[Placed, ...] = ()
    return replace(state, waiting=waiting, memory=memory)
