"""A long Score in pieces that are rendered one after another, cut where nothing sounds.

What an engine holds and what lies on the disk then does not grow with the Score, and the sound is the same bit for bit:
a sound depends on its own seed and settings alone, and pieces begin on the engine's blocks. Nothing is moving where
they begin either, and each begins with a move to what was in force.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from scorebreath.engine.clock import BLOCK
from scorebreath.engine.moves import AS_WRITTEN, Move, Ratios
from scorebreath.engine.onsets import Onset
from scorebreath.units import frame_count

LENGTH = 180.0
"""Seconds after which a piece ends at the next silence."""
_FREED_LATE = 0.02  # s after its end that a sound surely is gone from the engine


@dataclass(frozen=True, slots=True, kw_only=True)
class Segment:
    """A piece of a rendering."""

    start: int
    """first frame, a multiple of the engine's block"""
    frames: int
    sounds: tuple[Onset, ...]
    """in order of time; none sounds outside the piece"""
    moves: tuple[Move, ...] = ()
    """in order of time, after those that say what was in force at the beginning; none outside the piece"""

    @property
    def overlap(self) -> int:
        """The most sounds that the engine holds at once."""
        there: tuple[Onset | Move, ...] = (*self.sounds, *self.moves)
        starts = [(one.time, 1) for one in there]
        ends = [(one.end + _FREED_LATE, -1) for one in there]
        edges = sorted(starts + ends, key=lambda edge: (edge[0], -edge[1]))
        return max(itertools.accumulate((step for _, step in edges), initial=0))


def segments(
    sounds: Sequence[Onset], *, frames: int, sample_rate: int, moves: Sequence[Move] = (), length: float = LENGTH
) -> Iterator[Segment]:
    """Pieces that together are the whole, in order.

    Args:
        sounds: In order of time, all within the frames.
        frames: Of the whole.
        sample_rate: Hz.
        moves: In order of time.
        length: Seconds after which a piece ends at the next silence; a longer silence is a piece of its own.
    """
    wanted = max(BLOCK, frame_count(length, sample_rate))
    within = [move for move in moves if frame_count(move.time, sample_rate) < frames]
    start, quiet = 0, 0
    held: list[Onset | Move] = []
    done: list[Move] = []

    def piece(end: int) -> Segment:
        now = start / sample_rate
        moved = [one for one in held if isinstance(one, Move)]
        made = Segment(
            start=start,
            frames=end - start,
            sounds=tuple(one for one in held if isinstance(one, Onset)),
            moves=(*_in_force(done, {move.body for move in (*done, *moved)}, now), *moved),
        )
        done.extend(moved)
        return made

    coming: list[Onset | Move] = sorted([*within, *sounds], key=_time)
    for one in (*coming, None):
        onset = frames if one is None else frame_count(one.time, sample_rate)
        cut = -(-quiet // BLOCK) * BLOCK
        if start < cut < min(onset + 1, frames) and max(cut - start, onset - cut) >= wanted:
            yield piece(cut)
            start, held = cut, []
        if one is not None:
            held.append(one)
            quiet = max(quiet, frame_count(one.end + _FREED_LATE, sample_rate))
    if frames > start:
        yield piece(frames)


def _in_force(done: Sequence[Move], bodies: Iterable[str], now: float) -> Iterator[Move]:
    """Moves to what earlier ones came to; of bodies that are moved later, to what is written: a bus begins at 0."""
    ratios = Ratios(done)
    for body in sorted(bodies):
        yield Move(time=now, glide=0.0, body=body, before=AS_WRITTEN, after=ratios.at(body, now))


def _time(one: Onset | Move) -> float:
    return one.time
