"""Deadlines of one block after the other, kept by one thread."""

from __future__ import annotations

import time
from threading import Event

import pytest

from scorebreath.speech.deadline import Deadline

SOON, LATE = 0.05, 60.0


def test_a_block_that_takes_too_long_is_struck_once() -> None:
    struck: list[float] = []
    done = Event()

    def strike() -> None:
        struck.append(time.monotonic())
        done.set()

    deadline = Deadline(strike)
    try:
        with deadline.within(SOON):
            assert done.wait(LATE)
            time.sleep(3 * SOON)
        assert len(struck) == 1
        assert deadline.missed == SOON
    finally:
        deadline.close()


@pytest.mark.parametrize("before", [LATE, SOON / 10])
def test_a_short_deadline_holds_whatever_came_before(before: float) -> None:
    struck = Event()
    deadline = Deadline(struck.set)
    try:
        with deadline.within(LATE):
            pass
        with deadline.within(before):
            pass
        struck.clear()
        started = time.monotonic()
        with deadline.within(SOON):
            assert struck.wait(LATE)
        assert time.monotonic() - started >= SOON
    finally:
        deadline.close()


def test_blocks_within_their_time_are_left_alone_and_share_a_thread() -> None:
    struck: list[int] = []
    threads = set()
    deadline = Deadline(lambda: struck.append(1))
    try:
        for _ in range(200):
            with deadline.within(LATE):
                threads.add(deadline._thread)
        with deadline.within(SOON):
            pass
        time.sleep(3 * SOON)  # the block was over in time, so its deadline passes unnoticed
        assert not struck
        assert deadline.missed is None
        assert len(threads) == 1
    finally:
        deadline.close()


def test_closing_ends_the_thread() -> None:
    deadline = Deadline(lambda: None)
    with deadline.within(LATE):
        pass
    deadline.close()
    assert deadline._thread is not None
    deadline._thread.join(LATE)
    assert not deadline._thread.is_alive()
