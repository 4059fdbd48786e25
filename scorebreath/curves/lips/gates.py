"""What must touch, touches: lips in p, b and m, the lower lip and the teeth in f and v (A15; physiology 10)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from scorebreath.curves.lips.strings import PhoneString
from scorebreath.curves.lips.targets import targets
from scorebreath.curves.tracks import Array

LEAST = 0.05
"""s that a contact lasts at least: every rate from 24 frames a second has a frame in it"""
RAMP = 0.062
"""s in which a contact is made, and given up: at 24 a second at the fastest, below the channels' speed of 25"""


class Contact(NamedTuple):
    """When a class of phones touches."""

    channel: str
    share: float
    """of the phone, from its onset, that contact lasts; then a stop bursts"""
    before: float
    """share of what a short phone is widened by that goes before its onset"""


CONTACTS: Mapping[str, Contact] = MappingProxyType({
    "m": Contact("lip_close", 1.0, 0.5),
    "p": Contact("lip_close", 0.8, 1.0),
    "b": Contact("lip_close", 0.9, 1.0),
    "ɓ": Contact("lip_close", 0.9, 1.0),
    "ʙ": Contact("lip_close", 1.0, 0.5),
    "f": Contact("lip_tuck", 1.0, 0.5),
    "v": Contact("lip_tuck", 1.0, 0.5),
    "ɱ": Contact("lip_tuck", 1.0, 0.5),
})  # fmt: skip
"""Letter -> contact; bilabials and labiodentals of `equations/phones.toml`, all of them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Gate:
    """The contacts of one channel, in order of time; none touch."""

    begin: Array
    """(n,) s; where contact is made"""
    end: Array
    """(n,) s; where it is given up"""

    def sample(self, times: Array) -> Array:
        """1 during contact, ramps of RAMP on both sides, 0 elsewhere; (n,)."""
        value = np.zeros(times.shape)
        if not len(self.begin):
            return value
        last = np.searchsorted(self.begin, times, side="right") - 1
        for place in (last, last + 1):
            index = np.clip(place, 0, len(self.begin) - 1)
            away = np.maximum(np.maximum(self.begin[index] - times, times - self.end[index]), 0.0)
            value = np.maximum(value, ease(1.0 - away / RAMP))
        return value


def gate(string: PhoneString, channel: str) -> Gate:
    """Gather a channel's contacts; those of phones next to each other are one."""
    letters = [letter for letter, contact in CONTACTS.items() if contact.channel == channel]
    rows = [targets().row(letter) for letter in letters]
    spans: list[tuple[float, float]] = []
    last = -2
    for place in np.flatnonzero(np.isin(string.row, rows)).tolist():
        contact = CONTACTS[letters[rows.index(int(string.row[place]))]]
        begin, end = _contact(float(string.start[place]), float(string.end[place]), contact)
        if place == last + 1 and string.touches[place]:
            begin = min(begin, spans[-1][1])
        spans.append((begin, end))
        last = place
    return _merged(spans)


def _contact(start: float, end: float, contact: Contact) -> tuple[float, float]:
    missing = LEAST - (end - start)
    if missing <= 0.0:
        return start, start + max(LEAST, contact.share * (end - start))
    return start - contact.before * missing, end + (1.0 - contact.before) * missing


def _merged(spans: list[tuple[float, float]]) -> Gate:
    begins: list[float] = []
    ends: list[float] = []
    for begin, end in sorted(spans):
        if ends and begin <= ends[-1]:
            ends[-1] = max(ends[-1], end)
        else:
            begins.append(begin)
            ends.append(end)
    return Gate(begin=np.array(begins, dtype=np.float64), end=np.array(ends, dtype=np.float64))


def ease(progress: Array) -> Array:
    """From 0 to 1, with no speed at both ends and at most half as much again as the mean between: `3x^2 - 2x^3`.

    Where speed is scarce it is better than the smoother step, which takes 15/8 of the mean.
    """
    x = np.clip(progress, 0.0, 1.0)
    return np.asarray(x * x * (3.0 - 2.0 * x))
