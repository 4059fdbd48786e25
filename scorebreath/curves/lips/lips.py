"""The lips' channels of one body."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.curves.tracks import Array
from scorebreath.score.document import Score

LIP_CHANNELS = ("jaw_open", "lip_close", "lip_round", "lip_spread", "lip_tuck", "tongue_tip", "tongue_back")
"""In the columns of what `Lips.sample` gives."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lips:
    """A body's speech as arrays, ready to be sampled."""

    def sample(self, times: Array, mouth_open: Array, *, closure_gate: bool = True) -> Array:
        """Values of LIP_CHANNELS.

        Args:
            times: Seconds, (n,), in any order.
            mouth_open: (n,), of the breath: the closure gate shuts it, too.
            closure_gate: Whether p, b and m shut the lips whatever the sum says.

        Returns:
            (n, 7) in 0..1.
        """
        return np.zeros((len(times), len(LIP_CHANNELS)))


def lips(score: Score, body: str) -> Lips:
    """Gather the utterances of one body."""
    return Lips()
