r"""Shapes over time: ramp, trapezoid, and the two ways of moving air; floats or arrays in, arrays out.

Every function works element by element, so one sample's value never depends on which others are asked for.
"""

from __future__ import annotations

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


def half_sine_volume(progress: ArrayLike) -> Array:
    r"""Share of the volume moved when flow is half a sine: :math:`(1 - \cos \pi x) / 2` (physiology 1.6).

    Args:
        progress: Share of the time that has passed, 0..1.

    >>> half_sine_volume([0.0, 0.5, 1.0]).round(12).tolist()
    [0.0, 0.5, 1.0]
    """
    return np.asarray(0.5 - 0.5 * np.cos(np.pi * np.asarray(progress, dtype=np.float64)), dtype=np.float64)


def half_sine_flow(progress: ArrayLike) -> Array:
    r"""Flow of `half_sine_volume` relative to its mean: :math:`\frac{\pi}{2} \sin \pi x`.

    >>> half_sine_flow([0.0, 0.5, 1.0]).round(6).tolist()
    [0.0, 1.570796, 0.0]
    """
    return np.asarray(0.5 * np.pi * np.sin(np.pi * np.asarray(progress, dtype=np.float64)), dtype=np.float64)


def level_db(amplitude: ArrayLike, floor: float) -> Array:
    r""":math:`20 \log_{10}(amplitude)`, never below `floor`, which is also the level of 0.

    >>> level_db([0.0, 0.1, 1.0], -80.0).tolist()
    [-80.0, -20.0, 0.0]
    """
    smallest = 10.0 ** (floor / 20.0)
    heard = np.maximum(np.asarray(amplitude, dtype=np.float64), smallest)
    return np.asarray(np.maximum(20.0 * np.log10(heard), floor), dtype=np.float64)
