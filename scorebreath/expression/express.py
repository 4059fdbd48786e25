"""`express(state, placed) -> (state, events)`: the face events around what compose has placed."""

from __future__ import annotations

from dataclasses import replace

from scorebreath.expression.state import FaceState, Placed
from scorebreath.score.events import Event


def express(state: FaceState, placed: Placed, *, over: float | None = None) -> tuple[FaceState, list[Event]]:
    """Decide what the face does, as far as it can be known: up to the group before the last one.

    Args:
        state: The face until now.
        placed: What compose has placed since.
        over: s; the time at which all is over: everything is decided up to there. None: more will come.

    Returns:
        The face afterwards, and its events; none lies before the `time` that `state` was decided up to, but for
        emotions, which begin with their phrase.
    """
    return replace(state, waiting=()), []
