"""A breath in strokes: drawn in gasps, let out in laugh puffs, or all at once; and its noise, once in each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from scorebreath.curves.tracks import TOUCH, Array, Index, Track
from scorebreath.equations import shapes
from scorebreath.errors import ScoreError
from scorebreath.score.breathing import PUFF_SHARE
from scorebreath.score.document import Person
from scorebreath.score.events import Expiration, Hold, Inspiration, Noise, Profile
from scorebreath.units import plain

VolumeEvent = Inspiration | Expiration | Hold


class Way(NamedTuple):
    """How a profile moves air, as functions of progress and peak, both 0..1."""

    volume: Callable[[Array, Array], Array]
    """share of the volume that has moved"""
    flow: Callable[[Array, Array], Array]
    """its derivative: flow relative to the mean"""


WAYS: Mapping[Profile, Way] = MappingProxyType(
    {
        "linear": Way(lambda x, _: x, lambda x, _: np.ones_like(x)),
        "sine": Way(shapes.sine_volume, shapes.sine_flow),
        "exponential": Way(lambda x, _: shapes.exponential_volume(x), lambda x, _: shapes.exponential_flow(x)),
    }
)
"""Every profile a breath can have."""
_NAMES = tuple(WAYS)


class Stroke(NamedTuple):
    """Air that moves without a stop; s from its event's onset."""

    onset: float
    end: float
    begin_share: float
    """of the event's volume, moved before"""
    end_share: float
    """moved afterwards"""


def strokes_of(event: VolumeEvent) -> tuple[Stroke, ...]:
    """The strokes of one event, the first at its onset; between them nothing moves.

    Raises:
        ScoreError: Laugh puffs do not ascend, or begin outside the event.
    """
    if isinstance(event, Inspiration) and event.saccades > 1:
        n = event.saccades
        edges = [*(event.duration * k / n for k in range(n)), event.duration]
        return tuple(Stroke(edges[k], edges[k + 1], k / n, (k + 1) / n) for k in range(n))
    if isinstance(event, Expiration) and event.puffs:
        return tuple(_puffs(event))
    return (Stroke(0.0, event.duration, 0.0, 1.0),)


def _puffs(event: Expiration) -> Iterator[Stroke]:
    n = len(event.puffs)
    if event.puffs[0] > 0:
        yield Stroke(0.0, event.puffs[0], 0.0, 0.0)
    for number, (onset, following) in enumerate(zip(event.puffs, (*event.puffs[1:], event.duration), strict=True)):
        if not 0 <= onset < following:
            raise ScoreError(
                f"event {event.id!r}: puffs[{number}]={plain(onset)} must be at least 0 and before "
                f"{'the next' if number < n - 1 else 'its end'}, {plain(following)} s"
            )
        yield Stroke(onset, onset + PUFF_SHARE * (following - onset), number / n, (number + 1) / n)


class Sounding(NamedTuple):
    """A noise that is heard once; s from its event's onset."""

    onset: float
    attack: float
    hold: float
    release: float

    @property
    def end(self) -> float:
        """When it is over, s from the event's onset."""
        return self.onset + self.attack + self.hold + self.release


def soundings_of(event: VolumeEvent) -> tuple[Sounding, ...]:
    """When an event's noise is heard: once; in each of several gasps, made so much shorter; or from each puff's onset.

    Raises:
        ScoreError: The noise is longer than its breath, or goes on after it; puffs as in `strokes_of`.
    """
    noise = event.noise
    if noise is None:
        return ()
    scale = 1.0 / event.saccades if isinstance(event, Inspiration) else 1.0
    found = tuple(
        Sounding(stroke.onset + scale * noise.onset, scale * noise.attack, scale * noise.hold, scale * noise.release)
        for stroke in strokes_of(event)
        if stroke.end_share > stroke.begin_share
    )
    if found[-1].end > event.duration + 2 * TOUCH:
        raise ScoreError(_too_long(event, noise))
    return found


def _too_long(event: VolumeEvent, noise: Noise) -> str:
    last = f" after the last puff, {plain(event.puffs[-1])} s," if isinstance(event, Expiration) and event.puffs else ""
    return (
        f"event {event.id!r}: noise onset={noise.onset:g}, duration={noise.duration:g}{last} must lie within its "
        f"{event.duration:g} s"
    )


