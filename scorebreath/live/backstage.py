"""Backstage: while one group sounds, the next are planned, spoken and measured, away from whoever keeps time."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Protocol

from scorebreath.live.preparing import Prepared, Preparer
from scorebreath.live.prompter import NOTHING


class Backstage(Protocol):
    """Where groups are prepared."""

    def tell(self, message: Callable[[Preparer], None]) -> None:
        """Have something done to the preparer before it goes on."""

    def want(self, count: int, flush: int) -> None:
        """So many groups are to be ready; how much of an unfinished text to take for them."""

    def collect(self) -> list[Prepared]:
        """What has become ready, in order."""

    @property
    def speaking(self) -> bool:
        """Whether a voice is at work."""

    @property
    def idle(self) -> bool:
        """Whether there is nothing left to say: no text, none announced."""


class Thread:
    """A backstage with a thread of its own.

    Args:
        preparer: What works there.
        wake: Called, from the thread, whenever something has become ready.
    """

    def __init__(self, preparer: Preparer, wake: Callable[[], None]) -> None:
        """Begin to work."""
        self._preparer, self._wake = preparer, wake
        self._condition = threading.Condition()
        self._messages: deque[Callable[[Preparer], None]] = deque()
        self._ready: deque[Prepared] = deque()
        self._wanted, self._flush = 0, NOTHING
        self._starved = self._idle = True
        self._tried = NOTHING  # how much of the text was taken when there was not enough
        self._closed = False
        self._broken: BaseException | None = None
        self._thread = threading.Thread(target=self._run, name="backstage", daemon=True)
        self._thread.start()

    def tell(self, message: Callable[[Preparer], None]) -> None:
        """Have something done to the preparer before it goes on."""
        with self._condition:
            self._messages.append(message)
            self._starved = self._idle = False
            self._tried = NOTHING
            self._condition.notify()

    def want(self, count: int, flush: int) -> None:
        """So many groups are to be ready."""
        with self._condition:
            if (count, flush) != (self._wanted, self._flush):
                self._wanted, self._flush = count, flush
                self._condition.notify()

    def collect(self) -> list[Prepared]:
        """What has become ready, in order."""
        with self._condition:
            if self._broken is not None:
                raise self._broken
            found = list(self._ready)
            self._ready.clear()
            return found

    @property
    def speaking(self) -> bool:
        """Whether a voice is at work."""
        return self._preparer.speaking

    @property
    def idle(self) -> bool:
        """Whether there is nothing left to say."""
        with self._condition:
            return self._idle and not self._messages and not self._ready

    def close(self, timeout: float = 5.0) -> None:
        """End the thread; what it is busy with is left."""
        with self._condition:
            self._closed = True
            self._condition.notify()
        self._thread.join(timeout)

    def _run(self) -> None:
        try:
            while self._work():
                pass
        except BaseException as error:  # raised again where groups are collected
            self._broken = error
        finally:
            self._wake()

    def _work(self) -> bool:
        """One message or one group; False when all is over."""
        with self._condition:
            while not self._closed and not self._messages and not self._hungry():
                self._condition.wait()
            if self._closed:
                return False
            message = self._messages.popleft() if self._messages else None
            flush = self._flush
        if message is not None:
            message(self._preparer)
            return True
        made = self._preparer.work(flush)
        with self._condition:
            self._starved, self._tried = made is None, flush
            self._idle = made is None and self._preparer.prompter.idle
            if made is not None:
                self._ready.append(made)
        self._wake()
        return True

    def _hungry(self) -> bool:
        return len(self._ready) < self._wanted and (not self._starved or self._flush > self._tried)
