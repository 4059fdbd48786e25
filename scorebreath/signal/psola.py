"""Another pitch for the same words: Praat's pitch-synchronous overlap-add, through parselmouth; no time moves."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import MissingExtraError
from scorebreath.signal.pitch import CEILING, FLOOR

STEP = 0.01
"""s between two values of Praat's own analysis for a manipulation"""
Change = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]
"""Semitones to add, from times (s) and pitches (Hz), each (n,)."""


def shift_pitch(
    samples: NDArray[np.float32], sample_rate: int, semitones: float, *, floor: float = FLOOR, ceiling: float = CEILING
) -> NDArray[np.float32]:
    """Raise or lower the pitch as a whole.

    Args:
        samples: (n,) floats, full scale 1.
        sample_rate: Hz.
        semitones: How far.
        floor: Hz; lowest pitch looked for.
        ceiling: Hz; highest pitch looked for.

    Returns:
        (n,) float32; what is too short or nowhere voiced comes back as it is.

    Raises:
        MissingExtraError: parselmouth is not installed.
    """
    if semitones == 0.0:
        return samples
    return change_pitch(
        samples, sample_rate, lambda times, hertz: np.full(len(times), semitones), floor=floor, ceiling=ceiling
    )


def change_pitch(
    samples: NDArray[np.float32], sample_rate: int, change: Change, *, floor: float = FLOOR, ceiling: float = CEILING
) -> NDArray[np.float32]:
    """Raise or lower the pitch, from time to time as it is told.

    Args:
        samples: (n,) floats, full scale 1.
        sample_rate: Hz.
        change: Asked once, for the places where there is a pitch.
        floor: Hz; lowest pitch looked for.
        ceiling: Hz; highest pitch looked for.

    Returns:
        (n,) float32; what is too short or nowhere voiced comes back as it is.

    Raises:
        MissingExtraError: parselmouth is not installed.
    """
    try:
        import parselmouth
        from parselmouth.praat import call
    except ImportError as error:
        raise MissingExtraError("parselmouth", "all") from error

    if len(samples) <= 3 * sample_rate / floor:
        return samples
    sound = parselmouth.Sound(samples.astype(np.float64), sample_rate)
    manipulation = call(sound, "To Manipulation", STEP, floor, ceiling)
    times, hertz = _points(call(manipulation, "Extract pitch tier"))
    if not len(times):
        return samples
    wanted = hertz * np.exp2(change(times, hertz) / 12.0)
    tier = call("Create PitchTier", "wanted", sound.xmin, sound.xmax)
    for time, value in zip(times.tolist(), wanted.tolist(), strict=True):
        call(tier, "Add point", time, value)
    call([tier, manipulation], "Replace pitch tier")
    made = np.asarray(call(manipulation, "Get resynthesis (overlap-add)").values[0], dtype=np.float32)
    out = np.zeros(len(samples), dtype=np.float32)
    out[: len(made)] = made[: len(samples)]
    return np.clip(out, -1.0, 1.0)


def _points(tier: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times and values of a tier."""
    from parselmouth.praat import call

    count = int(call(tier, "Get number of points"))
    times = [call(tier, "Get time from index", number) for number in range(1, count + 1)]
    values = [call(tier, "Get value at index", number) for number in range(1, count + 1)]
    return np.asarray(times, dtype=np.float64), np.asarray(values, dtype=np.float64)
