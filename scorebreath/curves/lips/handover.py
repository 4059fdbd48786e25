"""From the mouth of a breath to the mouth of speech: what holds the jaw in the silence before the first phone.

A breath's trapezoid lets the mouth fall shut as the inspiration ends, and the first phone opens it a moment later.
Seen, that is a snap. So the jaw takes the opening over while the breath still holds it, and brings it to where the
first phone has it at its onset: held where speech opens the mouth further, else gliding down. Nothing of it is left
once speech has begun, and where lips must touch they do.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.curves.lips.gates import ease
from scorebreath.curves.nose_and_mouth import FaceShape
from scorebreath.curves.tracks import Array
from scorebreath.score.events import EVENTS, Utterance

LEAD = EVENTS[Utterance.type][1].lead
"""s before its onset that an utterance may change anything"""
RISE = 0.1
"""s in which the jaw takes over, behind the breath's own opening"""
STEEPEST = 5.0
"""Opening a second of a glide's mean; the highest is half as much again, below the channel's speed of 8."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Handover:
    """One for each utterance that follows a breath through the mouth, in order of time."""

    begin: Array
    """(n,) s; when the jaw begins to take over"""
    onset: Array
    """(n,) s; of the utterance, when it is over"""
    top: Array
    """(n,) 0..1; taken over"""
    low: Array
    """(n,) 0..1, at most `top`; where it has come to at the onset"""

    def sample(self, times: Array) -> Array:
        """How far the jaw is held open, at least; (n,)."""
        if not len(self.onset):
            return np.zeros(times.shape)
        index = np.minimum(np.searchsorted(self.onset, times), len(self.onset) - 1)
        since = times - self.begin[index]
        left = self.onset[index] - times
        risen = ease(since / RISE)
        fallen = ease((since - RISE) / np.maximum(self.onset[index] - self.begin[index] - RISE, 1e-9))
        level = self.top[index] + (self.low[index] - self.top[index]) * fallen
        return np.where((since > 0.0) & (left >= 0.0), level * risen, 0.0)


NOTHING = Handover(begin=np.zeros(0), onset=np.zeros(0), top=np.zeros(0), low=np.zeros(0))
"""No breath before any speech."""


def handover(mouth: FaceShape, onsets: Array, before: Array, jaw: Array) -> Handover:
    """Plan them.

    Args:
        mouth: The breath's.
        onsets: (n,) s, ascending; of utterances.
        before: (n,) s; end of what is said before each.
        jaw: (n,) how far speech alone opens the jaw at each onset.
    """
    if not len(mouth.begin) or not len(onsets):
        return NOTHING
    index = np.searchsorted(mouth.begin, onsets) - 1
    breath = np.maximum(index, 0)
    lets_go = mouth.begin[breath] + mouth.attack[breath] + mouth.hold[breath]
    # Neither before the utterance's reach nor before the breath's; and it has to be over when the utterance begins.
    taken = np.minimum(np.maximum(np.maximum(lets_go, mouth.begin[breath] + RISE), onsets - LEAD + RISE), onsets)
    glide = onsets - taken
    held = mouth.sample(taken)
    low = np.minimum(held, jaw)
    top = np.minimum.reduce([held, low + STEEPEST * glide, np.full(len(held), STEEPEST * RISE)])
    kept = (index >= 0) & (top > 0.0) & (taken - RISE >= before) & (glide > 0.0)
    return Handover(begin=(taken - RISE)[kept], onset=onsets[kept], top=top[kept], low=np.minimum(low, top)[kept])
