"""Sample rates an engine is asked for."""

from __future__ import annotations

from scorebreath.errors import InputError

SAMPLE_RATE = 48000
"""Hz, unless something else is asked for."""
LOWEST, HIGHEST = 16000, 192000
"""Hz; below, the highest resonance of a breath would not fit"""


def check_sample_rate(rate: int) -> int:
    """The rate itself.

    Raises:
        InputError: It is out of range.

    >>> check_sample_rate(44100)
    44100
    """
    if not LOWEST <= rate <= HIGHEST:
        raise InputError(f"sample_rate={rate} must be in {LOWEST}..{HIGHEST} Hz")
    return rate
