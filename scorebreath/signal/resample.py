"""Change of sample rate, by soxr: linear phase, so nothing moves in time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scorebreath.units import frame_count


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

    made = soxr.resample(np.ascontiguousarray(samples, dtype=np.float32), source, target, quality="VHQ")
    frames = frame_count(len(samples) * target / source, 1.0)
    exact = np.zeros(frames, dtype=np.float32)
    exact[: len(made)] = made[:frames]
    return exact
