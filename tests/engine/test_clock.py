"""Time tags against the engine's own arithmetic."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from scorebreath.engine.clock import BLOCK, OfflineClock

RATES = st.sampled_from([16000, 22050, 44100, 48000, 88200, 96000, 192000])


def heard_at(seconds: float, rate: int) -> int:
    """Frame on which scsynth starts what has this time: whole blocks in whole 2^-32 s, an edge belongs to the past."""
    tag = int(seconds * 2**32)
    step = int(BLOCK / rate * 2**32)
    block = max(0, -(-tag // step) - 1)
    return block * BLOCK + min(BLOCK - 1, int((tag - block * step) * rate / 2**32 + 0.5))


@given(RATES, st.integers(0, 192000 * 10800))
def test_a_frame_is_met_exactly_after_hours(rate: int, frame: int) -> None:
    assert heard_at(OfflineClock(sample_rate=rate).of_frame(frame), rate) == frame


def test_plain_seconds_would_drift() -> None:
    assert heard_at(3 * 3600.0, 48000) - 3 * 3600 * 48000 >= 5  # the reason for the clock


@given(RATES, st.integers(0, 10**9), st.integers(0, 10**6))
def test_a_late_start_is_the_same_clock(rate: int, frame: int, blocks: int) -> None:
    late = OfflineClock(sample_rate=rate, start=blocks * BLOCK)
    assert late.of_frame(frame + blocks * BLOCK) == OfflineClock(sample_rate=rate).of_frame(frame)
    assert late.of_frame(0) == OfflineClock(sample_rate=rate).of_frame(0)


@given(RATES, st.lists(st.floats(0, 10800), min_size=2))
def test_later_is_not_earlier(rate: int, times: list[float]) -> None:
    clock = OfflineClock(sample_rate=rate)
    told = [clock(time) for time in sorted(times)]
    assert told == sorted(told)
