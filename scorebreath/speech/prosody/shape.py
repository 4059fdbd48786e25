"""What was said on one breath, shaped: pitch, range, endings, effort. Length and onsets stay to the sample."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from scorebreath.equations.prosody import declination, pressed_semitones
from scorebreath.score.events import Level, Pitch
from scorebreath.signal.level import active_db, level_db
from scorebreath.signal.pitch import CEILING, LOWEST, limits_of, pitch_hertz
from scorebreath.signal.psola import change_pitch
from scorebreath.signal.shelf import shelf
from scorebreath.speech.model import Speech
from scorebreath.speech.prosody.melody import (
    FARTHEST,
    SHORT,
    Contour,
    Fall,
    Floats,
    ending,
    mean_over,
    slope,
)
from scorebreath.units import amplitude, decibels

TILT = 0.5
"""dB above 1 kHz for each dB of loudness, on top of it (e; direction: Nordenberg & Sundberg 2004)"""
STEEPEST = 9.0
"""dB of tilt at most"""
HIGHEST = 6.0
"""st by which pressure moves the pitch at most"""
NEARLY = 0.05
"""st/s; a slope this near to the one asked for is met, and so is one within a tenth of it"""
ROUNDS = 3
"""Times that a slope is corrected by what was measured."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Manner:
    """How something is to sound, apart from what it says. The defaults ask for nothing."""

    slope: float = 0.0
    """st/s, as it is heard; 0: the voice's own"""
    by_length: float = 0.0
    """share of the declination that its length is found with ('t Hart), on top"""
    reset: float = 0.5
    """share of the fall taken back at a phrase edge"""
    lift: float = 0.0
    """share of its own fall by which all of it is higher"""
    ending: float = 0.0
    """st, at its end"""
    range: float = 1.0
    """x what the pitch does around its line"""
    louder: float = 0.0
    """dB by which its colour and pitch are those of a louder voice; the loudness itself stays"""
    per_pressure: float = 4.0
    """Hz/cmH2O"""
    sex: str = "male"

    @property
    def asks(self) -> bool:
        """Whether it asks for anything."""
        return bool(self.slope or self.by_length or self.ending or self.range != 1.0 or self.louder)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Shaped:
    """What was made of what was said."""

    speech: Speech
    gain_db: float = 0.0
    """dB by which it has to be louder to be as loud as before: its peaks would have been clipped"""


def shape(said: Sequence[Speech], manners: Sequence[Manner]) -> list[Shaped]:
    """Shape what was said on one breath.

    The mean pitch of the whole breath stays, but for what effort, endings and the lift of a paragraph add.

    Args:
        said: Its parts, in order.
        manners: Of each.

    Returns:
        One for each part, with pitch and level measured again; the very object where nothing is asked for.

    Raises:
        MissingExtraError: parselmouth is not installed.
    """
    if not any(manner.asks for manner in manners):
        return [Shaped(speech=speech) for speech in said]
    lines = _lines(said, manners)
    return [
        _shaped(speech, manner, line) if manner.asks else Shaped(speech=speech)
        for speech, manner, line in zip(said, manners, lines, strict=True)
    ]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Line:
    """What is to become of the line through a pitch."""

    contour: Contour
    fall: Fall
    asked: float
    """st/s; 0: the own slope stays"""
    own: float = 0.0
    """st/s of the voice's own that is taken away"""
    scale: float = 0.0
    """times the fall"""
    offset: float = 0.0
    """st"""

    def at(self, times: Floats) -> Floats:
        """How far it moves the pitch, (n,) st."""
        if not self.asked or not self.contour.known:
            return np.full(len(times), self.offset)
        middle = self.contour.times.mean()
        return np.asarray(self.offset + self.scale * self.fall.at(times) - self.own * (times - middle))


def _lines(said: Sequence[Speech], manners: Sequence[Manner]) -> list[_Line]:
    """One for each part: together they keep the mean."""
    lines: list[_Line] = []
    level = 0.0
    for speech, manner in zip(said, manners, strict=True):
        contour = Contour.of(speech)
        fall = Fall.of(speech, manner.reset, eased=bool(manner.by_length))
        asked = manner.slope + (manner.by_length * declination(speech.duration) if manner.by_length else 0.0)
        line = _Line(contour=contour, fall=fall, asked=asked, offset=level)
        if asked and contour.known:
            own = min(1.0, (speech.duration / SHORT) ** 2) * contour.slope
            line = replace(line, own=own, scale=asked / fall.slope(contour.times))
            level = (level + line.scale * fall.end) * (1.0 - manner.reset)
        lines.append(line)
    moved = mean_over([line.at(line.contour.times) for line in lines])
    fallen = max((abs(line.scale * line.fall.end) for line in lines), default=0.0)
    return [
        replace(line, offset=line.offset + manner.lift * fallen - moved)
        for line, manner in zip(lines, manners, strict=True)
    ]


