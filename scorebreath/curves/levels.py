"""How loud speech and breath are, in dB relative to the voice's reference."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.curves.strokes import VolumeEvent, soundings_of
from scorebreath.curves.tracks import Array, Index, Mask, Track, track
from scorebreath.equations import shapes
from scorebreath.equations.breath import FLOW_EXPONENT, flow_loudness, mix_level
from scorebreath.score.document import Score
from scorebreath.score.events import Expiration, Hold, Inspiration, Noise, Utterance
from scorebreath.units import FLOOR_DB, decibels


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
    """The audible breaths of a body, each gasp and puff a row."""

    begin: Array
    """(n,) s, ascending"""
    end: Array
    """(n,) s"""
    attack: Array
    """(n,) s"""
    hold: Array
    """(n,) s"""
    release: Array
    """(n,) s"""
    db: Array
    """(n,) at its loudest, dB re reference"""
    flow: Mask
    """(n,) whether amplitude follows the flow, instead of straight ramps"""

    def sample(self, times: Array) -> Array:
        """Level of what began last and still sounds at each time; FLOOR_DB in between."""
        if not self.begin.size:
            return np.full(times.shape, FLOOR_DB)
        last = np.searchsorted(self.begin, times, side="right") - 1
        index = np.maximum(last, 0)
        ramps = times - self.begin[index], self.attack[index], self.hold[index], self.release[index]
        shape = shapes.trapezoid(*ramps)
        if self.flow.any():
            shape = np.where(self.flow[index], shapes.flow_envelope(*ramps, FLOW_EXPONENT), shape)
        level = np.maximum(self.db[index] + shapes.level_db(shape, 2 * FLOOR_DB), FLOOR_DB)
        return np.where((last >= 0) & (times <= self.end[index]), level, FLOOR_DB)


def breath_level(score: Score, body: str) -> BreathLevel:
    """The audible breaths of one body; levels count the gains of nose and mouth.

    Raises:
        ScoreError: A noise is longer than its breath.
    """
    rows: list[tuple[float, ...]] = []
    for event in score.events:
        if isinstance(event, Inspiration | Expiration | Hold) and event.body == body and event.noise is not None:
            noise = event.noise
            db, follows = loudest_db(noise) + _gain_db(event), float(noise.envelope == "flow")
            for sounding in soundings_of(event):
                times = event.onset + sounding.onset, event.onset + sounding.end
                rows.append((*times, sounding.attack, sounding.hold, sounding.release, db, follows))
    begin, end, attack, hold, release, level, flow = np.array(sorted(rows), dtype=np.float64).reshape(-1, 7).T.copy()
    return BreathLevel(begin=begin, end=end, attack=attack, hold=hold, release=release, db=level, flow=flow > 0)


def loudest_db(noise: Noise) -> float:
    """Level of a noise at unit gain where it is loudest: above its `level_db` where only that moment is as loud.

    >>> common = {"onset": 0.0, "duration": 0.5, "level_db": -24.0, "seed": 1, "envelope": "flow"}
    >>> noise = Noise(attack=0.2, hold=0.0, release=0.3, **common)
    >>> round(loudest_db(noise), 2)
    -22.43
    """
    if noise.envelope == "trapezoid":
        return noise.level_db
    return noise.level_db - decibels(flow_loudness(noise.attack, noise.hold, noise.release, FLOW_EXPONENT))


def _gain_db(event: VolumeEvent) -> float:
    """Of nose and mouth together; two silent sounds are silent (the logarithm of nothing is not a number)."""
    if isinstance(event, Hold):  # the throat has no gain of its own, and is heard where it shuts
        return 0.0 if event.kind == "held" else 2 * FLOOR_DB
    if event.sound_mouth <= 0 and event.sound_nose <= 0:
        return 2 * FLOOR_DB
    return mix_level(event.sound_mouth, event.sound_nose)
