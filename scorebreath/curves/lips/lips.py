"""The lips' channels of one body: dominance functions of its phones (A13-A16), and what must touch."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from scorebreath.curves.lips.gates import Gate, ease, gate
from scorebreath.curves.lips.handover import NOTHING, Handover, handover
from scorebreath.curves.lips.strings import GONE, WHOLE, PhoneString, phone_string
from scorebreath.curves.lips.targets import CLOSE, JAW, LIP_CHANNELS, TUCK, targets
from scorebreath.curves.lips.visemes import Visemes, visemes
from scorebreath.curves.nose_and_mouth import face_shape
from scorebreath.curves.tracks import Acts, Array, Index, track
from scorebreath.equations.dominance import dominance
from scorebreath.score.events import Expiration, Inspiration, Utterance
from scorebreath.units import GRID

__all__ = ["LIP_CHANNELS", "Lips", "lips"]

REST, REST_MOST = 0.005, 1.0
"""Dominance of the rest, whose target is 0: small within speech, so that the sum of dominances never vanishes
(physiology 7.1); in silence it grows, the further away speech is, up to the most."""
REST_GROWTH = (25.0, 45.0)
"""1/s; of the jaw, of the others. Slower than the phones', it would let a sound before the last one come back."""
BRIEF = 0.03
"""s; a shorter phone asks less firmly, in proportion: a few next to each other must not outweigh a whole one."""
BLOCK = 2048
"""Moments computed at a time, for the processor's cache."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lips:
    """A body's speech as arrays, ready to be sampled."""

    string: PhoneString
    alpha: Array
    """(segments, 7) dominance at the centre"""
    asked: Array
    """(segments, 7) dominance times target"""
    before: Array
    """(segments, 2) 1/s; of the jaw, of the others"""
    after: Array
    """(segments, 2) 1/s"""
    closures: Gate
    """p, b, m"""
    tucks: Gate
    """f, v"""
    handover: Handover
    """from the breath's mouth"""
    visemes: Visemes

    def sample(self, times: Array, mouth_open: Array, *, closure_gate: bool = True) -> Array:
        """Values of LIP_CHANNELS.

        Args:
            times: Seconds, (n,), in any order.
            mouth_open: (n,), of the breath: the closure gate shuts it, too.
            closure_gate: Whether p, b and m shut the lips whatever the sum says.

        Returns:
            (n, 7) in 0..1.
        """
        values = np.zeros((len(times), len(LIP_CHANNELS)))
        if not len(self.string):
            return values
        for first in range(0, len(times), BLOCK):
            self._blend(times[first : first + BLOCK], values[first : first + BLOCK])
        np.maximum(values[:, JAW], self.handover.sample(times), out=values[:, JAW])
        if closure_gate:
            np.maximum(values[:, CLOSE], self.closures.sample(times), out=values[:, CLOSE])
            np.maximum(values[:, TUCK], self.tucks.sample(times), out=values[:, TUCK])
        return values

    def _blend(self, times: Array, out: Array) -> None:
        """The plain sum: means of the targets in range, weighted by their dominances."""
        string = self.string
        last = len(string) - 1
        at = np.searchsorted(string.start, times, side="right") - 1
        here, following = np.maximum(at, 0), np.minimum(at + 1, last)
        begun, more = at >= 0, at < last
        since_end = np.where(begun, times - string.end[here], np.inf)
        to_next = np.where(more, string.start[following] - times, np.inf)
        silent = np.maximum(np.minimum(since_end, to_next), 0.0)
        weights = _rest(silent)[:, _GROUP]
        sums = np.zeros_like(weights)
        # on the clock: how far the segment begun last is over, and how far off the next one is
        length = string.end[here] - string.start[here]
        counts = string.clock_end[here] - string.clock_start[here]
        within = since_end < 0.0
        behind = np.where(within, since_end / length * counts, since_end * GRID)
        ahead = np.where(within, string.clock_start[following] - string.clock_end[here] - behind, to_next * GRID)
        ahead = np.where(more, ahead, np.inf)
        for step in range(len(string)):
            place = at - step
            away = behind + (string.clock_end[here] - string.clock_end[np.maximum(place, 0)])
            if not self._add(times, place, np.where(place >= 0, away, np.inf), weights, sums):
                break
        for step in range(len(string)):
            place = at + 1 + step
            away = ahead + (string.clock_start[np.minimum(place, last)] - string.clock_start[following])
            if not self._add(times, place, np.where(place <= last, away, np.inf), weights, sums):
                break
        np.divide(sums, weights, out=out)

    def _add(self, times: Array, place: Index, away: Array, weights: Array, sums: Array) -> bool:
        """Add one segment for each moment, where it is in range; whether it was anywhere."""
        near = np.flatnonzero(away < GONE)
        if not near.size:
            return False
        segment = place[near]
        fade = _fade(away[near])
        tau = self.string.centre[segment] - times[near]
        falls = dominance(tau[:, np.newaxis], fade[:, np.newaxis], self.before[segment], self.after[segment])
        spread = falls[:, _GROUP]
        weights[near] += self.alpha[segment] * spread
        sums[near] += self.asked[segment] * spread
        return True


_GROUP = np.array([0 if channel == JAW else 1 for channel in range(len(LIP_CHANNELS))])
"""Which theta is each channel's."""


def _rest(silent: Array) -> Array:
    """Dominance of the rest, so many seconds from speech, over the jaw and over the others: (n, 2)."""
    grown = np.exp(np.minimum(silent, 1.0)[:, np.newaxis] * REST_GROWTH)
    return np.asarray(np.minimum(REST * grown, REST_MOST))


def _fade(away: Array) -> Array:
    """1 up to WHOLE on the clock, 0 at GONE."""
    return ease((GONE - away) / (GONE - WHOLE))


def lips(score: Acts, body: str) -> Lips:
    """Gather the utterances of one body.

    Raises:
        ScoreError: Two utterances overlap, or phones do, or a phone leaves its utterance.
    """
    spoken = track([said for said in score.of(Utterance, body) if said.phones], "utterances")
    string = phone_string(spoken)
    table = targets()
    firmness = np.minimum((string.end - string.start) / BRIEF, 1.0)[:, np.newaxis]
    alone = Lips(
        string=string,
        alpha=table.alpha[string.row] * firmness,
        asked=(table.alpha * table.target)[string.row] * firmness,
        before=table.before[string.row],
        after=table.after[string.row],
        closures=gate(string, "lip_close"),
        tucks=gate(string, "lip_tuck"),
        handover=NOTHING,
        visemes=visemes(string),
    )
    breaths = [e for e in score.events if isinstance(e, Inspiration | Expiration) and e.body == body]
    jaw = alone.sample(spoken.start, np.zeros(spoken.start.shape), closure_gate=False)[:, JAW]
    before = np.concatenate([[-np.inf], spoken.end])[: len(spoken.end)]
    return replace(alone, handover=handover(face_shape(breaths, "mouth"), spoken.start, before, jaw))
