"""The clock of a live engine: seconds of the performance as NTP time tags, on the frames that an offline run counts."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.units import frame_count

SECOND = 2**32
"""Units of an OSC time tag."""
EPOCH = 2_208_988_800
"""s from 1900, where tags begin, to 1970, where Unix time does."""
AT_ONCE = 1
"""The tag of what is to be done as soon as it arrives."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LiveClock:
    """Maps seconds of the performance to time tags."""

    start: float
    """Unix time of second 0"""
    sample_rate: int
    """Hz"""

    @property
    def start_tag(self) -> int:
        """The time tag of second 0."""
        return round((self.start + EPOCH) * SECOND)

    def frame(self, time: float) -> int:
        """The frame that a moment falls on, as offline."""
        return frame_count(time, self.sample_rate)

    def tag(self, time: float) -> int:
        """The time tag of a moment's frame, a quarter of a frame behind its edge, as offline.

        >>> clock = LiveClock(start=0.0, sample_rate=48000)
        >>> clock.tag(1.0) - clock.tag(0.0) == SECOND
        True
        """
        return self.start_tag + ((4 * self.frame(time) + 1) * SECOND) // (4 * self.sample_rate)

    def seconds(self, unix: float) -> float:
        """Second of the performance at a Unix time."""
        return unix - self.start
