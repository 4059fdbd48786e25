"""A deadline for one wait after the other, kept by a single thread: a timer for each wait would start a thread each."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Condition, Thread


class Deadline:
    """Strikes when a block takes longer than it may. Its thread starts with the first block and ends with `close`."""

    def __init__(self, strike: Callable[[], object]) -> None:
        """Nothing is due yet.

        Args:
            strike: Called, in another thread, once for each deadline that is missed.
        """
        self.missed: float | None = None
        """Seconds that the last block to miss its deadline was allowed."""
        self._strike = strike
        self._changed = Condition()
        self._thread: Thread | None = None
        self._closed = False
        self._allowed, self._due, self._wakes = math.inf, math.inf, math.inf

    @contextmanager
    def within(self, seconds: float) -> Iterator[None]:
        """Strike if the block takes longer; blocks follow one another, they do not overlap."""
        with self._changed:
            self._allowed, self._due = seconds, time.monotonic() + seconds
            if self._thread is None:
                self._thread = Thread(target=self._watch, name="deadline", daemon=True)
                self._thread.start()
            elif self._due < self._wakes:
                self._changed.notify()
        try:
            yield
        finally:
            with self._changed:
                self._due = math.inf  # the thread finds out when it wakes; to wake it now would cost more

    def close(self) -> None:
        """Watch no more."""
        with self._changed:
            self._closed = True
            self._changed.notify()

    def _watch(self) -> None:
        with self._changed:
            while not self._closed:
                now = time.monotonic()
                if self._due <= now:
                    self._due, self.missed = math.inf, self._allowed
                    self._strike()
                self._wakes = self._due
                self._changed.wait(None if self._due == math.inf else self._due - now)
