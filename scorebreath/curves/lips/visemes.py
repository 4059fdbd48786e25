r"""Visemes: how much of each of the 15 is shown, for rigs that have a shape for every one (physiology 7.2).

Each phone shows one. Its share at a time is how much of a window around that time lies within the phone: the window is
:math:`W` wide, a parabola, and its integral is `gates.ease`. What phones leave is silence, so shares add up to 1, come
and go without a step, and none changes faster than :math:`1.5 / W`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

import numpy as np

from scorebreath.curves.lips.gates import ease
from scorebreath.curves.lips.strings import PhoneString
from scorebreath.curves.lips.targets import targets
from scorebreath.curves.tracks import Array, Index

SILENCE = "sil"
VISEMES = (SILENCE, "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou")
"""In Khronos' order."""
WINDOW = 0.1
"""s; a phone of 60 ms shows four fifths of its viseme, a frame of 1/30 s changes it by half at most (e)"""
NEUTRAL = "E"
"""What a sound made below the mouth shows that stands alone."""


@cache
def shown() -> Mapping[str, str]:
    """Letter -> viseme; letters of sounds that are made below the mouth are left out."""
    table = tomllib.loads(files("scorebreath.curves.lips").joinpath("visemes.toml").read_text(encoding="utf-8"))
    return MappingProxyType({letter: name for name, letters in table.items() for letter in letters.split()})


@dataclass(frozen=True, slots=True, kw_only=True)
class Visemes:
    """A body's phones and what they show, ready to be sampled."""

    start: Array
    """(segments,) s"""
    end: Array
    """(segments,) s"""
    place: Index
    """(segments,) in VISEMES"""

    def sample(self, times: Array) -> Array:
        """Shares at any times, (n, 15) in 0..1; each row adds up to 1 and depends on its own time alone."""
        shares = np.zeros((len(times), len(VISEMES)))
        at = np.searchsorted(self.end, times - WINDOW / 2, side="right")
        last = np.searchsorted(self.start, times + WINDOW / 2, side="left")
        rows = np.flatnonzero(at < last)
        while rows.size:
            segment = at[rows]
            part = _passed(times[rows], self.start[segment]) - _passed(times[rows], self.end[segment])
            shares[rows, self.place[segment]] += part
            at[rows] += 1
            rows = rows[at[rows] < last[rows]]
        silent = np.ones(len(times))
        for column in range(1, len(VISEMES)):  # in order: numpy's sum differs in the last bit with the number of rows
            silent -= shares[:, column]
        shares[:, 0] = np.clip(silent, 0.0, 1.0)
        return shares


def visemes(string: PhoneString) -> Visemes:
    """What the phones of a string show."""
    known = {targets().row(letter): VISEMES.index(name) for letter, name in shown().items()}
    places = [known.get(row, -1) for row in string.row.tolist()]
    for number in range(len(places) - 2, -1, -1):
        if places[number] < 0 and string.touches[number + 1]:
            places[number] = places[number + 1]
    for number, place in enumerate(places):
        if place < 0:
            follows = number > 0 and bool(string.touches[number])
            places[number] = places[number - 1] if follows else VISEMES.index(NEUTRAL)
    return Visemes(start=string.start, end=string.end, place=np.array(places, dtype=np.intp))


def _passed(times: Array, edges: Array) -> Array:
    """How much of the window around a time lies behind an edge."""
    return ease((times - edges) / WINDOW + 0.5)
