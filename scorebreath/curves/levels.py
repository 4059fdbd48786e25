"""How loud speech and breath are, in dB relative to the voice's reference."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from scorebreath.curves.heard import Gains, gains, in_decibels
from scorebreath.curves.strokes import VolumeEvent, soundings_of
from scorebreath.curves.tracks import Acts, Array, Index, Mask, Track, track
from scorebreath.equations import shapes
from scorebreath.equations.breath import FLOW_EXPONENT, NOSE_BELOW_MOUTH_DB, flow_loudness, mix_level
from scorebreath.score.cutting import Ending, cut_short, endings, never
from scorebreath.score.events import Expiration, Hold, Inspiration, Noise, Utterance
from scorebreath.units import FLOOR_DB, amplitude, decibels, snap

SYNTH = "synth"
"""`Noise.source` of what is not recorded."""


@dataclass(frozen=True, slots=True)
class Tails:
    """What fades out behind cuts, in order of the cuts; one fades at a time, the latest."""

    row: Index
    """(n,) of what was cut"""
    begin: Array
    """(n,) s; the cuts"""
    end: Array
    """(n,) s; where it would have ended or has faded"""
    fade: Array
    """(n,) s"""

    def sample(self, times: Array, level: Callable[[Index, Array], Array]) -> Array:
        """Levels of what fades, FLOOR_DB where nothing does.

        Args:
            times: Seconds, (n,).
            level: What rows would be at some times, had they not been cut, dB.
        """
        last = np.searchsorted(self.begin, times, side="right") - 1
        index = np.maximum(last, 0)
        left = 1.0 - (times - self.begin[index]) / np.maximum(self.fade[index], 1e-9)
        faded = level(self.row[index], times) + in_decibels(left)
        return np.asarray(np.where((last >= 0) & (times <= self.end[index]), np.maximum(faded, FLOOR_DB), FLOOR_DB))


def _tails(rows: Sequence[tuple[float, float, float, int]]) -> Tails | None:
    """Of begin, end, fade and row each; None where there are none."""
    if not rows:
        return None
    begin, end, fade, row = np.array(sorted(rows), dtype=np.float64).T.copy()
    return Tails(row=row.astype(np.intp), begin=begin, end=end, fade=fade)


@dataclass(frozen=True, slots=True)
class SpeechLevel:
    """The measured levels of a body's utterances, end to end in one array."""

    track: Track[Utterance]
    """as far as they are said"""
    db: Array
    """(all,) dB re reference"""
    first: Index
    """(n,) where each utterance's values begin"""
    count: Index
    """(n,) how many there are"""
    step: Array
    """(n,) s"""
    tails: Tails | None = None
    """of those that are cut"""
    gains: Gains | None = None
    """by moves of parameters"""

    def sample(self, times: Array) -> Array:
        """Straight lines from value to value, the outer ones held to the edges; FLOOR_DB outside utterances."""
        if not self.db.size:
            return np.full(times.shape, FLOOR_DB)
        index, active = self.track.at(times)
        level = np.where(active, self._line(index, times), FLOOR_DB)
        if self.tails is not None:
            level = np.maximum(level, self.tails.sample(times, self._line))
        if self.gains is not None:
            level = _moved(level, in_decibels(self.gains.at(times, "speech")))
        return level

    def _line(self, index: Index, times: Array) -> Array:
        """Levels of some utterances, whether they are under way or not."""
        last = self.count[index] - 1.0
        at = np.clip((times - self.track.start[index]) / self.step[index] - 0.5, 0.0, last)
        below = np.floor(at).astype(np.intp)
        above = np.minimum(below + 1, self.count[index] - 1)
        low, high = self.db[self.first[index] + below], self.db[self.first[index] + above]
        return np.asarray(np.maximum(low + (high - low) * (at - below), FLOOR_DB))


def _moved(level: Array, by: Array) -> Array:
    """Levels moved by some dB; what is silent stays silent."""
    return np.where(level > FLOOR_DB, np.maximum(level + by, FLOOR_DB), FLOOR_DB)


