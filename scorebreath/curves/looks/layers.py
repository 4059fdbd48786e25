"""Events that may happen at the same time, as arrays: looked up at many moments, at a cost of the moments alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush
from typing import TypeVar

import numpy as np

from scorebreath.curves.tracks import Array, Index
from scorebreath.score.events import Event
from scorebreath.units import snap

E = TypeVar("E", bound=Event)


@dataclass(frozen=True, slots=True)
class Layer:
    """Events that follow one another, as rows of numbers."""

    start: Array
    """(n,) s"""
    end: Array
    """(n,) s"""
    numbers: Array
    """(columns, n): what each event says"""

    def under_way(self, times: Array) -> tuple[Index, Array, Array]:
        """The moments at which one of the events is under way.

        Returns:
            Which of `times`, (m,); seconds since the event's onset, (m,); and its numbers, (columns, m).
        """
        found = np.searchsorted(self.start, times, side="right") - 1
        at = np.flatnonzero((found >= 0) & (times <= self.end[np.maximum(found, 0)]))
        index = found[at]
        return at, times[at] - self.start[index], self.numbers[:, index]


@dataclass(frozen=True, slots=True)
class Layers:
    """Events of one kind in as few layers as hold them: as many as are ever under way at once."""

    layers: tuple[Layer, ...]

    def under_way(self, times: Array) -> Iterator[tuple[Index, Array, Array]]:
        """`Layer.under_way` of each layer."""
        for layer in self.layers:
            yield layer.under_way(times)


def layers(events: Sequence[E], numbers: Callable[[E], tuple[float, ...]]) -> Layers:
    """Sort events into layers, the first free one each.

    Args:
        events: Of one body and one kind, in any order; in those without duration nothing happens.
        numbers: What an event says, as many numbers for each.
    """
    rows: list[list[tuple[float, ...]]] = []
    busy: list[tuple[float, int]] = []  # when a layer's last event ends, and which layer
    lasting = sorted((e for e in events if e.duration > 0), key=lambda e: (e.onset, e.duration, e.id))
    for event in lasting:
        end = snap(event.end)
        if busy and busy[0][0] <= event.onset:
            layer = heappop(busy)[1]
        else:
            layer = len(rows)
            rows.append([])
        rows[layer].append((event.onset, end, *numbers(event)))
        heappush(busy, (end, layer))
    tables = [np.array(layer, dtype=np.float64).T.copy() for layer in rows]
    return Layers(tuple(Layer(start=table[0], end=table[1], numbers=table[2:]) for table in tables))
