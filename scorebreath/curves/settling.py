"""How movements go on from where a cut found them.

A cut takes away events that were under way, and with them what they moved. Nobody's head jumps for that: from the cut
on, each movement is held within a tube around where it was, which opens from nothing, as fast as such a movement may
be. What was taken away comes to rest in the tube; what goes on, or begins anew, is let through as soon as the tube is
as wide. So no movement is faster behind a cut than the faster of the two; and a movement that the cut did not touch is
not touched here. What has no speed of its own, such as shares that add up to 1, is cross-faded instead.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from scorebreath.curves.breathing import FACTORS
from scorebreath.curves.lips.gates import ease
from scorebreath.curves.lips.targets import JAW, LIP_CHANNELS
from scorebreath.curves.looks.mixing import EMOTION_HEAD
from scorebreath.curves.tracks import Array
from scorebreath.score.acting import EMOTIONS

LEAST = 1e-9
"""A difference that nobody sees."""
SMALL = 0.02
"""s; what a movement does in so short a time takes half of its calm, and less takes less."""


@dataclass(frozen=True, slots=True)
class Movement:
    """How one movement goes on."""

    reach: float
    """s behind a cut after which nothing of it is left"""
    speed: tuple[float, ...] = ()
    """of each column, how fast the tube opens at most, units a second; none: it is cross-faded within the reach"""
    calm: float = 0.0
    """s that it takes to come to rest, where its speed would let it be sooner, and it is not all but there"""


class Found(NamedTuple):
    """A movement at a cut."""

    time: float
    """s, of the cut"""
    old: Array
    """(columns,) what was seen"""
    gap: Array
    """(columns,) how far off that is what would be seen now"""


def _tube(span: float, calm: float, *speed: float) -> Movement:
    """A tube is as wide as the whole span after half as long again as its speed needs for it."""
    return Movement(reach=1.5 * span / min(speed) + calm, speed=speed, calm=calm)


MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "mouth": _tube(1.0, 0.12, 5.0),
        "nostrils": _tube(1.0, 0.12, 4.0),
        "lips": _tube(1.0, 0.1, *(7.0 if column == JAW else 15.0 for column in range(len(LIP_CHANNELS)))),
        "contact": _tube(1.0, 0.0, 24.0),
        "visemes": Movement(reach=0.2),
        "head": _tube(180.0, 0.35, 35.0, 35.0, 35.0),  # 8 degrees within 0.35 s
        "gaze": _tube(180.0, 0.0, 400.0, 400.0),
        "blink": _tube(1.0, 0.15, 10.0, 10.0),
        "brow": _tube(1.0, 0.3, 5.0, 5.0, 5.0),
        **{f"emotion_{name}": _tube(1.0, 0.35, 4.3) for name in EMOTIONS},
        **{f"leaning_{name}": _tube(1.0, 0.35, 2.2) for name in EMOTION_HEAD},
        **{name: Movement(reach=0.35) for name in FACTORS},
    }
)
"""Every movement by its name; speeds are below those of the channels (`channels.CHANNELS`)."""


def found(time: float, old: Array, new: Array) -> Found:
    """What a cut found.

    Args:
        time: s, of the cut.
        old: (1, columns) or (1,), seen at the cut until now.
        new: The same, as it would be without what is cut.
    """
    before, after = np.atleast_1d(old[0]), np.atleast_1d(new[0])
    gap = np.abs(before - after)
    return Found(time, before, np.where(gap > LEAST, gap, 0.0))


def settled(movement: Movement, at: Found, times: Array, values: Array) -> Array:
    """A movement behind a cut.

    Args:
        movement: Which.
        at: What the cut found.
        times: (n,) s, at the cut or later.
        values: (n, columns) or (n,), without what is cut.

    Returns:
        Shaped like `values`; the same where the cut changed nothing at its time.
    """
    if not at.gap.any():
        return values
    since = times - at.time
    near = since < movement.reach
    if not near.any():
        return values
    whole = values.reshape(len(values), -1).copy()
    if movement.speed:
        for column in np.flatnonzero(at.gap):
            radius = _radius(since[near], float(at.gap[column]), movement.speed[column], movement.calm)
            old = at.old[column]
            whole[near, column] = np.clip(whole[near, column], old - radius, old + radius)
    else:
        left = 1.0 - ease(since[near] / movement.reach)[:, np.newaxis]
        whole[near] += (at.old - whole[near]) * left
    return whole.reshape(values.shape)


def _radius(since: Array, gap: float, speed: float, calm: float) -> Array:
    """Of the tube: it opens by the gap without a jerk, at most at that speed, and goes on opening."""
    length = max(1.5 * gap / speed, calm * gap / (gap + SMALL * speed))
    return np.asarray(gap * ease(since / length) + speed * np.maximum(since - length, 0.0))
