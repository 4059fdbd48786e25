"""Media as the engine wants them: at its own rate, one channel, ending with a zero, under plain names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from scorebreath.errors import ScoreError, shortened
from scorebreath.media.store import MediaStore
from scorebreath.media.wave import write_wave
from scorebreath.signal.resample import resample


def stage(
    lengths: Mapping[str, float],
    media: MediaStore,
    folder: Path,
    *,
    sample_rate: int,
    on_progress: Callable[[float], None] | None = None,
) -> dict[str, str]:
    """Write media into a folder, one at a time.

    Args:
        lengths: What is wanted, by its SHA-256, and how many seconds of it there should be.
        media: Where they are.
        folder: Where they go.
        sample_rate: The engine's, Hz.
        on_progress: Called with the share that is done.

    Returns:
        Names of files in the folder, by SHA-256.

    Raises:
        ScoreError: Media are missing, of another length, or hold samples that are not finite.
    """
    staged: dict[str, str] = {}
    for index, (name, length) in enumerate(lengths.items()):
        staged[name] = f"s{index:06d}.wav"
        stage_one(name, length, media, folder / staged[name], sample_rate=sample_rate)
        if on_progress is not None:
            on_progress((index + 1) / len(lengths))
    return staged


def stage_one(name: str, length: float, media: MediaStore, path: Path, *, sample_rate: int) -> None:
    """Write one of the media.

    Args:
        name: Its SHA-256.
        length: Seconds of it that there should be.
        media: Where it is.
        path: The file to write.
        sample_rate: The engine's, Hz.

    Raises:
        ScoreError: It is missing, of another length, or holds samples that are not finite.
    """
    sound = media.get(name)
    if abs(len(sound.samples) - length * sound.sample_rate) > 0.5:
        raise ScoreError(
            f"media {shortened(name)!r} last {len(sound.samples) / sound.sample_rate:g} s, not {length:g} s"
        )
    if not np.isfinite(np.abs(sound.samples).max(initial=0.0)):
        raise ScoreError(f"media {shortened(name)!r} hold samples that are not finite")
    samples = np.append(resample(sound.samples, sound.sample_rate, sample_rate), np.float32(0))
    with path.open("wb") as stream:
        write_wave(stream, [samples], frames=len(samples), sample_rate=sample_rate, encoding="float32")
