"""All phones that a body speaks, as one string of arrays, pauses being the gaps in it.

Coarticulation reaches over three phones (A14). So that a phone comes and goes without a step, and within its
utterance's reach, the three are counted on a clock: a phone counts its length, but at most ORDINARY, yet at least half
its length; silence counts as long as it is. A phone's dominance is whole up to two ordinary phones from its edges and
gone at three, which is 0.24 s of silence, and at most 0.48 s of speech.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from scorebreath.curves.lips.targets import parts_of
from scorebreath.curves.tracks import TOUCH, Array, Index, Mask, Track
from scorebreath.errors import ScoreError
from scorebreath.score.events import Utterance
from scorebreath.units import GRID

ORDINARY = 80_000.0
"""microseconds: a phone's length in ordinary speech (12 to 13 a second; ours)"""
WHOLE, GONE = 2 * ORDINARY, 3 * ORDINARY
"""microseconds on the clock, from a phone's edge: where its dominance begins to fade, and where it has"""


@dataclass(frozen=True, slots=True, kw_only=True)
class PhoneString:
    """Segments in order of time, none overlapping: a phone, or the part of it that one letter takes."""

    row: Index
    """(n,) of `targets`"""
    start: Array
    """(n,) s"""
    end: Array
    """(n,) s"""
    centre: Array
    """(n,) s"""
    clock_start: Array
    """(n,) microseconds on the clock; whole ones, so that differences are exact"""
    clock_end: Array
    """(n,) likewise"""
    touches: Mask
    """(n,) whether the segment before touches it"""
    phone: Array
    """(phones, 2) s; onset and end of every phone, for key frames"""

    def __len__(self) -> int:
        """How many segments."""
        return len(self.row)


def phone_string(spoken: Track[Utterance]) -> PhoneString:
    """String together what is said.

    Raises:
        ScoreError: Phones overlap, or leave their utterance.
    """
    rows: list[int] = []
    edges: list[tuple[int, int, int, int]] = []  # onset and end of the segment, of its phone: microseconds
    phones: list[tuple[int, int]] = []
    for utterance in spoken.events:
        at = _micros(utterance.onset)
        before = at
        for onset, end, ipa in _phones(utterance):
            if at + onset < before - 2:
                raise ScoreError(f"event {utterance.id!r}: its phones overlap {onset / GRID:.6f} s after its onset")
            first = max(at + onset, before)
            before = at + end
            if before <= first:
                continue
            phones.append((first, before))
            begin = first
            for row, share in parts_of(ipa):
                stop = before if share == 1.0 else first + round(share * (before - first))
                if stop > begin:
                    rows.append(row)
                    edges.append((begin, stop, first, before))
                    begin = stop
    return _string(rows, edges, phones)


def _phones(utterance: Utterance) -> Sequence[tuple[int, int, str]]:
    found = [
        (_micros(phone.onset), _micros(phone.onset) + _micros(phone.duration), phone.ipa)
        for phone in utterance.phones
        if phone.ipa
    ]
    longest = _micros(utterance.duration) + round(2 * TOUCH * GRID)
    for onset, end, ipa in found:
        if end > longest:
            raise ScoreError(
                f"event {utterance.id!r}: phone {ipa!r} at {onset / GRID:g} s ends at {end / GRID:g} s; "
                f"expected within the utterance, {utterance.duration:g} s"
            )
    return found


def _string(rows: list[int], edges: list[tuple[int, int, int, int]], phones: list[tuple[int, int]]) -> PhoneString:
    table = np.array(edges, dtype=np.float64).reshape(-1, 4)
    start, end = table[:, 0], table[:, 1]
    length = table[:, 3] - table[:, 2]
    counts = np.maximum(np.minimum(length, ORDINARY), np.floor(length / 2.0))
    # a letter counts its part of the phone, in whole microseconds, the phone as a whole exactly its count
    at_start = np.floor((start - table[:, 2]) / length * counts)
    at_end = np.floor((end - table[:, 2]) / length * counts)
    gap = np.diff(start, prepend=start[:1])
    gap[1:] = start[1:] - end[:-1]
    clock_end = np.cumsum(gap + (at_end - at_start))
    return PhoneString(
        row=np.array(rows, dtype=np.intp),
        start=start / GRID,
        end=end / GRID,
        centre=(start + end) / (2 * GRID),
        clock_start=clock_end - (at_end - at_start),
        clock_end=clock_end,
        touches=(gap <= 0.0) & (np.arange(len(rows)) > 0),
        phone=np.array(phones, dtype=np.float64).reshape(-1, 2) / GRID,
    )


def _micros(seconds: float) -> int:
    return round(seconds * GRID)
