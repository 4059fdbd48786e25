"""A body's time divided by its cuts: in each part the events that were known then, and hold.

A cut changes nothing before its own time. So until then everything goes on as if it did not come: what would have been
said is seen coming, and what is done in its place is not. From the cut on, what it ended is gone, its targets are as
if they had ended there or had never been, and what is seen goes on from where it was (`settling`). Air goes on at
once: the next breath begins at the cut, from the volume that there is; where none does, the breath is held.

A cut knows what stands before it in the Score (a performance only ever appends), and what it ends.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise
from math import inf
from typing import NamedTuple

from scorebreath.curves.tracks import E
from scorebreath.score.cutting import Ending, beginning, endings
from scorebreath.score.document import Score
from scorebreath.score.events import EVENTS, Cut, Event, Utterance
from scorebreath.units import snap

REACH = 2 * max(max(reach.lead, reach.lag) for _, reach in EVENTS.values())
"""s around an epoch within which events are kept; twice as far as they reach."""


@dataclass(frozen=True, slots=True)
class Known:
    """Some events of a Score, in its order."""

    events: tuple[Event, ...]

    def of(self, kind: type[E], body: str | None = None) -> Iterator[E]:
        """Events of one type, of one body or of all."""
        return (e for e in self.events if isinstance(e, kind) and (body is None or e.body == body))


class Barrier(NamedTuple):
    """A cut that ended something when it was told."""

    time: float
    """s"""
    until: float
    """s; when other cuts, told later, have left nothing of it; else its time"""
    place: int
    """among the Score's events"""
    targets: frozenset[str]

    def hides(self, place: int, name: str) -> bool:
        """Whether it does not know an event that would begin behind it."""
        return place > self.place and name not in self.targets


@dataclass(frozen=True, slots=True, kw_only=True)
class Epochs:
    """The parts that cuts divide a body's time into."""

    cuts: tuple[float, ...]
    """s, ascending: where an epoch ends and the next one begins"""
    known: tuple[Known, ...]
    """one more"""

    def window(self, number: int) -> tuple[float, float]:
        """From when to when an epoch is: from its cut until before the next one, s."""
        begin = self.cuts[number - 1] if number else -inf
        return begin, self.cuts[number] if number < len(self.cuts) else inf


def barriers(score: Score, body: str) -> list[Barrier]:
    """The cuts of a body that matter, in order of their times."""
    cuts = [(place, e) for place, e in enumerate(score.events) if isinstance(e, Cut) and e.body == body]
    if not cuts:
        return []
    own = {event.id: snap(event.end) for event in score.events}
    final = endings(cut for _, cut in cuts)
    told: dict[str, float] = {}
    found: list[Barrier] = []
    for place, cut in cuts:
        ended = [name for name in cut.targets if min(own[name], told.get(name, own[name])) > cut.onset]
        if ended:
            until = max(final[name].time for name in ended)
            found.append(Barrier(cut.onset, until, place, frozenset(cut.targets)))
        told.update(dict.fromkeys(ended, cut.onset))
    return sorted(found)


def epochs(score: Score, body: str, cuts: Sequence[Barrier]) -> Epochs:
    """Divide a body's time, in time linear in events and cuts, as far as events do not last over many cuts.

    Args:
        score: Whose.
        body: Which.
        cuts: Its barriers.
    """
    times = sorted({cut.time for cut in cuts if cut.until == cut.time})
    walls = [cut.time for cut in cuts]
    ends = endings(score.events)
    told = {name: cut.place for cut in reversed(cuts) for name in cut.targets}  # the earliest cut counts
    newest = [-1]  # place of the newest cut until each epoch
    for _, group in groupby((cut for cut in cuts if cut.until == cut.time), key=lambda cut: cut.time):
        newest.append(max(newest[-1], *(cut.place for cut in group)))
    parts: list[list[Event]] = [[] for _ in range(len(times) + 1)]
    for place, event in enumerate(score.events):
        if event.body != body or isinstance(event, Cut):
            continue
        ending = ends.get(event.id)
        first = bisect_left(times, event.onset - REACH)
        last = bisect_right(times, snap(event.end) + REACH)
        stop = len(times) if ending is None else bisect_left(times, ending.time)  # the last epoch before it is cut
        begun = bisect_right(walls, event.onset)
        for number in range(first, min(last, stop) + 1):
            begin = times[number - 1] if number else -inf
            if ending is not None and ending.prevents(event) and newest[number] > told.get(event.id, len(score.events)):
                continue  # that it never happens was known when this epoch's cut was told
            ahead = cuts[bisect_right(walls, begin) : begun]
            if not any(cut.until > begin and cut.hides(place, event.id) for cut in ahead):
                parts[number].append(event)
        if ending is not None and not ending.prevents(event):
            left = _left(event, ending)
            if left is not None:
                behind = bisect_right(times, max(snap(left.end), ending.time) + REACH)
                for number in range(stop + 1, behind + 1):
                    parts[number].append(left)
    known = [Known(_apart(part, ends, begin)) for part, begin in zip(parts, [-inf, *times], strict=True)]
    return Epochs(cuts=tuple(times), known=tuple(known))


def _left(event: Event, ending: Ending) -> Event | None:
    """What is left of an event behind its cut: what had ended by itself, and lips go on while a voice fades out."""
    if not ending.shortens(event):
        return event
    return beginning(event, ending.time + ending.fade) if isinstance(event, Utterance) else None


def _apart(events: Sequence[Event], ends: Mapping[str, Ending], begin: float) -> tuple[Event, ...]:
    """What has been said and fades out stops where the next utterance begins."""
    said = sorted((e for e in events if isinstance(e, Utterance)), key=lambda e: (e.onset, e.end))
    late = {
        one.id: beginning(one, two.onset)
        for one, two in pairwise(said)
        if one.onset < two.onset < snap(one.end) and one.id in ends and ends[one.id].time <= begin
    }
    return tuple(late.get(event.id, event) for event in events) if late else tuple(events)
