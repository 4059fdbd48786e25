"""Peaks held below a ceiling by a gain that moves before they come: look-ahead costs nothing after rendering."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.units import amplitude, decibels

CEILING_DB = -1.0
"""Highest sample, dB re full scale (physiology 9.2)."""
_REACH = 512  # samples, a power of two: 11 ms at 48 kHz to move the gain down, and up again


@dataclass(slots=True, kw_only=True)
class PeakLimiter:
    """Limits a stream of blocks; remembers what it found.

    The gain a sample needs is ceiling / abs(sample), at most 1. The gain it gets is a weighted mean of minima, each
    over 512 samples that include it: never more than it needs, and smooth. Sounds below the ceiling pass bit for bit,
    and the result does not depend on how the stream is cut into blocks.
    """

    ceiling_db: float = CEILING_DB
    """dB re full scale"""
    peak: float = field(default=0.0, init=False)
    """highest absolute sample that came in"""
    gain: float = field(default=1.0, init=False)
    """lowest gain that was needed"""

    @property
    def reduction_db(self) -> float:
        """The most it took away, dB; 0 where nothing was limited."""
        return -decibels(self.gain)

    def limit(self, blocks: Iterable[NDArray[np.float32]]) -> Iterator[NDArray[np.float32]]:
        """The limited stream, of the same length.

        Args:
            blocks: Any number of arrays (n,), n any.
        """
        ceiling = np.float32(amplitude(self.ceiling_db))
        for inner, given in self.gains(blocks):
            if given is None:
                yield inner
            else:
                yield np.asarray(np.clip(inner * given, -ceiling, ceiling), dtype=np.float32)

    def gains(
        self, blocks: Iterable[NDArray[np.float32]]
    ) -> Iterator[tuple[NDArray[np.float32], NDArray[np.float64] | None]]:
        """The stream as it came, and the gain that limits each of its samples; None where that is 1.

        Args:
            blocks: Any number of arrays (n,), n any.
        """
        window = np.zeros(_REACH, dtype=np.float32)  # what was given out last, then what waits for its future
        for block in blocks:
            self.peak = max(self.peak, float(np.abs(block).max(initial=0.0)))
            window = np.concatenate((window, block))
            if len(window) > 2 * _REACH:
                yield self._shaped(window)
                window = window[-2 * _REACH :]
        yield self._shaped(np.concatenate((window, np.zeros(_REACH, dtype=np.float32))))

    def _shaped(self, window: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float64] | None]:
        """What is between the first and the last 512 samples of the window."""
        inner = window[_REACH:-_REACH]
        ceiling = np.float32(amplitude(self.ceiling_db))
        size = np.abs(window)
        if not size.max(initial=0.0) > ceiling:
            return inner, None
        needed = np.minimum(1.0, ceiling / np.maximum(size, np.float32(1e-9)), dtype=np.float64)
        self.gain = min(self.gain, float(needed.min()))
        smooth = _runs(needed, np.minimum, _REACH)
        for _ in range(2):
            smooth = _runs(smooth, np.add, _REACH // 2) / (_REACH // 2)
        return inner, smooth[2 : 2 + len(inner)]


def _runs(values: NDArray[np.float64], join: Callable[..., Any], length: int) -> NDArray[np.float64]:
    """`join` over every run of `length` values, a power of two, by doubling: the same sum wherever a run stands."""
    reach = 1
    while reach < length:
        values = join(values[:-reach], values[reach:])
        reach *= 2
    return values
