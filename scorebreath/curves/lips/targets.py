"""What each letter of the IPA asks of the lips' channels, as arrays."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

import numpy as np

from scorebreath.curves.tracks import Array
from scorebreath.equations.phones import letters_of, makings

LIP_CHANNELS = ("jaw_open", "lip_close", "lip_round", "lip_spread", "lip_tuck", "tongue_tip", "tongue_back")
"""In the columns of every array of the lips."""
JAW = LIP_CHANNELS.index("jaw_open")
CLOSE = LIP_CHANNELS.index("lip_close")
TUCK = LIP_CHANNELS.index("lip_tuck")
UNKNOWN = "ə"
"""Whose targets a letter has that is in no table; its class is the weak one of sounds made below the mouth."""
VOWEL_SHARE, OTHER_SHARE = 3, 2
"""Of a phone's time, where it has several letters: its first vowel takes half as long again as what else there is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Targets:
    """The table of `phones.toml`; the last row is for unknown letters."""

    rows: Mapping[str, int]
    """letter -> row"""
    classes: tuple[str, ...]
    """(n,) of each row"""
    target: Array
    """(n, 7) 0..1, what is asked"""
    alpha: Array
    """(n, 7) above 0, how firmly, at the phone's centre"""
    before: Array
    """(n, 2) 1/s; of the jaw, of the others"""
    after: Array
    """(n, 2) 1/s"""

    def row(self, letter: str) -> int:
        """Where a letter stands."""
        return self.rows.get(letter, len(self.classes) - 1)


@cache
def targets() -> Targets:
    """The table, read once."""
    text = files("scorebreath.curves.lips").joinpath("phones.toml").read_text(encoding="utf-8")
    table = tomllib.loads(text)
    letters: dict[str, list[str | float]] = table["letter"]
    lines = [*letters.values(), ["throat", *letters[UNKNOWN][1:]]]
    classes = tuple(str(line[0]) for line in lines)
    rules = [table["class"][name] for name in classes]
    theta = np.array([[rule["theta_jaw"], rule["theta"]] for rule in rules], dtype=np.float64)
    return Targets(
        rows=MappingProxyType({letter: row for row, letter in enumerate(letters)}),
        classes=classes,
        target=np.array([line[1:] for line in lines], dtype=np.float64),
        alpha=np.array([rule["alpha"] for rule in rules], dtype=np.float64),
        before=np.ascontiguousarray(theta[:, :, 0]),
        after=np.ascontiguousarray(theta[:, :, 1]),
    )


@cache
def parts_of(ipa: str) -> tuple[tuple[int, float], ...]:
    """The letters of a phone as rows of `targets`, and where in the phone each ends, as a share of its time.

    Diphthongs and affricates have two targets in time; a phone without any known letter has one, the unknown's.

    >>> [round(end, 3) for _, end in parts_of("aɪ")], [end for _, end in parts_of("tʃ")], len(parts_of("§"))
    ([0.6, 1.0], [0.5, 1.0], 1)
    """
    letters = letters_of(ipa)
    if not letters:
        return ((targets().row(""), 1.0),)
    vowels = [makings().get(letter) == "vowel" for letter in letters]
    first = vowels.index(True) if any(vowels) else -1
    shares = [VOWEL_SHARE if place == first else OTHER_SHARE for place in range(len(letters))]
    ends = np.cumsum(shares) / sum(shares)
    return tuple(zip(map(targets().row, letters), map(float, ends), strict=True))
