"""Shares of a few prototypes in what the lips do: how the shapes of speech become visemes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.curves.tracks import Array


@dataclass(frozen=True, slots=True)
class Prototypes:
    r"""Points in the space of some channels.

    The share of prototype :math:`i` at a point :math:`x` is :math:`e^{-d_i^2 / 2} / \sum_j e^{-d_j^2 / 2}`, where
    :math:`d_i` is the distance of :math:`x` from it, each channel measured in its own width. Shares are in 0..1, add
    up to 1 and move as smoothly as the channels; at a prototype, its own is the highest.
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
        near = np.exp(-0.5 * (square - square.min(axis=0)))
        total = np.zeros(values.shape[1])
        for row in near:  # in order, or the last bit would depend on how many moments are asked for
            total += row
        return np.asarray(near / total)
