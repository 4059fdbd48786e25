r"""Dominance functions (A13; Cohen & Massaro 1993, as S3 5 takes them over).

A phone asks for a target and says how firmly: its dominance is highest at its centre and falls off on both sides.
Where several phones ask, the articulator goes to the mean of their targets, each weighted by its dominance.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def dominance(tau: ArrayLike, alpha: ArrayLike, before: ArrayLike, after: ArrayLike, exponent: float = 1.0) -> Array:
    r""":math:`D(\tau) = \alpha e^{-\theta |\tau|^c}` with :math:`\tau` = the phone's centre less the time (A13).

    :math:`\theta` is :math:`\theta_\leftarrow` for :math:`\tau \ge 0`, which is before the centre, where the phone is
    anticipated, else :math:`\theta_\rightarrow`.

    Args:
        tau: Seconds; any shape.
        alpha: :math:`\alpha`, strength at the centre.
        before: :math:`\theta_\leftarrow`, 1/s (with c = 1).
        after: :math:`\theta_\rightarrow`, likewise.
        exponent: :math:`c`; above 1 the top is flatter.

    >>> dominance([0.1, 0.0, -0.1], 0.5, 10.0, 20.0).round(6).tolist()
    [0.18394, 0.5, 0.067668]
    >>> bool(dominance(0.1, 1.0, 10.0, 20.0) == dominance(-0.1, 1.0, 20.0, 10.0))
    True
    """
    lag = np.asarray(tau, dtype=np.float64)
    theta = np.where(lag >= 0.0, before, after)
    distance = np.abs(lag) if exponent == 1.0 else np.abs(lag) ** exponent
    return np.asarray(alpha * np.exp(-theta * distance), dtype=np.float64)


def blend(targets: ArrayLike, dominances: ArrayLike, rest: ArrayLike) -> Array:
    r""":math:`F = \sum_s D_s T_s / (D_r + \sum_s D_s)` over the phones :math:`s`; at rest the target is 0 (A13).

    Args:
        targets: :math:`T_s`, (phones, ...).
        dominances: :math:`D_s`, (phones, ...).
        rest: :math:`D_r`, dominance of the rest, above 0.

    >>> blend([1.0, 0.0], [0.6, 0.2], 0.2).item()
    0.6
    >>> blend([1.0], [0.0], 0.01).item()
    0.0
    """
    weights = np.asarray(dominances, dtype=np.float64)
    asked = (weights * np.asarray(targets, dtype=np.float64)).sum(axis=0)
    return np.asarray(asked / (rest + weights.sum(axis=0)), dtype=np.float64)