def peak_flow(event: VolumeEvent, person: Person) -> float:
    """The highest flow of an event, + in and - out.

    Args:
        event: Lasts longer than 0 s.
        person: Whose vital capacity it is a fraction of.

    Returns:
        L/s; `airflow` reaches it and never exceeds it.
    """
    if isinstance(event, Hold):
        return 0.0
    moved = (event.to_volume - event.from_volume) * person.vital_capacity
    steepest = max((s.end_share - s.begin_share) / (s.end - s.onset) for s in strokes_of(event))
    return moved * steepest * shapes.HIGHEST_FLOW[event.profile]


@dataclass(frozen=True, slots=True, kw_only=True)
class Strokes:
    """All strokes of a track's events, in order of time."""

    first: Index
    """(events,) where each event's strokes begin"""
    count: Index
    """(events,) how many there are"""
    onset: Array
    """(n,) s"""
    end: Array
    """(n,) s"""
    begin_share: Array
    """(n,) of the event's volume, moved before"""
    end_share: Array
    """(n,) moved afterwards"""
    profile: Index
    """(events,) number in `WAYS`"""
    profiles: tuple[int, ...]
    """those there are"""
    peak: Array
    """(events,) 0..1"""

    def at(self, event: Index, times: Array) -> tuple[Index, Array]:
        """The stroke begun last within each time's event, and how much of its time has passed (0..1)."""
        index = event
        if len(self.onset) > len(self.first):
            found = np.searchsorted(self.onset, times, side="right") - 1
            index = np.clip(found, self.first[event], self.first[event] + self.count[event] - 1)
        start = self.onset[index]
        return index, np.clip((times - start) / (self.end[index] - start), 0.0, 1.0)

    def moved(self, event: Index, stroke: Index, progress: Array) -> Array:
        """Share of the event's volume that has moved, 0..1."""
        begin = self.begin_share[stroke]
        return begin + (self.end_share[stroke] - begin) * self._each(event, progress, flow=False)

    def flow(self, change: Array, event: Index, stroke: Index, progress: Array) -> Array:
        """Derivative of `change * moved`, 1/s; 0 once a stroke has ended.

        Args:
            change: How much each time's whole event moves.
            event: See `at`.
            stroke: See `at`.
            progress: See `at`.
        """
        share = self.end_share[stroke] - self.begin_share[stroke]
        mean = change * share / (self.end[stroke] - self.onset[stroke])
        return np.where(progress < 1.0, mean * self._each(event, progress, flow=True), 0.0)

    def _each(self, event: Index, progress: Array, *, flow: bool) -> Array:
        """Share of a stroke's own volume that has moved, or its flow relative to the mean."""
        profile, peak = self.profile[event], self.peak[event]
        value = np.empty(progress.shape)
        for number in self.profiles:
            way, own = WAYS[_NAMES[number]], profile == number
            value[own] = (way.flow if flow else way.volume)(progress[own], peak[own])
        return value


def strokes(track: Track[VolumeEvent]) -> Strokes:
    """Gather the strokes of some events.

    Raises:
        ScoreError: Laugh puffs do not ascend, or begin outside their event.
    """
    parts = [strokes_of(event) for event in track.events]
    count = np.array([len(part) for part in parts], dtype=np.intp)
    owner = np.repeat(np.arange(len(parts)), count)
    table = np.array([stroke for part in parts for stroke in part], dtype=np.float64).reshape(-1, 4)
    to_the_end = table[:, 1] == track.column(lambda e: e.duration)[owner]
    profile = [_NAMES.index(getattr(event, "profile", "linear")) for event in track.events]
    return Strokes(
        first=np.cumsum(count) - count,
        count=count,
        onset=track.start[owner] + table[:, 0],
        end=np.where(to_the_end, track.end[owner], track.start[owner] + table[:, 1]),
        begin_share=np.ascontiguousarray(table[:, 2]),
        end_share=np.ascontiguousarray(table[:, 3]),
        profile=np.array(profile, dtype=np.intp),
        profiles=tuple(sorted(set(profile))),
        peak=track.column(lambda e: getattr(e, "peak", 0.5)),
    )