def speech_level(score: Acts, body: str, reference_db: float) -> SpeechLevel:
    """The levels of one body's utterances, as far as they are said, as loud as parameters make them.

    Raises:
        ScoreError: Two utterances overlap.
    """
    ends = endings(score.events)
    spoken = track(
        [cut_short(u, ends) for u in score.of(Utterance, body) if u.level.db and not never(u, ends)], "utterances"
    )
    count = np.array([len(event.level.db) for event in spoken.events], dtype=np.intp)
    gained = [np.asarray(e.level.db, dtype=np.float64) + (e.gain_db - reference_db) for e in spoken.events]
    tails: list[tuple[float, float, float, int]] = []
    if ends:
        rows = {event.id: row for row, event in enumerate(spoken.events)}
        for said in score.of(Utterance, body):
            if said.id in rows and said.id in ends and ends[said.id].shortens(said):
                cut = ends[said.id]
                tails.append((cut.time, min(cut.time + cut.fade, snap(said.end)), cut.fade, rows[said.id]))
    return SpeechLevel(
        track=spoken,
        db=np.concatenate(gained) if gained else np.zeros(0),
        first=np.cumsum(count) - count,
        count=count,
        step=spoken.column(lambda e: e.level.step),
        tails=_tails(tails),
        gains=gains(score, body, ends),
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
    mouth: Array
    """(n,) amplitude of what a move of the mouth's gain changes"""
    nose: Array
    """(n,) likewise the nose's"""
    tails: Tails | None = None
    """of those that are cut"""
    gains: Gains | None = None
    """by moves of parameters"""

    def sample(self, times: Array) -> Array:
        """Level of what began last and still sounds at each time; FLOOR_DB in between."""
        if not self.begin.size:
            return np.full(times.shape, FLOOR_DB)
        last = np.searchsorted(self.begin, times, side="right") - 1
        index = np.maximum(last, 0)
        level = np.where((last >= 0) & (times <= self.end[index]), self._shape(index, times), FLOOR_DB)
        if self.tails is not None:
            level = np.maximum(level, self.tails.sample(times, self._shape))
        return level

    def _shape(self, index: Index, times: Array) -> Array:
        """Levels of some rows, whether they are under way or not."""
        ramps = times - self.begin[index], self.attack[index], self.hold[index], self.release[index]
        shape = shapes.trapezoid(*ramps)
        if self.flow.any():
            shape = np.where(self.flow[index], shapes.flow_envelope(*ramps, FLOW_EXPONENT), shape)
        level = np.maximum(self.db[index] + shapes.level_db(shape, 2 * FLOOR_DB), FLOOR_DB)
        if self.gains is None:
            return level
        mouth, nose = self.mouth[index], self.nose[index]
        moved = np.hypot(mouth * self.gains.at(times, "mouth"), nose * self.gains.at(times, "nose"))
        return _moved(level, in_decibels(moved / np.maximum(np.hypot(mouth, nose), 1e-9)))


def breath_level(score: Acts, body: str) -> BreathLevel:
    """The audible breaths of one body, as far as they are heard; levels count the gains of nose and mouth.

    Raises:
        ScoreError: A noise is longer than its breath.
    """
    ends = endings(score.events)
    rows: list[tuple[float, ...]] = []
    faded: list[tuple[Ending, float, float]] = []
    for event in score.events:
        if isinstance(event, Inspiration | Expiration | Hold) and event.body == body and event.noise is not None:
            noise, ending = event.noise, ends.get(event.id)
            says = loudest_db(noise) + _gain_db(event), float(noise.envelope == "flow"), *_ways(event, noise)
            heard = [
                (event.onset + each.onset, event.onset + each.end, *each[1:], *says) for each in soundings_of(event)
            ]
            if ending is not None:
                heard = [row for row in heard if row[0] < ending.time]
                if heard and heard[-1][1] > ending.time:
                    faded.append((ending, *heard[-1][:2]))
                heard = [(row[0], min(row[1], ending.time), *row[2:]) for row in heard]
            rows += heard
    table = np.array(sorted(rows), dtype=np.float64).reshape(-1, 9)
    begin, end, attack, hold, release, level, flow, mouth, nose = table.T.copy()
    tails = [
        (cut.time, min(stop, cut.time + cut.fade), cut.fade, int(np.searchsorted(begin, start)))
        for cut, start, stop in faded
    ]
    return BreathLevel(
        begin=begin, end=end, attack=attack, hold=hold, release=release, db=level, flow=flow > 0,
        mouth=mouth, nose=nose, tails=_tails(tails), gains=gains(score, body, ends),
    )  # fmt: skip


def _ways(event: VolumeEvent, noise: Noise) -> tuple[float, float]:
    """Amplitudes of the mouth's and the nose's share; the throat's and a recording's are as the mouth's."""
    if isinstance(event, Hold) or noise.source == (noise.source_nose or noise.source) != SYNTH:
        return 1.0, 0.0
    return event.sound_mouth, event.sound_nose * amplitude(-NOSE_BELOW_MOUTH_DB)


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
