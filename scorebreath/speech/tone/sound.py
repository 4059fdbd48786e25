"""The tone voice's sound, in whole numbers only: no rounding of floats, so no machine differs from another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scorebreath.score.events import Closing
from scorebreath.speech.tone.letters import Sound

SAMPLE_RATE = 16000
"""Hz"""
STEP = 80
"""frames in 5 ms: all phones are whole steps, so their times are on the grid exactly"""
FULL_SCALE = 32768
CONTOUR: dict[Closing, tuple[int, int]] = {
    "final": (13000, 9000),
    "continuing": (13000, 12000),
    "question": (12000, 15000),
}
"""Hundredths of a Hz at the first and the last step; a straight line between them."""
LOUDNESS = {"vowel": 9000, "voiced": 5000, "noise": 2500, "stop": 6000}
"""of 32768, the peak of each kind of phone"""
_WHEEL = 32
"""bits of a full turn of the phase"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed:
    """A sound with its time."""

    sound: Sound
    start: int
    """step"""
    steps: int

    @property
    def voiced(self) -> bool:
        """Whether it has a pitch."""
        return self.sound.kind in ("vowel", "voiced")


def contour(steps: int, closing: Closing, thousandths: int) -> NDArray[np.int64]:
    """Pitch of each step, voiced or not.

    Args:
        steps: How many, > 0.
        closing: How it ends.
        thousandths: Of the voice's own pitch.

    Returns:
        (steps,) hundredths of a Hz.
    """
    first, last = CONTOUR[closing]
    line = first + (last - first) * np.arange(steps, dtype=np.int64) // max(1, steps - 1)
    return np.asarray(line * thousandths // 1000, dtype=np.int64)


def render(placed: Sequence[Placed], pitch: NDArray[np.int64]) -> NDArray[np.int64]:
    """The sound of phones and pauses.

    Args:
        placed: Contiguous, from step 0 on.
        pitch: (steps,) hundredths of a Hz.

    Returns:
        (steps * STEP,) samples within `FULL_SCALE`.
    """
    turns = np.repeat((pitch << _WHEEL) // (100 * SAMPLE_RATE), STEP)
    phase = np.cumsum(turns)
    tone = _wave(phase)
    out: NDArray[np.int64] = np.zeros(len(pitch) * STEP, dtype=np.int64)
    for one in placed:
        kind = one.sound.kind
        if kind == "pause":
            continue
        closed = one.steps * one.sound.closure // one.sound.steps
        start, end = (one.start + closed) * STEP, (one.start + one.steps) * STEP
        source = tone[start:end] if one.voiced else _noise(start, end)
        if kind == "vowel":
            source = (2 * source + _wave(phase[start:end] * one.sound.colour)) // 3
        out[start:end] = source * LOUDNESS[kind] // FULL_SCALE * _fades(end - start) // STEP
    return out


def _wave(phase: NDArray[np.int64]) -> NDArray[np.int64]:
    """Two parabolas a turn, near a sine, within +-32768."""
    turn = (phase & ((1 << _WHEEL) - 1)) >> (_WHEEL - 16)
    half = turn & 32767
    arch = half * (32768 - half) >> 13
    return np.asarray(np.where(turn < 32768, arch, -arch), dtype=np.int64)


def _noise(start: int, end: int) -> NDArray[np.int64]:
    """White noise within +-32768: a frame's number, scrambled by multiplying and shifting."""
    mask = np.uint64(0xFFFFFFFF)
    mixed = np.arange(start + 1, end + 1, dtype=np.uint64) * np.uint64(2654435769) & mask
    for factor in (2246822519, 3266489917):
        mixed = (mixed ^ (mixed >> np.uint64(15))) * np.uint64(factor) & mask
    return np.asarray((mixed >> np.uint64(16)).astype(np.int64) - FULL_SCALE, dtype=np.int64)


def _fades(frames: int) -> NDArray[np.int64]:
    """Up and down over one step, never to 0: the sound begins with its first frame and ends with its last."""
    place = np.arange(frames, dtype=np.int64)
    return np.asarray(np.minimum(np.minimum(place, place[::-1]) + 1, STEP), dtype=np.int64)
