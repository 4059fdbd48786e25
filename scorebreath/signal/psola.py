"""Another pitch for the same words: Praat's pitch-synchronous overlap-add, through parselmouth; no time moves."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import MissingExtraError
from scorebreath.signal.pitch import CEILING, FLOOR

STEP = 0.01
"""s between two values of Praat's own analysis for a manipulation"""


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
    try:
        import parselmouth
        from parselmouth.praat import call
    except ImportError as error:
        raise MissingExtraError("parselmouth", "all") from error

    if semitones == 0.0 or len(samples) <= 3 * sample_rate / floor:
        return samples
    sound = parselmouth.Sound(samples.astype(np.float64), sample_rate)
    manipulation = call(sound, "To Manipulation", STEP, floor, ceiling)
    tier = call(manipulation, "Extract pitch tier")
    if call(tier, "Get number of points") == 0:
        return samples
    call(tier, "Shift frequencies", sound.xmin, sound.xmax, semitones, "semitones")
    call([tier, manipulation], "Replace pitch tier")
    made = np.asarray(call(manipulation, "Get resynthesis (overlap-add)").values[0], dtype=np.float32)
    out = np.zeros(len(samples), dtype=np.float32)
    out[: len(made)] = made[: len(samples)]
    return np.clip(out, -1.0, 1.0)
