"""Change of sample rate, by soxr: linear phase, so nothing moves in time."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.units import frame_count

QUALITY = "HQ"
"""soxr's: 20 bits, errors 120 dB down; what a resampler adds lies 20 dB below the steps of a 16-bit voice"""


def resample(samples: NDArray[np.float32], source: int, target: int) -> NDArray[np.float32]:
    """The same sound at another rate.

    Args:
        samples: (n,), float32.
        source: Its rate, Hz.
        target: The wanted rate, Hz.

    Returns:
        (round(n * target / source),), float32; a sound in time t stays at time t.

    >>> resample(np.ones(100, np.float32), 22050, 44100).shape
    (200,)
    """
    if source == target or not len(samples):
        return np.asarray(samples, dtype=np.float32)
    import soxr

    made = soxr.resample(np.ascontiguousarray(samples, dtype=np.float32), source, target, quality=QUALITY)
    frames = frame_count(len(samples) * target / source, 1.0)
    exact = np.zeros(frames, dtype=np.float32)
    exact[: len(made)] = made[:frames]
    return exact


class Resampler:
    """`resample` for a sound that comes in blocks: the same samples, however it is cut."""

    def __init__(self, source: int, target: int) -> None:
        """Nothing has come yet.

        Args:
            source: Rate of what comes, Hz.
            target: The wanted rate, Hz.
        """
        self._stream: Any = None
        if source != target:
            import soxr

            self._stream = soxr.ResampleStream(source, target, 1, dtype="float32", quality=QUALITY)

    def resample(self, block: NDArray[np.float32], *, last: bool = False) -> NDArray[np.float32]:
        """What can be given by now.

        Args:
            block: (n,), float32; n any.
            last: Nothing comes after it.

        Returns:
            (m,), float32.
        """
        if self._stream is None:
            return block
        return np.asarray(self._stream.resample_chunk(block, last=last), dtype=np.float32)
