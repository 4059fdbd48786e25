"""What a performance does to a sound that sounds already: ratios it follows, and a cut that ends it."""

from __future__ import annotations

from typing import Any

from scorebreath_synthdefs.catalogue import HEARD, Route
from scorebreath_synthdefs.graph import sc

_SMOOTH = 0.02
"""s in which a step of a ratio is followed; a glide is slower than that"""
_LONGEST = 3600.0
"""s that a sound can be cut in: lines are counted in 31 bits of samples"""
_INSTANT = 1e-6  # s


def ratio(graph: Any, route: Route) -> Any:
    """What a ratio of the body has come to; exactly 1 where the sound belongs to nobody. Control rate.

    A sound begins with the ratio in force, so there is nothing to follow.
    """
    bus = graph["heard"]
    belongs = bus >= 0
    found = sc.In.kr(bus=bus.max(0) + HEARD.index(route), channel_count=1)
    return sc.Lag.kr(source=(found - 1) * belongs + 1, lag_time=_SMOOTH)


def ending(graph: Any) -> Any:
    """Gain that is exactly 1 until `cut` and then falls to 0 within `fade`, where the sound frees itself. Control rate.

    It counts from the sound's own onset, so a cut is the same wherever the engine's blocks begin. Between the starts of
    two blocks the gain is a straight line a block late: two blocks less of fade make up for it.
    """
    now = sc.A2K.kr(source=sc.Line.ar(start=0, stop=_LONGEST, duration=_LONGEST))  # at control rate engines differ
    since = now - graph["cut"]
    falling = (graph["fade"] - 2 * sc.ControlDur.ir()).max(_INSTANT)
    sc.FreeSelf.kr(trigger=since > falling + 2 * sc.ControlDur.ir())
    return (1 - since / falling).clip(0, 1)


def touched(sound: Any, graph: Any, route: Route) -> Any:
    """A sound under its ratio and its cut: the same bits where neither does anything."""
    return sound * ratio(graph, route) * ending(graph)
