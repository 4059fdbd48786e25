"""A body's breathing as arrays: what every row of the table is measured from.

A breath group is what is said between one inspiration and the next (B52): the phones decide, not the planner's groups,
so a group that is said without a breath of its own belongs to the breath before it. Sniffs end no group.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.tracks import TOUCH
from scorebreath.report.norms.figures import Array, Circumstances
from scorebreath.report.norms.laws import Laws, laws
from scorebreath.report.norms.listening import Heard
from scorebreath.score.document import Body, Group, Score, Site
from scorebreath.score.events import Event, Hold, Inspiration, Pause, Utterance

Index = NDArray[np.intp]
Mask = NDArray[np.bool_]
SHORTEST_PAUSE = 0.05
"""s; a shorter silence between two phones is a closure."""


@dataclass(frozen=True, slots=True)
class Speech:
    """Every phone that sounds, in order of time, as arrays (p,)."""

    onset: Array
    """s"""
    end: Array
    """s"""
    group: NDArray[np.object_]
    """id of the planner's group, or None"""


@dataclass(frozen=True, slots=True)
class Boundary:
    """Between two breath groups."""

    site: Site
    place: tuple[int, int]
    """code points: where the last planner's group of one ends, where the first of the next begins"""


class Material:
    """What is measured, each part worked out when it is first asked for."""

    def __init__(self, score: Score, body: Body, curves: CurveSet, who: Circumstances, heard: Heard | None) -> None:
        """Take it in.

        Args:
            score: Any Score.
            body: Whose breathing.
            curves: The body's.
            who: What is known about the speaker.
            heard: What was measured in the sound, if there is any.
        """
        self.score, self.body, self.curves, self.who, self.heard = score, body, curves, who, heard
        sniffless = (event for event in score.of(Inspiration, body.id) if event.kind != "sniff" and event.duration > 0)
        self.inspirations = sorted(sniffless, key=lambda event: event.onset)
        self.breath_onset = np.array([event.onset for event in self.inspirations], dtype=np.float64)
        self.ti = np.array([event.duration for event in self.inspirations], dtype=np.float64)
        kinds = [event.kind for event in self.inspirations]
        self.for_speech: Mask = np.array([kind == "speech" for kind in kinds], dtype=np.bool_)
        self.tidal: Mask = np.array([kind == "tidal" for kind in kinds], dtype=np.bool_)

    @cached_property
    def speech(self) -> Speech:
        """All phones that sound; an utterance without any counts as one."""
        onset: list[float] = []
        end: list[float] = []
        group: list[str | None] = []
        for said in sorted(self.score.of(Utterance, self.body.id), key=lambda event: event.onset):
            spans = [(p.onset, p.onset + p.duration) for p in said.phones if p.ipa] or [(0.0, said.duration)]
            onset += [said.onset + start for start, _ in spans]
            end += [said.onset + stop for _, stop in spans]
            group += [said.group] * len(spans)
        return Speech(np.array(onset, dtype=np.float64), np.array(end, dtype=np.float64), np.array(group, dtype=object))

    @cached_property
    def first(self) -> Index:
        """(b,) index of each breath group's first phone."""
        owner = np.searchsorted(self.breath_onset, self.speech.onset, side="right")
        return np.flatnonzero(np.diff(owner, prepend=-1))

    @cached_property
    def breath(self) -> Index:
        """(b,) which inspiration each breath group is said on; -1 for speech before any."""
        return np.searchsorted(self.breath_onset, self.speech.onset[self.first], side="right") - 1

    @cached_property
    def start(self) -> Array:
        """(b,) s; first phone."""
        return self.speech.onset[self.first]

    @cached_property
    def end(self) -> Array:
        """(b,) s; end of the last phone."""
        return self._in_each(np.maximum, self.speech.end)

    @cached_property
    def on_speech_breath(self) -> Mask:
        """(b,) whether the group is said on an inspiration for speech, not on a gasp, a sigh, or none."""
        if not self.inspirations:
            return np.zeros(self.breath.shape, dtype=np.bool_)
        return np.asarray((self.breath >= 0) & self.for_speech[self.breath], dtype=np.bool_)

    @cached_property
    def syllables(self) -> Array:
        """(b,) as the planner counted them."""
        known = {group.id: float(group.syllables) for group in self.score.groups}
        speech = self.speech
        begins = np.ones(len(speech.group), dtype=np.bool_)
        begins[1:] = speech.group[1:] != speech.group[:-1]
        counted = np.zeros(len(speech.group))
        seen: set[str | None] = set()
        for index in np.flatnonzero(begins):  # a group whose speech is divided counts once
            name = speech.group[index]
            if name not in seen:
                seen.add(name)
                counted[index] = known.get(name, 0.0)
        return self._in_each(np.add, counted)

    @cached_property
    def gaps(self) -> tuple[Array, Array, Index]:
        """Silences inside breath groups: onset, s; length, s; breath group; (k,) each."""
        speech = self.speech
        length = speech.onset[1:] - speech.end[:-1]
        inside = np.ones(length.shape, dtype=np.bool_)
        inside[self.first[1:] - 1] = False
        found = np.flatnonzero(inside & (length >= SHORTEST_PAUSE - TOUCH))  # the same wherever it stands
        return speech.end[found], length[found], np.searchsorted(self.first, found, side="right") - 1

    @cached_property
    def asked(self) -> tuple[Array, Array]:
        """Onsets and ends of the silences that the markup asks for, s; (a,) each."""
        spans = [
            (event.onset, event.end) for event in self.score.events if event.body == self.body.id and _is_asked(event)
        ]
        table = np.array(sorted(spans), dtype=np.float64).reshape(-1, 2)
        return table[:, 0], table[:, 1]

    def free(self, start: Array, end: Array) -> Mask:
        """Whether nothing within each stretch of time was asked for; (n,)."""
        onsets, ends = self.asked
        if not onsets.size:
            return np.ones(start.shape, dtype=np.bool_)
        before = np.searchsorted(onsets, end, side="left")  # silences that have begun by then
        latest = np.concatenate(([-np.inf], np.maximum.accumulate(ends)))
        return np.asarray(latest[before] <= start, dtype=np.bool_)

    @cached_property
    def boundaries(self) -> list[Boundary | None]:
        """Where each breath but the first was taken; None at the text's end, or where no group tells."""
        known = {group.id: group for group in self.score.groups if group.body == self.body.id}
        speech = self.speech
        return [
            _boundary(known.get(speech.group[first - 1]), known.get(speech.group[first])) for first in self.first[1:]
        ]

    def cycles(self, which: Mask) -> tuple[Index, Array]:
        """Inspirations that another one follows: their index, and the time from the one to the other, s."""
        found = np.flatnonzero(which[:-1]) if len(which) else np.zeros(0, dtype=np.intp)
        length = np.diff(self.breath_onset)[found] if found.size else np.zeros(0)
        free = self.free(self.breath_onset[found], self.breath_onset[found] + length)
        return found[free], length[free]

    @cached_property
    def pauses(self) -> Index:
        """Breath groups that one inspiration, for speech, parts from the one before, with nothing asked for between."""
        after = np.arange(1, len(self.first))
        single = (np.diff(self.breath) == 1) & self.on_speech_breath[1:] & self.free(self.end[:-1], self.start[1:])
        return np.asarray(after[single], dtype=np.intp)

    @cached_property
    def levels(self) -> Array:
        """Lung volume at the first and last phone of each group that is said on a speech breath: (s, 2), % VC."""
        chosen = self.on_speech_breath
        times = np.concatenate((self.start[chosen], self.end[chosen]))
        return 100.0 * self.curves.sample(times, ["lung_volume"])[:, 0].reshape(2, -1).T

    @cached_property
    def laws(self) -> Laws | None:
        """What the curves do from frame to frame."""
        person = self.body.person
        return laws(self.curves, self.score.duration, person.resting_volume, person.vital_capacity)

    def _in_each(self, gather: np.ufunc, values: Array) -> Array:
        return np.asarray(gather.reduceat(values, self.first) if self.first.size else np.zeros(0), dtype=np.float64)


def _is_asked(event: Event) -> bool:
    return (isinstance(event, Pause) and event.kind == "asked") or (isinstance(event, Hold) and event.kind == "held")


def _boundary(last: Group | None, following: Group | None) -> Boundary | None:
    if last is None or following is None or last.cut.site == "text end":
        return None
    return Boundary(last.cut.site, (last.source[1], following.source[0]))
