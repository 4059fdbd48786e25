"""What can be heard of the breaths: how loud they are beside the speech, and their spectra (physiology 3.2, 3.5)."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import InputError
from scorebreath.report.norms.sound import ArraySound, FileSound, Sound
from scorebreath.report.norms.spectrum import Spectrum, spectrum
from scorebreath.score.document import Score
from scorebreath.score.events import Inspiration, Noise, Utterance
from scorebreath.signal.level import GATE_DB, level_db
from scorebreath.units import FLOOR_DB, snap

Samples = NDArray[np.floating[Any]]
Array = NDArray[np.float64]
MOST = 400
"""Utterances, or breaths made alone, that are listened to; of more, so many are taken, evenly spread."""
SPACE = 0.1
"""s between two breaths that stand alone."""
EXPONENT = 1.66
"""Amplitude goes with flow to this power, where a noise's envelope is `flow` (physiology 3.1)."""
HALF = float(2.0 / np.pi * np.arcsin(0.5 ** (1.0 / EXPONENT)))
"""Share of a `flow` ramp after which it is half as loud as it gets."""
LONGEST = 60.0
"""s of one breath, or of one utterance, that are listened to."""
SHORTEST = 0.02
"""s of a breath that are listened to; shorter ones tell nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Heard:
    """What was measured of the speech inspirations, in order of time."""

    level: Array
    """(n,) dB relative to the speech's active level"""
    spectra: Spectrum
    """of those that are not digital silence; of none where the sample rate is too low for 12 kHz"""
    sample_rate: float
    """Hz"""
    seconds: float
    """length of the sound"""
    alone: bool
    """whether the breaths were made for the measurement, without their speech"""


def listen(
    score: Score,
    sound: Path | Samples,
    rate: float | None = None,
    body: str | None = None,
    speech_db: float | None = None,
) -> Heard:
    """Measure the breaths of a sound: each over its hold, or while it is at least half as loud as its loudest.

    Speech inspirations with a noise of their own are measured, not those drawn in several gasps. What lies beyond the
    end of the sound is left out.

    Args:
        score: The Score of the sound; its times tell where to listen.
        sound: A sound file, or samples (n,) or (n, channels); time 0 is the Score's.
        rate: Of samples, Hz; a file knows its own.
        body: Whose breaths; the first body's when left out.
        speech_db: Active level of the speech, dB re full scale; None: measured in the sound.

    Raises:
        InputError: Samples came without their rate, or the file is no sound.
    """
    whose = score.bodies[0].id if body is None else body
    with _opened(sound, rate) as opened:
        reference = _speech_in(opened, score, whose) if speech_db is None else speech_db
        breaths = [
            samples
            for event in score.of(Inspiration, whose)
            if event.kind == "speech" and (window := core(event)) is not None
            if len(samples := opened.read(*window)) >= SHORTEST * opened.rate
        ]
        power = np.array([float(np.mean(np.square(samples))) for samples in breaths])
        db = 10.0 * np.log10(np.maximum(power, 10.0 ** (2 * FLOOR_DB / 10)))
        return Heard(
            level=np.zeros(0) if reference is None else db - reference,
            spectra=spectrum([s for s, p in zip(breaths, power, strict=True) if p > 0], opened.rate),
            sample_rate=opened.rate,
            seconds=opened.seconds,
            alone=speech_db is not None,
        )


def core(event: Inspiration) -> tuple[float, float] | None:
    """Beginning and end of the part of a breath that is listened to, s; None for one that cannot be."""
    noise = event.noise
    if noise is None or event.saccades > 1 or (event.sound_mouth <= 0 and event.sound_nose <= 0):
        return None
    begin = event.onset + noise.onset
    ramp = HALF if noise.envelope == "flow" else 1.0
    start = begin + ramp * noise.attack
    return start, min(begin + noise.duration - ramp * noise.release, start + LONGEST)


def speech_level(score: Score, body: str | None = None) -> float | None:
    """Active level of a body's speech as the Score tells it, dB re full scale; None where it tells nothing.

    The utterances' steps within 40 dB of the loudest count (physiology 9.2).
    """
    whose = score.bodies[0].id if body is None else body
    return _active([np.asarray(u.level.db, dtype=np.float64) + u.gain_db for u in score.of(Utterance, whose)])


def breaths_alone(score: Score, body: str | None = None, most: int = MOST) -> Score:
    """A Score of some speech inspirations of a body, one soon after the other, to be rendered and listened to.

    Args:
        score: Any Score.
        body: Whose breaths; the first body's when left out.
        most: How many at most, evenly spread over the Score.
    """
    whose = score.bodies[0].id if body is None else body
    found = [event for event in score.of(Inspiration, whose) if event.kind == "speech" and core(event) is not None]
    now, placed = SPACE, []
    for event in _spread(found, most):
        placed.append(dataclasses.replace(event, onset=snap(now), group=None))
        now = snap(now + event.duration + SPACE)
    named = {event.noise.source for event in placed if isinstance(event.noise, Noise)}
    media = {name: info for name, info in score.media.items() if name in named}
    return dataclasses.replace(score, duration=now, groups=(), events=tuple(placed), media=media)


@contextmanager
def _opened(sound: Path | Samples, rate: float | None) -> Iterator[Sound]:
    if isinstance(sound, Path):
        with FileSound(sound) as opened:
            yield opened
        return
    if rate is None or not 0 < rate < np.inf:
        raise InputError(f"rate={rate}: samples need their rate in Hz")
    yield ArraySound(np.asarray(sound), rate)


def _speech_in(sound: Sound, score: Score, body: str) -> float | None:
    """Active level of the speech in a sound, dB re full scale; where there is none, as the Score tells it."""
    said = _spread(list(score.of(Utterance, body)), MOST)
    steps = [level_db(sound.read(each.onset, min(each.end, each.onset + LONGEST)), sound.rate) for each in said]
    level = _active([step[step > FLOOR_DB] for step in steps])
    return speech_level(score, body) if level is None else level


def _active(steps: Sequence[Array]) -> float | None:
    db = np.concatenate(steps) if steps else np.zeros(0)
    if not db.size:
        return None
    active = db[db >= db.max() + GATE_DB]
    return float(10.0 * np.log10(np.mean(10.0 ** (active / 10.0))))


def _spread(items: Sequence[Any], most: int) -> list[Any]:
    """At most so many of some things, evenly spread."""
    if len(items) <= most:
        return list(items)
    return [items[round(number * (len(items) - 1) / (most - 1))] for number in range(most)] if most > 1 else [items[0]]
