"""A sound as small as a page can carry without losing anything heard, encoded while it comes."""

from __future__ import annotations

import io
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.signal.resample import Resampler

RATE = 24_000
"""Hz; FLAC of 16 bits: sample for sample what was rendered up to 12 kHz, in every browser"""
BLOCK = 1 << 16
"""Frames written at once: libsndfile overflows its stack on one endless block."""
FULL_SCALE = 32_768


class CompactSound:
    """The first seconds of a sound as mono FLAC. Give it block after block, then take the file.

    What it holds in memory is the file alone.
    """

    def __init__(self, sample_rate: int, longest: float) -> None:
        """Nothing of it is there yet.

        Args:
            sample_rate: Of what comes, Hz.
            longest: Seconds that are kept.
        """
        import soundfile

        self._left = math.ceil(longest * sample_rate)
        self._resampler = Resampler(sample_rate, RATE)
        self._held = io.BytesIO()
        self._file = soundfile.SoundFile(self._held, "w", RATE, 1, subtype="PCM_16", format="FLAC")

    @property
    def complete(self) -> bool:
        """Whether more would be left out."""
        return self._left == 0

    def add(self, samples: NDArray[Any]) -> None:
        """The next samples.

        Args:
            samples: (n,) or (n, channels), full scale 1; n any.
        """
        part = np.asarray(samples[: self._left], dtype=np.float32)
        if not len(part):
            return
        self._left -= len(part)
        self._write(part if part.ndim == 1 else part.mean(axis=1, dtype=np.float32), last=False)

    def flac(self) -> bytes:
        """The file; nothing can be added afterwards."""
        self._write(np.zeros(0, dtype=np.float32), last=True)
        self._file.close()
        return self._held.getvalue()

    def _write(self, samples: NDArray[np.float32], *, last: bool) -> None:
        made = self._resampler.resample(samples, last=last)
        for start in range(0, len(made), BLOCK):
            steps = made[start : start + BLOCK] * np.float32(FULL_SCALE)
            np.rint(steps, out=steps)
            np.clip(steps, -FULL_SCALE, FULL_SCALE - 1, out=steps)
            self._file.write(steps.astype(np.int16))
