"""The lungs' volume and what it moves: chest, belly, shoulders, neck."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from scorebreath.curves.strokes import Strokes, VolumeEvent, strokes
from scorebreath.curves.tracks import Acts, Array, Index, Mask, Track, track
from scorebreath.score.document import Person
from scorebreath.score.events import EVENTS, Expiration, Hold, Inspiration

LEAD = EVENTS[Inspiration.type][1].lead
"""s; how long before its onset a breath may change anything"""
FACTORS = ("thorax_share", "thorax", "abdomen", "shoulder", "neck_pitch", "tremor")
"""What the volume above rest is multiplied by, in the columns of `Breathing.factors`."""
TREMOR_HZ = 7.5
"""How fast a frightened chest trembles: 6-9 Hz (physiology 4.2)."""


class Place(NamedTuple):
    """Where some times are among the events; each field is shaped like them."""

    event: Index
    """the event under way, 0 where there is none"""
    active: Mask
    """whether there is one"""
    stroke: Index
    """its stroke begun last"""
    progress: Array
    """how much of the stroke's time has passed, 0..1"""


@dataclass(frozen=True, slots=True)
class Breathing:
    """The volume events of one body, as arrays."""

    person: Person
    track: Track[VolumeEvent]
    from_volume: Array
    """(n,) fraction of VC"""
    to_volume: Array
    """(n,) fraction of VC"""
    strokes: Strokes
    factors: Array
    """(n, 6) see FACTORS"""
    turns: Index
    """(m,) which events bring factors: inspirations, and whatever has others than the event before it"""
    reach: int
    """the most turns that begin within one LEAD"""

    def locate(self, times: Array) -> Place:
        """The event and the stroke under way at each time."""
        event, active = self.track.at(times)
        if not self.track.events:
            return Place(event, active, event, np.zeros(times.shape))
        return Place(event, active, *self.strokes.at(event, times))

    def volume(self, at: Place) -> Array:
        """Fraction of VC above residual volume; the resting volume where no event is under way (X15)."""
        if not self.track.events:
            return np.full(at.progress.shape, self.person.resting_volume)
        begin = self.from_volume[at.event]
        moved = self.strokes.moved(at.event, at.stroke, at.progress)
        return np.where(at.active, begin + (self.to_volume[at.event] - begin) * moved, self.person.resting_volume)

    def flow(self, at: Place) -> Array:
        """Derivative of `volume`, fractions of VC a second; where two strokes touch, the later one's."""
        if not self.track.events:
            return np.zeros(at.progress.shape)
        change = self.to_volume[at.event] - self.from_volume[at.event]
        return np.where(at.active, self.strokes.flow(change, at.event, at.stroke, at.progress), 0.0)

    def factor(self, name: str, times: Array, index: Index) -> Array:
        """A factor of FACTORS at each time.

        Each event has its own, constant. Where they differ from those before it, they cross-fade over the LEAD before
        its onset; before an inspiration little is left above the resting volume then. No step, and no reach beyond the
        event's own.
        """
        if not self.track.events:
            return np.zeros(times.shape)
        column = self.factors[:, FACTORS.index(name)]
        value = column[index]
        if np.all(column == column[0]):
            return value
        following = np.searchsorted(self.track.start[self.turns], times, side="right")
        for _ in range(self.reach):
            coming = self.turns[np.minimum(following, len(self.turns) - 1)]
            ahead = np.where(following < len(self.turns), self.track.start[coming] - times, LEAD)
            value = value + (column[coming] - value) * np.clip(1.0 - ahead / LEAD, 0.0, 1.0)
            following = following + 1
        return value


def breathing(score: Acts, body: str, person: Person) -> Breathing:
    """Gather the volume events of one body.

    Raises:
        ScoreError: Two of them overlap.
    """
    events: Track[VolumeEvent] = track(
        [e for e in score.events if isinstance(e, Inspiration | Expiration | Hold) and e.body == body], "breaths"
    )
    factors = np.array([_factors(event) for event in events.events], dtype=np.float64).reshape(-1, len(FACTORS))
    brings = np.array([isinstance(event, Inspiration) for event in events.events], dtype=np.bool_)
    brings[1:] |= np.any(factors[1:] != factors[:-1], axis=1)
    turns = np.flatnonzero(brings)
    onsets = events.start[turns]
    within = np.searchsorted(onsets, onsets + LEAD, side="right") - np.arange(len(onsets))
    return Breathing(
        person=person,
        track=events,
        from_volume=events.column(lambda e: e.volume if isinstance(e, Hold) else e.from_volume),
        to_volume=events.column(lambda e: e.volume if isinstance(e, Hold) else e.to_volume),
        strokes=strokes(events),
        factors=factors,
        turns=turns,
        reach=int(within.max(initial=0)),
    )


def _factors(event: VolumeEvent) -> tuple[float, ...]:
    return (event.thorax_share, *(getattr(event.motion, name) for name in FACTORS[1:]))
