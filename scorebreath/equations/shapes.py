r"""Shapes over time: ramp, trapezoid, and the two ways of moving air; floats or arrays in, arrays out.

Every function works element by element, so one sample's value never depends on which others are asked for.
"""

from __future__ import annotations

from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def ramp(time: ArrayLike, length: ArrayLike) -> Array:
    r""":math:`\mathrm{clip}(t / length, 0, 1)`; a length of 0 is a step that has happened at `time` 0.

    Args:
        time: Seconds since the ramp began; any shape.
        length: Seconds, 0 or more; broadcast against `time`.

    >>> ramp([-1.0, 0.0, 0.5, 2.0], 1.0).tolist()
    [0.0, 0.0, 0.5, 1.0]
    >>> ramp([-0.1, 0.0, 0.1], 0.0).tolist()
    [0.0, 1.0, 1.0]
    """
    t, over = np.broadcast_arrays(np.asarray(time, dtype=np.float64), np.asarray(length, dtype=np.float64))
    risen = np.divide(t, over, out=np.where(t >= 0, 1.0, 0.0), where=over > 0)
    return np.asarray(np.clip(risen, 0.0, 1.0), dtype=np.float64)


def trapezoid(time: ArrayLike, attack: ArrayLike, hold: ArrayLike, release: ArrayLike) -> Array:
    r"""Linear rise to 1, hold, linear fall to 0 (B46: the breath sounds' envelope; X16: ours for the face too).

    Args:
        time: Seconds since the attack began; any shape.
        attack: Seconds, 0 or more.
        hold: Seconds, 0 or more.
        release: Seconds, 0 or more.

    >>> trapezoid([-1.0, 0.0, 1.0, 3.0, 4.5, 6.0], 2.0, 2.0, 1.0).tolist()
    [0.0, 0.0, 0.5, 1.0, 0.5, 0.0]
    """
    t = np.asarray(time, dtype=np.float64)
    up, full, down = (np.asarray(part, dtype=np.float64) for part in (attack, hold, release))
    return np.asarray(np.minimum(ramp(t, up), ramp(up + full + down - t, down)), dtype=np.float64)


def flow_envelope(
    time: ArrayLike, attack: ArrayLike, hold: ArrayLike, release: ArrayLike, exponent: ArrayLike
) -> Array:
    r"""Amplitude of a breath whose flow rises and falls by a quarter of a sine each (physiology 3.3).

    :math:`flow^a` of a flow that is 1 during the hold; 0 outside.

    Args:
        time: Seconds since the attack began; any shape.
        attack: Seconds, 0 or more.
        hold: Seconds, 0 or more.
        release: Seconds, 0 or more.
        exponent: Above 0: 1.66 (Gavriely & Cugell 1996).

    >>> flow_envelope([-1.0, 0.0, 1.0, 3.0, 4.5, 6.0], 2.0, 2.0, 1.0, 2.0).round(6).tolist()
    [0.0, 0.0, 0.5, 1.0, 0.5, 0.0]
    """
    flow = np.sin(0.5 * np.pi * trapezoid(time, attack, hold, release))
    return np.asarray(flow ** np.asarray(exponent, dtype=np.float64), dtype=np.float64)


FASTEST = 1.875
"""Highest speed of `smooth_step`, relative to its mean."""


def smooth_step(progress: ArrayLike) -> Array:
    r"""From 0 to 1 with the least jerk: :math:`10x^3 - 15x^4 + 6x^5`, held beyond both ends.

    Speed and acceleration are 0 at both ends; the highest speed is 15/8 of the mean (`FASTEST`). Hands, heads, lids
    and eyes move about like this (Flash & Hogan 1985).

    Args:
        progress: Share of the time that has passed; any shape.

    >>> smooth_step([-1.0, 0.0, 0.25, 0.5, 1.0, 2.0]).tolist()
    [0.0, 0.0, 0.103515625, 0.5, 1.0, 1.0]
    """
    x = np.clip(np.asarray(progress, dtype=np.float64), 0.0, 1.0)
    return np.asarray(x * x * x * (10.0 + x * (6.0 * x - 15.0)), dtype=np.float64)


def rise_and_fall(time: ArrayLike, rise: ArrayLike, hold: ArrayLike, fall: ArrayLike) -> Array:
    r"""A `trapezoid` whose ramps are `smooth_step`: 0 outside, 1 while it holds.

    Args:
        time: Seconds since the rise began; any shape.
        rise: Seconds, 0 or more.
        hold: Seconds, 0 or more.
        fall: Seconds, 0 or more.

    >>> rise_and_fall([-1.0, 0.0, 1.0, 3.0, 4.5, 6.0], 2.0, 2.0, 1.0).tolist()
    [0.0, 0.0, 0.5, 1.0, 0.5, 0.0]
    """
    return smooth_step(trapezoid(time, rise, hold, fall))


