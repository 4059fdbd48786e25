"""How loud a sound is to the ear, and how high its peaks are between the samples (ITU-R BS.1770-4).

The filters are pyloudnorm's. The sound comes block by block, so that an hour takes no more memory than a minute.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import MissingExtraError
from scorebreath.units import decibels

EXTRA = "loudness"
GATE, STEPS = 0.4, 4
"""s of a gating block; steps in it: blocks overlap by three quarters"""
ABSOLUTE, RELATIVE = -70.0, -10.0
"""LUFS of the first gate; LU below what is left, of the second"""
OFFSET = -0.691
OVERSAMPLING = 4
"""Times as many samples, between which peaks are looked for"""
NOTHING = -200.0
"""LUFS told for what is silent, or too short to be told"""


class LoudnessMeter:
    """Integrated loudness of one channel."""

    def __init__(self, sample_rate: int) -> None:
        """Nothing is heard yet.

        Args:
            sample_rate: Hz.

        Raises:
            MissingExtraError: pyloudnorm is not installed.
        """
        try:
            from pyloudnorm import Meter
            from scipy.signal import lfilter
        except ImportError as error:
            raise MissingExtraError("pyloudnorm", EXTRA) from error
        self._rate, self._lfilter = sample_rate, lfilter
        self._stages: list[Any] = list(Meter(sample_rate)._filters.values())
        self._memory = [np.zeros(max(len(stage.a), len(stage.b)) - 1) for stage in self._stages]
        self._sums: list[float] = []
        self._part, self._done, self._frames = 0.0, 0, 0

    def add(self, block: NDArray[np.float32]) -> None:
        """Hear what comes next, (n,)."""
        if not len(block):
            return
        sound: NDArray[np.float64] = np.asarray(block, dtype=np.float64)
        for place, stage in enumerate(self._stages):
            sound, self._memory[place] = self._lfilter(stage.b, stage.a, sound, zi=self._memory[place])
            sound = sound * stage.passband_gain
        power = np.concatenate(([0.0], np.cumsum(np.square(sound))))
        begun, end = self._frames, self._frames + len(sound)
        while (edge := self._edge(self._done + 1)) <= end:
            start = max(self._edge(self._done), begun)
            self._sums.append(self._part + float(power[edge - begun] - power[start - begun]))
            self._part, self._done = 0.0, self._done + 1
        self._part += float(power[-1] - power[max(self._edge(self._done), begun) - begun])
        self._frames = end

    def integrated(self) -> float:
        """LUFS; `NOTHING` for what is silent, or shorter than a gating block."""
        count = round((self._frames / self._rate - GATE) / (GATE / STEPS)) + 1
        sums = np.array([*self._sums, self._part])
        if self._frames < GATE * self._rate or count < 1 or len(sums) < STEPS:
            return NOTHING
        together = np.lib.stride_tricks.sliding_window_view(sums, STEPS).sum(axis=1)[:count]
        power = together / (GATE * self._rate)
        with np.errstate(divide="ignore"):
            loud = OFFSET + 10.0 * np.log10(power)
        heard = power[loud >= ABSOLUTE]
        if not len(heard):
            return NOTHING
        gate = OFFSET + 10.0 * np.log10(heard.mean()) + RELATIVE
        left = power[(loud > gate) & (loud > ABSOLUTE)]
        return float(OFFSET + 10.0 * np.log10(left.mean())) if len(left) else NOTHING

    def _edge(self, step: int) -> int:
        """Frame at which a step of a gating block begins."""
        return int(GATE / STEPS * step * self._rate + 1e-9)


class TruePeak:
    """The highest peak of one channel, between its samples, too."""

    def __init__(self, sample_rate: int) -> None:
        """Nothing is heard yet.

        Args:
            sample_rate: Hz.

        Raises:
            MissingExtraError: soxr is not installed.
        """
        try:
            import soxr
        except ImportError as error:
            raise MissingExtraError("soxr", "all") from error
        self._stream = soxr.ResampleStream(sample_rate, OVERSAMPLING * sample_rate, 1, dtype="float32", quality="VHQ")
        self._peak = 0.0

    def add(self, block: NDArray[np.float32], *, last: bool = False) -> None:
        """Hear what comes next, (n,)."""
        sound = np.asarray(block, dtype=np.float32)
        made = self._stream.resample_chunk(sound, last=last)
        self._peak = max(self._peak, float(np.abs(made).max(initial=0.0)), float(np.abs(sound).max(initial=0.0)))

    def peak_db(self) -> float:
        """In dB re full scale; to be asked at the end."""
        return decibels(self._peak)
