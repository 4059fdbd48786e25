"""Sounds that are read a window at a time: an array, or a file of any length."""

from __future__ import annotations

from pathlib import Path
from types import TracebackType
from typing import Any, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import InputError

Array = NDArray[np.float64]


class Sound(Protocol):
    """Something to listen to; channels are averaged."""

    @property
    def rate(self) -> float:
        """Hz."""

    @property
    def seconds(self) -> float:
        """Its length."""

    def read(self, start: float, end: float) -> Array:
        """Samples (n,) from one time to another, s; what lies outside is left out."""


class ArraySound:
    """Samples in memory."""

    def __init__(self, samples: NDArray[Any], rate: float) -> None:
        """Take them as they are.

        Args:
            samples: (n,) or (n, channels).
            rate: Hz.

        Raises:
            InputError: They are no floats, have more dimensions, or are not finite.
        """
        if not np.issubdtype(samples.dtype, np.floating):
            raise InputError(f"samples of {samples.dtype}: expected floats, full scale 1")
        if samples.ndim not in (1, 2):
            raise InputError(f"samples with {samples.ndim} dimensions: expected (n,) or (n, channels)")
        if not np.all(np.isfinite(samples)):
            raise InputError("samples must be finite")
        self._samples, self.rate = samples, float(rate)

    @property
    def seconds(self) -> float:
        """Its length."""
        return len(self._samples) / self.rate

    def read(self, start: float, end: float) -> Array:
        """Samples (n,) from one time to another, s; what lies outside is left out."""
        first, last = _frames(start, end, self.rate, len(self._samples))
        return _mono(self._samples[first:last])


class FileSound:
    """A sound file, read where it is listened to; use it as a context manager."""

    def __init__(self, path: Path) -> None:
        """Open it.

        Raises:
            InputError: It is not there, or is no sound.
        """
        import soundfile

        if not path.is_file():
            raise InputError(f"{path}: {'is a folder' if path.is_dir() else 'no such file'}; expected a sound file")
        try:
            self._file = soundfile.SoundFile(path)
        except soundfile.LibsndfileError as error:
            raise InputError(f"{path}: {error.error_string} Expected a sound file") from None
        self._path, self._broken = path, soundfile.LibsndfileError
        self.rate = float(self._file.samplerate)

    @property
    def seconds(self) -> float:
        """Its length."""
        return float(self._file.frames / self.rate)

    def read(self, start: float, end: float) -> Array:
        """Samples (n,) from one time to another, s; what lies outside is left out.

        Raises:
            InputError: The file is broken there.
        """
        first, last = _frames(start, end, self.rate, self._file.frames)
        if last <= first:
            return np.zeros(0)
        try:
            self._file.seek(first)
            samples = self._file.read(last - first, dtype="float64")
        except self._broken as error:
            raise InputError(f"{self._path}: {error.error_string}") from None
        if not np.all(np.isfinite(samples)):
            raise InputError(f"{self._path}: holds samples that are not finite, after {start:.3f} s")
        return _mono(samples)

    def __enter__(self) -> Self:
        """The sound."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """Close the file."""
        self._file.close()


def _frames(start: float, end: float, rate: float, frames: int) -> tuple[int, int]:
    first, last = (min(max(time * rate, 0.0), float(frames)) for time in (start, end))
    return int(first + 0.5), int(last + 0.5)


def _mono(samples: NDArray[Any]) -> Array:
    mono = samples if samples.ndim == 1 else samples.mean(axis=1)
    return np.asarray(mono, dtype=np.float64)
