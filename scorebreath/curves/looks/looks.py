"""What the events of the face come to at any time, each kind by itself; `curves.channels` puts them together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.curves.tracks import Array
from scorebreath.score.document import Score


@dataclass(frozen=True, slots=True, kw_only=True)
class Looks:
    """A body's events of the face as arrays, ready to be sampled."""

    def blinks(self, times: Array) -> Array:
        """How far the lids are closed by blinks, left and right: (n, 2) in 0..1."""
        return np.zeros((len(times), 2))

    def brows(self, times: Array) -> Array:
        """Raise of the left and the right brow, and frown, all brow events together: (n, 3)."""
        return np.zeros((len(times), 3))

    def head(self, times: Array) -> Array:
        """Pitch, yaw and roll, all head events together, without breath and emotion: (n, 3) degrees."""
        return np.zeros((len(times), 3))

    def gaze(self, times: Array) -> Array:
        """Where the eyes look in the chest's frame, yaw and pitch: (n, 2) degrees."""
        return np.zeros((len(times), 2))

    def emotion(self, name: str, times: Array) -> Array:
        """Intensity of an emotion: (n,) in 0..1; equal emotions take the higher one (Y5)."""
        return np.zeros(len(times))


def looks(score: Score, body: str) -> Looks:
    """Gather the face's events of one body."""
    return Looks()