def sine_volume(progress: ArrayLike, peak: ArrayLike = 0.5) -> Array:
    r"""Share of the volume moved when flow rises as a quarter of a sine and falls as another (physiology 1.6, 3.3).

    With the flow highest at :math:`p`: :math:`p (1 - \cos \frac{\pi x}{2 p})` for :math:`x < p`, else
    :math:`p + (1 - p) \sin \frac{\pi (x - p)}{2 (1 - p)}`; at :math:`p = 1/2` flow is half a sine.

    Args:
        progress: Share of the time that has passed, 0..1.
        peak: Share of the time at which the flow is highest, above 0 and below 1.

    >>> sine_volume([0.0, 0.5, 1.0]).round(12).tolist()
    [0.0, 0.5, 1.0]
    >>> sine_volume([0.2, 0.4, 0.7], 0.4).round(6).tolist()
    [0.117157, 0.4, 0.824264]
    """
    half, top, share = _half_turns(progress, peak)
    return np.asarray(top - share * np.cos(np.pi * half), dtype=np.float64)


def sine_flow(progress: ArrayLike, peak: ArrayLike = 0.5) -> Array:
    r"""Flow of `sine_volume` relative to its mean: its highest, at the peak, is :math:`\pi / 2`.

    >>> sine_flow([0.0, 0.5, 1.0]).round(6).tolist()
    [0.0, 1.570796, 0.0]
    >>> sine_flow([0.2, 0.4, 0.7], 0.4).round(6).tolist()
    [1.110721, 1.570796, 1.110721]
    """
    half, _, _ = _half_turns(progress, peak)
    return np.asarray(0.5 * np.pi * np.sin(np.pi * half), dtype=np.float64)


def _half_turns(progress: ArrayLike, peak: ArrayLike) -> tuple[Array, Array, Array]:
    """How far the sine has gone, 0..1, a half of it at the peak; the peak; and the length of the quarter under way."""
    x, p = np.broadcast_arrays(np.asarray(progress, dtype=np.float64), np.asarray(peak, dtype=np.float64))
    rising = x < p
    share = np.where(rising, p, 1.0 - p)
    return np.where(rising, 0.0, 0.5) + np.where(rising, x, x - p) / (2.0 * share), p, share


TIME_CONSTANTS = 4.0
"""Of the chest's recoil in one exponential expiration: at rest Te = 2.1 s, so tau = 0.53 s (physiology 1.6)."""
HIGHEST_FLOW = MappingProxyType(
    {"linear": 1.0, "sine": np.pi / 2, "exponential": float(TIME_CONSTANTS / -np.expm1(-TIME_CONSTANTS))}
)
"""Highest flow of each profile, relative to its mean."""


def exponential_volume(progress: ArrayLike) -> Array:
    r"""Share of the volume that the chest's own recoil has moved: :math:`(1 - e^{-kx}) / (1 - e^{-k})`, :math:`k = 4`.

    Args:
        progress: Share of the time that has passed, 0..1.

    >>> exponential_volume([0.0, 0.25, 1.0]).round(6).tolist()
    [0.0, 0.643914, 1.0]
    """
    x = np.asarray(progress, dtype=np.float64)
    return np.asarray(np.expm1(-TIME_CONSTANTS * x) / np.expm1(-TIME_CONSTANTS), dtype=np.float64)


def exponential_flow(progress: ArrayLike) -> Array:
    r"""Flow of `exponential_volume` relative to its mean: :math:`k e^{-kx} / (1 - e^{-k})`; highest as it begins.

    >>> exponential_flow([0.0, 0.25, 1.0]).round(6).tolist()
    [4.074629, 1.498972, 0.074629]
    """
    x = np.asarray(progress, dtype=np.float64)
    return np.asarray(TIME_CONSTANTS * np.exp(-TIME_CONSTANTS * x) / -np.expm1(-TIME_CONSTANTS), dtype=np.float64)


def level_db(amplitude: ArrayLike, floor: float) -> Array:
    r""":math:`20 \log_{10}(amplitude)`, never below `floor`, which is also the level of 0.

    >>> level_db([0.0, 0.1, 1.0], -80.0).tolist()
    [-80.0, -20.0, 0.0]
    """
    smallest = 10.0 ** (floor / 20.0)
    heard = np.maximum(np.asarray(amplitude, dtype=np.float64), smallest)
    return np.asarray(np.maximum(20.0 * np.log10(heard), floor), dtype=np.float64)
