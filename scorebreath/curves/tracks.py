"""Events in order of time, as arrays, so that many moments are looked up at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import ScoreError
from scorebreath.score.events import Event
from scorebreath.units import GRID, snap

Array = NDArray[np.float64]
Index = NDArray[np.intp]
Mask = NDArray[np.bool_]
E = TypeVar("E", bound=Event)

TOUCH = 1.5 / GRID
"""s; events this close touch: onset and duration are each rounded to the grid, their sum may miss the next onset."""


class Acts(Protocol):
    """Events of some bodies: a Score, or a part of one."""

    @property
    def events(self) -> tuple[Event, ...]:
        """In any order."""

    def of(self, kind: type[E], body: str | None = None) -> Iterator[E]:
        """Events of one type, of one body or of all."""


@dataclass(frozen=True, slots=True)
class Track(Generic[E]):
    """Events that follow one another, sorted by onset."""

    events: tuple[E, ...]
    start: Array
    """(n,) s"""
    end: Array
    """(n,) s"""

    def column(self, value: Callable[[E], float]) -> Array:
        """One number of every event, (n,)."""
        return np.array([value(event) for event in self.events], dtype=np.float64)

    def at(self, times: Array) -> tuple[Index, Mask]:
        """The event under way at each time.

        Returns:
            Its index (0 where there is none) and whether there is one, each shaped like `times`. Where two
            events touch it is the later one.
        """
        if not self.events:
            return np.zeros(times.shape, dtype=np.intp), np.zeros(times.shape, dtype=np.bool_)
        index = np.searchsorted(self.start, times, side="right") - 1
        found = np.maximum(index, 0)
        return found, np.asarray((index >= 0) & (times <= self.end[found] + TOUCH))


def track(events: Sequence[E], what: str) -> Track[E]:
    """Events of one body that cannot happen at the same time.

    Args:
        events: In any order; those without duration are left out, as nothing happens in them.
        what: Their name in an error, e.g. `breaths`.

    Raises:
        ScoreError: Two of them overlap.
    """
    lasting = tuple(sorted((event for event in events if event.duration > 0), key=lambda event: event.onset))
    start = np.array([event.onset for event in lasting], dtype=np.float64)
    end = np.array([snap(event.end) for event in lasting], dtype=np.float64)
    late = np.flatnonzero(end[:-1] > start[1:] + TOUCH)
    if late.size:
        one, two = lasting[late[0]], lasting[late[0] + 1]
        raise ScoreError(
            f"{what} of {one.body!r} overlap: event {one.id!r} ends at {one.end:.6f} s, "
            f"event {two.id!r} begins at {two.onset:.6f} s; expected one after the other"
        )
    return Track(events=lasting, start=start, end=end)
