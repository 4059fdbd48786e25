"""The melody of a breath group: how its pitch is to fall, and by how much it must be moved for that (physiology 5)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scorebreath.equations.prosody import OCTAVE
from scorebreath.speech.model import Speech

EDGE = 0.1
"""s of silence inside what is said in one go that count as a phrase edge"""
ENDING = 0.25
"""s up to the last pitch, over which a statement falls and a question rises (physiology 5)"""
FARTHEST = 12.0
"""st; no pitch is moved further"""
STRAY = 10.0
"""st from the median; what lies further away is an error of the tracker"""
SHORT = 1.0
"""s; in what is shorter, accents are most of a slope, so less of the voice's own is taken away"""
LEAST = 8
"""values from which a slope is told"""
FLATTEST = 0.25
"""Slope at least that resets leave of a fall of 1."""
EASE = 1.5
"""Exponent of a fall that is steep first ('t Hart & Cohen: from 3 % in 100 ms to 0.5 %)."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Contour:
    """The pitch of what was said in one go."""

    times: Floats
    """(n,) s, where there is a pitch"""
    semitones: Floats
    """(n,) re 1 Hz"""

    @classmethod
    def of(cls, speech: Speech) -> Contour:
        """As it was measured, what is certainly wrong left out."""
        hertz = np.asarray(speech.pitch.hertz, dtype=np.float64)
        voiced = np.flatnonzero(hertz > 0)
        times = (voiced + 0.5) * speech.pitch.step
        semitones = OCTAVE * np.log2(hertz[voiced])
        near = np.abs(semitones - (np.median(semitones) if len(voiced) else 0.0)) <= STRAY
        return cls(times=np.asarray(times[near]), semitones=np.asarray(semitones[near]))

    @property
    def known(self) -> bool:
        """Whether there is enough of it."""
        return len(self.times) >= LEAST and float(np.ptp(self.times)) > 0.0

    @property
    def mean(self) -> float:
        """In semitones re 1 Hz."""
        return float(self.semitones.mean())

    @property
    def slope(self) -> float:
        """Of the straight line that fits best, st/s."""
        return slope(self.times, self.semitones)


def slope(times: Floats, values: Floats) -> float:
    """Of the straight line through some points that fits best, a second."""
    centred = times - times.mean()
    return float(centred @ values / (centred @ centred))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fall:
    """A fall of about 1 a second, part of it taken back at each phrase edge inside."""

    corners: Floats
    """(m,) s"""
    values: Floats
    """(m,); equal corners are steps"""

    @classmethod
    def of(cls, speech: Speech, reset: float, *, eased: bool) -> Fall:
        """Over what was said in one go.

        Args:
            speech: It.
            reset: Share that is taken back at an edge.
            eased: Whether it is steep first.
        """
        begins = [0.0]
        for phone in speech.phones[1:-1]:
            if not phone.ipa and phone.duration >= EDGE:
                begins.append(phone.onset + phone.duration)
        corners: list[Floats] = []
        values: list[Floats] = []
        level = 0.0
        for start, end in zip(begins, [*begins[1:], speech.duration], strict=True):
            length = max(end - start, 1e-6)
            inside = np.linspace(0.0, 1.0, 33 if eased else 2)
            fallen = length * (1.0 - (1.0 - inside) ** EASE) if eased else length * inside
            corners.append(np.append(start + length * inside[:-1], max(end, start)))  # the next one begins just there
            values.append(level - fallen)
            level = float(values[-1][-1]) * (1.0 - reset)
        return cls(corners=np.concatenate(corners), values=np.concatenate(values))

    def at(self, times: Floats) -> Floats:
        """Its value at some times, (n,)."""
        return np.asarray(np.interp(times, self.corners, self.values), dtype=np.float64)

    @property
    def end(self) -> float:
        """Where it has fallen to."""
        return float(self.values[-1])

    def slope(self, times: Floats) -> float:
        """As a line through its values at these times has it."""
        return min(-FLATTEST, slope(times, self.at(times)))


def ending(times: Floats, end: float, semitones: float) -> Floats:
    """What the last sounds are moved by, (n,) st.

    Args:
        times: (n,) s
        end: s, where the last pitch is.
        semitones: At the end.
    """
    length = min(ENDING, end / 3)
    place = np.clip((times - (end - length)) / max(length, 1e-6), 0.0, 1.0)
    return np.asarray(semitones * 0.5 * (1.0 - np.cos(np.pi * place)), dtype=np.float64)


def mean_over(moves: Sequence[Floats]) -> float:
    """Mean of all values of all of them."""
    together = np.concatenate(moves) if moves else np.zeros(0)
    return float(together.mean()) if len(together) else 0.0
