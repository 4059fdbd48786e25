"""A recording of a voice read from a file, whatever it is: checked, mixed to one channel, and what was done is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import InputError, MissingExtraError
from scorebreath.speech.recording.model import Take
from scorebreath.units import decibels, plain

RATES = (8_000, 192_000)
"""Hz"""
GOOD_RATE = 16_000
"""Hz; below, the upper half of the speech is missing"""
LONGEST = 1800.0
"""s"""
SHORTEST = 0.2
"""s"""
MOST_CHANNELS = 32
HIGHEST = 1000.0
"""Sample, full scale 1: files of floats may go beyond, not that far"""
BLOCK = 1 << 16
CLIPPED = 0.999
"""Of the largest sample: a flat top"""
FLAT = 3
"""Samples in a row at the top that are no peak any more"""
TELL_CLIPPED = 3
"""Flat tops from which on it is told"""
QUIET_DB = -50.0
"""Peak below which there is nothing to hear"""
OPPOSED_DB = -6.0
"""A mix this much below its channels says that they cancel each other"""
COARSE = ("PCM_S8", "PCM_U8", "ULAW", "ALAW")
OFFSET = 0.005
"""of full scale; a larger mean is taken away"""


def load_take(path: Path) -> Take:
    """Read a recording.

    Args:
        path: Of a sound file of any format libsndfile reads.

    Raises:
        InputError: There is no such file, it is no sound, has another rate than speech can have, is empty, silent, too
            long, or holds what is no sample.
        MissingExtraError: soundfile is not installed.
    """
    try:
        import soundfile
    except ImportError as error:
        raise MissingExtraError("soundfile", "all") from error

    if not path.exists():
        raise InputError(f"{path}: no such file; expected a recording")
    if path.is_dir():
        raise InputError(f"{path}: is a folder; expected a recording")
    try:
        with soundfile.SoundFile(path) as file:
            rate, channels, coding = int(file.samplerate), int(file.channels), str(file.subtype)
            _check(path, rate, channels, file.frames / max(1, rate))
            blocks = _blocks(file, path, round(LONGEST * rate))
    except soundfile.LibsndfileError as error:
        raise InputError(f"{path}: {error.error_string} Expected a sound file") from None
    except TypeError:  # of a name that ends in .raw it asks for the rate
        raise InputError(f"{path}: says nothing about its samples; expected a sound file such as WAV") from None
    if len(blocks) < SHORTEST * rate:
        told = f"{len(blocks) / rate:.3f} s long" if len(blocks) else "empty"
        raise InputError(f"{path}: is {told}; expected a recording of speech")
    notes = []
    if coding in COARSE:
        notes.append(f"8 bits a sample ({coding}): what is quieter than {plain(-48)} dB is noise")
    if rate < GOOD_RATE:
        notes.append(f"{rate} Hz: nothing is heard above {rate // 2} Hz; words are found less exactly")
    samples = _mixed(blocks, notes)
    return Take(path=path, samples=_cleaned(path, samples, notes), sample_rate=rate, notes=tuple(notes))


def _check(path: Path, rate: int, channels: int, seconds: float) -> None:
    if not RATES[0] <= rate <= RATES[1]:
        raise InputError(f"{path}: sample_rate={rate} must be in [{RATES[0]}, {RATES[1]}] Hz")
    if channels > MOST_CHANNELS:
        raise InputError(f"{path}: channels={channels} must be at most {MOST_CHANNELS}")
    if seconds > LONGEST:
        raise InputError(
            f"{path}: lasts {seconds / 60:.0f} min; expected at most {LONGEST / 60:.0f}: cut it where it is silent"
        )


def _blocks(file: Any, path: Path, most: int) -> NDArray[np.float32]:
    """All samples, (n, channels); never more than the longest, whatever the header says."""
    found: list[NDArray[np.float32]] = []
    count = 0
    while len(block := file.read(BLOCK, dtype="float32", always_2d=True)):
        count += len(block)
        if count > most:
            raise InputError(f"{path}: lasts more than {LONGEST / 60:.0f} min: cut it where it is silent")
        if not np.max(np.abs(block)) <= HIGHEST:
            raise InputError(f"{path}: holds samples that are not finite, or far beyond full scale")
        found.append(block)
    return np.concatenate([np.zeros((0, found[0].shape[1] if found else 1), dtype=np.float32), *found])


def _mixed(samples: NDArray[np.float32], notes: list[str]) -> NDArray[np.float32]:
    """One channel."""
    channels = samples.shape[1]
    if channels == 1:
        return np.array(samples[:, 0], dtype=np.float32)
    power = np.square(samples, dtype=np.float64).mean(axis=0)
    mixed = samples.mean(axis=1, dtype=np.float64).astype(np.float32)
    loudest = int(np.argmax(power))
    own = float(np.square(mixed, dtype=np.float64).mean())
    if power[loudest] > 0 and own < power[loudest] * 10 ** (OPPOSED_DB / 10) * (1 / channels):
        notes.append(f"{channels} channels that cancel each other: channel {loudest + 1} is used alone")
        return np.array(samples[:, loudest], dtype=np.float32)
    notes.append(f"{channels} channels: mixed to one")
    return np.asarray(mixed, dtype=np.float32)


def _cleaned(path: Path, samples: NDArray[np.float32], notes: list[str]) -> NDArray[np.float32]:
    """Without an offset, within full scale; what is clipped is told."""
    peak = float(np.abs(samples).max())
    if peak <= 0.0 or decibels(peak) < QUIET_DB:
        raise InputError(f"{path}: is silent; expected a recording of speech")
    flat = _flat_tops(samples, peak)
    if flat >= TELL_CLIPPED:
        notes.append(f"clipped in {flat} places: its peaks are cut off, and nothing brings them back")
    mean = float(samples.mean(dtype=np.float64))
    if abs(mean) > OFFSET:
        notes.append(f"an offset of {mean:+.3f} is taken away")
        samples = samples - np.float32(mean)
        peak = float(np.abs(samples).max())
    if peak > 1.0:
        notes.append(f"goes {decibels(peak):.1f} dB beyond full scale: brought down to it")
        samples = samples / np.float32(peak)
    return np.asarray(np.clip(samples, -1.0, 1.0), dtype=np.float32)


def _flat_tops(samples: NDArray[np.float32], peak: float) -> int:
    """Runs of samples that stay at the very top."""
    at_top = np.abs(samples) >= CLIPPED * peak
    edges = np.flatnonzero(np.diff(np.concatenate(([False], at_top, [False])).astype(np.int8)))
    lengths = edges[1::2] - edges[::2]
    return int(np.count_nonzero(lengths >= FLAT))
