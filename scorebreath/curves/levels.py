"""How loud speech and breath are, in dB relative to the voice's reference."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.curves.tracks import TOUCH, Array, Index, Track, track
from scorebreath.equations import shapes
from scorebreath.equations.breath import mix_level
from scorebreath.errors import ScoreError
from scorebreath.score.document import Score
from scorebreath.score.events import Expiration, Inspiration, Noise, Utterance
from scorebreath.units import FLOOR_DB


@dataclass(frozen=True, slots=True)
class SpeechLevel:
    """The measured levels of a body's utterances, end to end in one array."""

    track: Track[Utterance]
    db: Array
    """(all,) dB re reference"""
    first: Index
    """(n,) where each utterance's values begin"""
    count: Index
    """(n,) how many there are"""
    step: Array
    """(n,) s"""

    def sample(self, times: Array) -> Array:
        """Straight lines from value to value, the outer ones held to the edges; FLOOR_DB outside utterances."""
        if not self.db.size:
            return np.full(times.shape, FLOOR_DB)
        index, active = self.track.at(times)
        last = self.count[index] - 1.0
        at = np.clip((times - self.track.start[index]) / self.step[index] - 0.5, 0.0, last)
        below = np.floor(at).astype(np.intp)
        above = np.minimum(below + 1, self.count[index] - 1)
        low, high = self.db[self.first[index] + below], self.db[self.first[index] + above]
        return np.where(active, np.maximum(low + (high - low) * (at - below), FLOOR_DB), FLOOR_DB)


def speech_level(score: Score, body: str, reference_db: float) -> SpeechLevel:
    """The levels of one body's utterances.

    Raises:
        ScoreError: Two utterances overlap.
    """
    spoken = track([u for u in score.of(Utterance, body) if u.level.db], "utterances")
    count = np.array([len(event.level.db) for event in spoken.events], dtype=np.intp)
    gained = [np.asarray(e.level.db, dtype=np.float64) + (e.gain_db - reference_db) for e in spoken.events]
    return SpeechLevel(
        track=spoken,
        db=np.concatenate(gained) if gained else np.zeros(0),
        first=np.cumsum(count) - count,
        count=count,
        step=spoken.column(lambda e: e.level.step),
    )


@dataclass(frozen=True, slots=True)
class BreathLevel:
    """The audible breaths of a body."""

    begin: Array
    """(n,) s"""
    end: Array
    """(n,) s"""
    attack: Array
    hold: Array
    release: Array
    db: Array
    """(n,) over the hold, dB re reference"""

    def sample(self, times: Array) -> Array:
        """Level of the trapezoid that sounds at each time; FLOOR_DB in between."""
        if not self.begin.size:
            return np.full(times.shape, FLOOR_DB)
        last = np.searchsorted(self.begin, times, side="right") - 1
        index = np.maximum(last, 0)
        since = times - self.begin[index]
        shape = shapes.trapezoid(since, self.attack[index], self.hold[index], self.release[index])
        level = np.maximum(self.db[index] + shapes.level_db(shape, 2 * FLOOR_DB), FLOOR_DB)
        return np.where((last >= 0) & (times <= self.end[index]), level, FLOOR_DB)


def breath_level(score: Score, body: str) -> BreathLevel:
    """The audible breaths of one body; an inspiration's level counts the gains of its two sounds.

    Raises:
        ScoreError: A noise is longer than its breath.
    """
    rows: list[tuple[float, ...]] = []
    for event in score.events:
        if isinstance(event, Inspiration | Expiration) and event.body == body and event.noise is not None:
            noise = event.noise
            _check(event, noise)
            db = noise.level_db + (_gain_db(event) if isinstance(event, Inspiration) else 0.0)
            begin = event.onset + noise.onset
            rows.append((begin, begin + noise.duration, noise.attack, noise.hold, noise.release, db))
    table = np.array(sorted(rows), dtype=np.float64).reshape(-1, 6)
    return BreathLevel(*(np.ascontiguousarray(column) for column in table.T))


def _gain_db(event: Inspiration) -> float:
    """Of nose and mouth together; two silent sounds are silent (the logarithm of nothing is not a number)."""
    if event.sound_mouth <= 0 and event.sound_nose <= 0:
        return 2 * FLOOR_DB
    return mix_level(event.sound_mouth, event.sound_nose)


def _check(event: Inspiration | Expiration, noise: Noise) -> None:
    if min(noise.attack, noise.hold, noise.release, noise.onset) < 0 or (
        noise.onset + noise.duration > event.duration + 2 * TOUCH
    ):
        raise ScoreError(
            f"event {event.id!r}: noise onset={noise.onset:g}, duration={noise.duration:g} must lie within its "
            f"{event.duration:g} s, and attack, hold, release be >= 0"
        )
