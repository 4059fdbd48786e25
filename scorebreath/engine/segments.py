"""A long Score in pieces that are rendered one after another, cut where nothing sounds.

What an engine holds and what lies on the disk then does not grow with the Score, and the sound is the same bit for bit:
a sound depends on its own seed and settings alone, and pieces begin on the engine's blocks.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from scorebreath.engine.clock import BLOCK
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

    @property
    def overlap(self) -> int:
        """The most sounds that the engine holds at once."""
        starts = [(sound.time, 1) for sound in self.sounds]
        ends = [(sound.end + _FREED_LATE, -1) for sound in self.sounds]
        edges = sorted(starts + ends, key=lambda edge: (edge[0], -edge[1]))
        return max(itertools.accumulate((step for _, step in edges), initial=0))


def segments(sounds: Sequence[Onset], *, frames: int, sample_rate: int, length: float = LENGTH) -> Iterator[Segment]:
    """Pieces that together are the whole, in order.

    Args:
        sounds: In order of time, all within the frames.
        frames: Of the whole.
        sample_rate: Hz.
        length: Seconds after which a piece ends at the next silence; a longer silence is a piece of its own.
    """
    wanted = max(BLOCK, frame_count(length, sample_rate))
    start, quiet = 0, 0
    held: list[Onset] = []
    for sound in (*sounds, None):
        onset = frames if sound is None else frame_count(sound.time, sample_rate)
        cut = -(-quiet // BLOCK) * BLOCK
        if start < cut < min(onset + 1, frames) and max(cut - start, onset - cut) >= wanted:
            yield Segment(start=start, frames=cut - start, sounds=tuple(held))
            start, held = cut, []
        if sound is not None:
            held.append(sound)
            quiet = max(quiet, frame_count(sound.end + _FREED_LATE, sample_rate))
    if frames > start:
        yield Segment(start=start, frames=frames - start, sounds=tuple(held))
