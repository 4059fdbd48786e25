"""Shares of a few prototypes in what the lips do: how the shapes of speech become visemes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.curves.tracks import Array

NEAR = 0.3
"""Square of the distance, in widths, within which a prototype is as good as met."""


@dataclass(frozen=True, slots=True)
class Prototypes:
    r"""Points in the space of some channels.

    The share of prototype :math:`i` at a point is :math:`w_i / \sum_j w_j` with :math:`w = (d^2 + 0.3)^{-2}`, where
    :math:`d` is the point's distance from it, each channel measured in its own width (Shepard's inverse distances).
    Shares are in 0..1 and add up to 1; at a prototype its own is the highest; on the way from one to another they
    cross over about as long as the channels move, where nearer ones of a Gaussian would change places at once.
    """

    names: tuple[str, ...]
    """of the prototypes"""
    channels: tuple[str, ...]
    """channels or drivers in which they are told apart"""
    points: Array
    """(prototypes, channels)"""
    widths: Array
    """(channels,)"""

    def shares(self, values: Array) -> Array:
        """Shares at n points: (channels, n) in, (prototypes, n) out."""
        square = np.zeros((len(self.names), values.shape[1]))
        for channel, row in enumerate(values):
            square += ((row - self.points[:, channel, np.newaxis]) / self.widths[channel]) ** 2
        near = 1.0 / (square + NEAR) ** 2
        total = np.zeros(values.shape[1])
        for row in near:  # in order, or the last bit would depend on how many moments are asked for
            total += row
        return np.asarray(near / total)
