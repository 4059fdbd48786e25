"""The clock of an engine that renders offline: which time tag starts a sound on which frame.

The engine counts time in whole 2^-32 s a block of 64 frames and drops the rest, so tags made from seconds drift: 5.6
frames in 3 h at 48 kHz. Tags made from its own count do not. A tag just on a block's edge falls into the block before,
so tags point a quarter of a frame behind it.
"""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.units import frame_count

BLOCK = 64
"""Frames an engine computes at once."""
_SECOND = 2**32  # units of an OSC time tag


@dataclass(frozen=True, slots=True, kw_only=True)
class OfflineClock:
    """Maps the Score's seconds to the engine's."""

    sample_rate: int
    """Hz"""
    start: int = 0
    """frame of the Score at which the engine begins"""

    def __call__(self, time: float) -> float:
        """The engine's seconds for a moment of the Score, on the nearest frame.

        >>> clock = OfflineClock(sample_rate=48000)
        >>> clock(3600.0) < 3600.0
        True
        """
        return self.of_frame(frame_count(time, self.sample_rate))

    def of_frame(self, frame: int) -> float:
        """The engine's seconds for a frame, not before 0; exact in binary, so nothing is lost on the way to a tag."""
        frame = max(0, frame - self.start)
        block, within = divmod(frame, BLOCK)
        tag = block * (BLOCK * _SECOND // self.sample_rate) + round((within + 0.25) * _SECOND / self.sample_rate)
        return tag / _SECOND

    def frame_of(self, tag: int) -> int:
        """The frame of the Score that a time tag of this clock stands for.

        >>> clock = OfflineClock(sample_rate=44100)
        >>> clock.frame_of(int(clock(1.0) * 2**32))
        44100
        """
        block, within = divmod(tag, BLOCK * _SECOND // self.sample_rate)
        return self.start + BLOCK * block + int(within * self.sample_rate / _SECOND)
