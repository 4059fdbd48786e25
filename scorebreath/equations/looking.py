r"""How fast eyes, lids, brows and heads move, and when lids blink by themselves.

Every movement of the face is a `shapes.smooth_step`: its highest speed is 15/8 of its mean. From that follows how
long a movement must take to stay below a speed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from scorebreath.equations.shapes import FASTEST

EYE_FASTEST = 500.0
"""deg/s; the speed that saccades approach (Carpenter 1988; physiology 7.5)."""
EYE_SCALE = 14.0
"""deg; the size of a saccade at 63 % of that."""
HEAD_FASTEST = 45.0
"""deg/s of a nod or a roll: 50 at most (physiology 7.5, Greta), the breath moving the head beside it."""
HEAD_LIMIT = 48.0
"""deg/s of all that speech does to the head at the same time, on each axis."""
HEAD_RANGE = 35.0
"""Degrees that speech turns the head at most, on each axis: of 45, emotions and the breath need some."""
NOD = 1.0 / 6.0
"""s of a nod's rise or fall, at least: heads move below 3 Hz (physiology 7.5)."""
BROW_FASTEST = 10.0
"""1/s, so that a brow rises fully within 190 ms (physiology 7.5: 100 to 270 ms)."""
BLINK_SHAPE = 3.0
"""Shape of the gamma distribution of the times between blinks (physiology 7.5)."""
BLINK_SHORTEST = 0.4
"""s between two blinks by themselves, at least (physiology 7.5)."""
BLINK_QUANTILE = 11.228871
"""The 99.9 % quantile of a gamma distribution of shape 3 and scale 1."""


def saccade_speed(angle: float) -> float:
    r"""Highest speed of a saccade, deg/s: the main sequence :math:`500 (1 - e^{-A/14})` (Carpenter 1988).

    >>> round(saccade_speed(10.0), 1)
    255.2
    """
    return EYE_FASTEST * (1.0 - math.exp(-angle / EYE_SCALE))


def saccade_time(angle: float) -> float:
    r"""How long the eyes take to turn by an angle, s: the longer of the main sequence's two laws.

    :math:`D = 21 + 2.2 A` ms (Carpenter 1988), and what a `smooth_step` needs to stay below `saccade_speed`.

    Args:
        angle: Degrees, 0 or more.

    >>> round(saccade_time(10.0), 4), saccade_time(0.0)
    (0.0735, 0.0)
    """
    if angle <= 0.0:
        return 0.0
    return max(0.021 + 0.0022 * angle, FASTEST * angle / saccade_speed(angle))


def movement_time(amount: float, fastest: float, least: float) -> float:
    """How long a movement takes that stays below a speed, s, and at least `least`.

    >>> movement_time(5.0, 45.0, 0.15)
    0.20833333333333334
    """
    return max(least, FASTEST * abs(amount) / fastest)


def blink_limit(mean: float) -> float:
    """The longest time between two blinks by themselves, s: the 99.9 % quantile of their distribution.

    >>> round(blink_limit(4.8), 3)
    17.966
    """
    return mean * BLINK_QUANTILE / BLINK_SHAPE


def blink_interval(mean: float, draws: Sequence[float]) -> float:
    r"""Time to the next blink, s: gamma of shape 3, which is the sum of three exponential times (physiology 7.5).

    Args:
        mean: s.
        draws: Three numbers drawn evenly from [0, 1).

    >>> round(blink_interval(4.8, (0.5, 0.5, 0.5)), 6)
    3.327106
    >>> blink_interval(4.8, (0.0, 0.0, 0.0)), blink_interval(4.8, (1 - 1e-9,) * 3) == blink_limit(4.8)
    (0.4, True)
    """
    waited = -sum(math.log1p(-draw) for draw in draws) * mean / BLINK_SHAPE
    return min(max(waited, BLINK_SHORTEST), blink_limit(mean))
