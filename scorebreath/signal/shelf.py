"""A brighter or duller sound that is as loud as before: a shelf, without any delay."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

CORNER = 1000.0
"""Hz, in the middle of the slope"""
ROOM = 0.02
"""s of silence around the sound, so that its end does not ring into its beginning"""


def shelf(
    samples: NDArray[np.float32], sample_rate: int, gain_db: float, corner: float = CORNER
) -> NDArray[np.float32]:
    """Raise or lower what is above a corner; what is far below stays.

    The gain over frequency is that of a shelving filter of first order, half of `gain_db` at the corner, in zero phase:
    no sound moves in time.

    Args:
        samples: (n,) floats.
        sample_rate: Hz.
        gain_db: Far above the corner.
        corner: Hz.

    Returns:
        (n,) float32; the very samples for 0 dB.
    """
    if gain_db == 0.0 or not len(samples):
        return samples
    room = round(ROOM * sample_rate)
    size = 1 << int(np.ceil(np.log2(len(samples) + 2 * room)))
    spectrum = np.fft.rfft(np.asarray(samples, dtype=np.float64), size)
    ratio = 10.0 ** (gain_db / 20.0)
    place = np.square(np.fft.rfftfreq(size, 1.0 / sample_rate) / corner)
    gain = np.sqrt((1.0 + ratio * place) / (1.0 + place / ratio))
    return np.fft.irfft(spectrum * gain, size)[: len(samples)].astype(np.float32)
