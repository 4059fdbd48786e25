"""The lungs' volume and what it moves: chest, belly, shoulders, neck."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.curves.tracks import Array, Index, Mask, Track, track
from scorebreath.equations import shapes
from scorebreath.score.document import Person, Score
from scorebreath.score.events import EVENTS, Expiration, Hold, Inspiration

VolumeEvent = Inspiration | Expiration | Hold
LEAD = EVENTS[Inspiration.type][1].lead
"""s; how long before its onset an inspiration may change anything"""
FACTORS = ("thorax_share", "thorax", "abdomen", "shoulder", "neck_pitch")
"""What the volume above rest is multiplied by, in the columns of `Breathing.factors`."""


@dataclass(frozen=True, slots=True)
class Breathing:
    """The volume events of one body, as arrays."""

    person: Person
    track: Track[VolumeEvent]
    from_volume: Array
    """(n,) fraction of VC"""
    to_volume: Array
    """(n,) fraction of VC"""
    sine: Mask
    """(n,) whether flow is a half sine instead of constant"""
    factors: Array
    """(n, 5) see FACTORS"""
    inspirations: Index
    """(m,) which events are inspirations"""
    reach: int
    """the most inspirations that begin within one LEAD"""

    def locate(self, times: Array) -> tuple[Index, Mask, Array]:
        """Index of the event under way, whether there is one, and how much of its time has passed (0..1)."""
        index, active = self.track.at(times)
        if not self.track.events:
            return index, active, np.zeros(times.shape)
        start = self.track.start[index]
        return index, active, np.clip((times - start) / (self.track.end[index] - start), 0.0, 1.0)

    def volume(self, index: Index, active: Mask, progress: Array) -> Array:
        """Fraction of VC above residual volume; the resting volume where no event is under way (X15)."""
        if not self.track.events:
            return np.full(progress.shape, self.person.resting_volume)
        moved = np.where(self.sine[index], shapes.half_sine_volume(progress), progress)
        begin = self.from_volume[index]
        return np.where(active, begin + (self.to_volume[index] - begin) * moved, self.person.resting_volume)

    def flow(self, index: Index, active: Mask, progress: Array) -> Array:
        """Derivative of `volume`, fractions of VC a second; where two events touch, the later one's."""
        if not self.track.events:
            return np.zeros(progress.shape)
        relative = np.where(self.sine[index], shapes.half_sine_flow(progress), 1.0)
        seconds = self.track.end[index] - self.track.start[index]
        flow = (self.to_volume[index] - self.from_volume[index]) / seconds * relative
        return np.where(active & (progress < 1.0), flow, 0.0)

    def factor(self, name: str, times: Array, index: Index) -> Array:
        """A factor of FACTORS at each time.

        Each event has its own, constant. Where an inspiration's differ from those before it, they cross-fade over
        the LEAD before its onset, when little is left above the resting volume: no step, and no reach beyond its own.
        """
        if not self.track.events:
            return np.zeros(times.shape)
        column = self.factors[:, FACTORS.index(name)]
        value = column[index]
        if np.all(column == column[0]):
            return value
        following = np.searchsorted(self.track.start[self.inspirations], times, side="right")
        for _ in range(self.reach):
            coming = self.inspirations[np.minimum(following, len(self.inspirations) - 1)]
            ahead = np.where(following < len(self.inspirations), self.track.start[coming] - times, LEAD)
            value = value + (column[coming] - value) * np.clip(1.0 - ahead / LEAD, 0.0, 1.0)
            following = following + 1
        return value


def breathing(score: Score, body: str, person: Person) -> Breathing:
    """Gather the volume events of one body.

    Raises:
        ScoreError: Two of them overlap.
    """
    events: Track[VolumeEvent] = track(
        [e for e in score.events if isinstance(e, Inspiration | Expiration | Hold) and e.body == body], "breaths"
    )
    inspirations = np.flatnonzero([isinstance(event, Inspiration) for event in events.events])
    onsets = events.start[inspirations]
    within = np.searchsorted(onsets, onsets + LEAD, side="right") - np.arange(len(onsets))
    return Breathing(
        person=person,
        track=events,
        from_volume=events.column(lambda e: e.volume if isinstance(e, Hold) else e.from_volume),
        to_volume=events.column(lambda e: e.volume if isinstance(e, Hold) else e.to_volume),
        sine=np.array([not isinstance(e, Hold) and e.profile == "sine" for e in events.events], dtype=np.bool_),
        factors=np.array(
            [(e.thorax_share, *(getattr(e.motion, name) for name in FACTORS[1:])) for e in events.events]
        ).reshape(-1, len(FACTORS)),
        inspirations=inspirations,
        reach=int(within.max(initial=0)),
    )