def _shaped(speech: Speech, manner: Manner, line: _Line) -> Shaped:
    samples, hertz = speech.samples, np.asarray(speech.pitch.hertz, dtype=np.float64)
    if line.contour.known:
        samples, hertz = _sung(speech, manner, line)
    if manner.louder:
        samples = shelf(samples, speech.sample_rate, max(-STEEPEST, min(STEEPEST, TILT * manner.louder)))
    if samples is speech.samples:
        return Shaped(speech=speech)
    samples, gain_db = _as_loud(samples, speech)
    level = tuple(level_db(samples, speech.sample_rate, speech.level.step).tolist())
    made = replace(
        speech, samples=samples, pitch=Pitch(step=speech.pitch.step, hertz=tuple(hertz.tolist())),
        level=Level(step=speech.level.step, db=level),
    )  # fmt: skip
    return Shaped(speech=made, gain_db=gain_db)


def _sung(speech: Speech, manner: Manner, line: _Line) -> tuple[NDArray[np.float32], Floats]:
    """Samples of another melody, and their pitch; the slope that is measured comes near to the one asked for."""
    contour = line.contour
    pressed = _pressed(manner, contour)
    wanted = line.asked + _slope_of_ending(manner, contour)
    for _ in range(ROUNDS):
        samples, hertz = _moved(speech, _move(manner, line, pressed))
        if not line.asked or speech.duration < SHORT:
            break
        found = Contour.of(replace(speech, pitch=replace(speech.pitch, hertz=tuple(hertz.tolist()))))
        missed = wanted - found.slope if found.known else 0.0
        if abs(missed) <= max(NEARLY, abs(line.asked) / 10):
            break
        other = replace(line, scale=line.scale + missed / line.fall.slope(contour.times))
        higher = float((line.at(contour.times) - other.at(contour.times)).mean())
        line = replace(other, offset=line.offset + higher)
    return samples, hertz


def _pressed(manner: Manner, contour: Contour) -> float:
    """How much higher pressure makes it, st."""
    if not manner.louder:
        return 0.0
    usual = float(np.exp2(np.median(contour.semitones) / 12.0))
    found = pressed_semitones(manner.louder, manner.sex, usual, manner.per_pressure)
    return max(-HIGHEST, min(HIGHEST, found))


Move = Callable[[Floats, Floats], Floats]


def _move(manner: Manner, line: _Line, pressed: float) -> Move:
    """How far each pitch is moved."""
    contour, end = line.contour, float(line.contour.times[-1])
    mean, own, middle = contour.mean, contour.slope, float(contour.times.mean())
    low, high = float(contour.semitones.min()), float(contour.semitones.max())

    def move(times: Floats, hertz: Floats) -> Floats:
        out: Floats = line.at(times) + pressed
        if manner.range != 1.0:
            around = np.clip(12.0 * np.log2(hertz), low, high) - mean - own * (times - middle)
            out = out + (manner.range - 1.0) * around
        if manner.ending:
            out = out + ending(times, end, manner.ending)
        return np.asarray(np.clip(out, -FARTHEST, FARTHEST), dtype=np.float64)

    return move


def _slope_of_ending(manner: Manner, contour: Contour) -> float:
    """What the ending adds to the line through everything, st/s."""
    if not manner.ending:
        return 0.0
    return slope(contour.times, ending(contour.times, float(contour.times[-1]), manner.ending))


def _moved(speech: Speech, move: Move) -> tuple[NDArray[np.float32], Floats]:
    """Samples of another pitch, and what is measured then."""
    hertz = np.asarray(speech.pitch.hertz, dtype=np.float64)
    voiced = np.flatnonzero(hertz > 0)
    times: Floats = np.asarray((voiced + 0.5) * speech.pitch.step, dtype=np.float64)
    far = move(times, hertz[voiced])
    if not len(far) or not np.any(far):
        return speech.samples, hertz
    floor, ceiling = limits_of(hertz)
    samples = change_pitch(speech.samples, speech.sample_rate, move, floor=floor, ceiling=ceiling)
    moved = hertz.copy()
    moved[voiced] = hertz[voiced] * np.exp2(far / 12.0)
    low, high = limits_of(moved)
    found = pitch_hertz(samples, speech.sample_rate, speech.pitch.step, max(LOWEST, low), min(CEILING, high))
    return samples, found


def _as_loud(samples: NDArray[np.float32], speech: Speech) -> tuple[NDArray[np.float32], float]:
    """As loud as it was said; and by how much that could not be had without clipping, dB."""
    wanted = active_db(speech.samples, speech.sample_rate) - active_db(samples, speech.sample_rate)
    loudest = float(np.abs(samples).max(initial=0.0))
    possible = min(wanted, -decibels(loudest)) if loudest > 0.0 else 0.0
    made = np.clip(samples * np.float32(amplitude(possible)), -1.0, 1.0)
    return made.astype(np.float32), wanted - possible
