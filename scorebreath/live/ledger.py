"""The ledger: everything that has been decided, in the order in which it was; it only ever grows.

What is decided is written before anybody can see it: nothing that was seen is missing in a take that was killed.

Curves are made of what matters around now: events have a finite reach, so a window of them gives the very values that
the whole performance gives.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from dataclasses import replace

from scorebreath.curves import recent
from scorebreath.curves.curve_set import CurveSet, curves
from scorebreath.score.cutting import endings
from scorebreath.score.document import Body, Group, MediaInfo, Score
from scorebreath.score.events import EVENTS, Cut, Event, Expiration, Hold, Inspiration, Parameter
from scorebreath.score.take import TakeWriter, lasting, read_take
from scorebreath.score.values import LARGEST

ASKED = 4.0
"""s behind now for which curves can still be asked."""
KEPT = ASKED + recent.KEPT
"""s behind now for which events are kept: what was moved by a cut takes its time to settle."""
MOST = 20_000
"""Events that are in memory where there is a take: an hour or so."""
WIDEST = max(reach.lag for _, reach in EVENTS.values())
"""s that an event reaches behind its end, at most."""


class Ledger:
    """A Score that grows. One thread writes; any may read.

    Args:
        score: All that is known at the start: no groups, no events.
        take: Where everything is written as it happens; None: nowhere.
    """

    def __init__(self, score: Score, take: TakeWriter | None = None) -> None:
        """Nothing has happened."""
        self._score = score
        self._take = take
        self._lock = threading.Lock()
        self._text = ""
        self._bodies = {body.id: body for body in score.bodies}
        self._media: dict[str, MediaInfo] = dict(score.media)
        self._groups: dict[str, Group] = {}
        self._events: list[Event] = []
        self._names: set[str] = set()
        self._let_go = False
        self._near: dict[str, list[Event]] = {body: [] for body in self._bodies}
        self._curves: dict[str, CurveSet] = {}
        self._version = 0
        self.over: float | None = None
        """s when all is over; None: nobody knows"""

    @property
    def bodies(self) -> Mapping[str, Body]:
        """Who is there."""
        return dict(self._bodies)

    @property
    def groups(self) -> Mapping[str, Group]:
        """Those that are said."""
        return self._groups

    @property
    def media(self) -> Mapping[str, MediaInfo]:
        """What has been put into the media."""
        return dict(self._media)

    def text(self, piece: str) -> None:
        """The text goes on."""
        if self._take:
            self._take.text(piece)
        with self._lock:
            self._text += piece

    def body(self, body: Body) -> None:
        """Somebody joins."""
        if self._take:
            self._take.body(body)
        with self._lock:
            self._bodies[body.id] = body
            self._near[body.id] = []

    def group(self, group: Group, media: Mapping[str, MediaInfo]) -> None:
        """A breath group is said, with these media."""
        self.media_used(media)
        if self._take:
            self._take.group(group)
        with self._lock:
            self._groups[group.id] = group

    def media_used(self, media: Mapping[str, MediaInfo]) -> None:
        """These media sound."""
        new = {name: info for name, info in media.items() if name not in self._media}
        if self._take:
            for name, info in new.items():
                self._take.sound(name, info)
        with self._lock:
            self._media |= new

    def events(self, events: Iterable[Event], now: float) -> list[Event]:
        """Events have been decided; as they are written: an id that is taken gets a number.

        Args:
            events: In any order.
            now: s.
        """
        written = []
        for event in events:
            named = event if event.id not in self._names else replace(event, id=self._fresh(event.id))
            self._names.add(named.id)
            written.append(named)
        if self._take and written:
            self._take.events(written)
        with self._lock:
            self._events += written
            for event in written:
                self._near[event.body].append(event)
            self._version += 1
            for body in {event.body for event in written}:
                self._near[body] = _window(self._near[body], now - KEPT)
                self._curves.pop(body, None)
            if self._take and len(self._events) > MOST:
                self._events, self._let_go = self._events[-MOST // 2 :], True
        return written

    def end(self, time: float) -> None:
        """All is over then."""
        self._over(time)

    def go_on(self) -> None:
        """It is not over then."""
        self._over(None)

    def _over(self, time: float | None) -> None:
        if self._take:
            self._take.over(time)
        with self._lock:
            self.over = time
            self._version += 1
            self._curves.clear()

    def near(self, body: str) -> list[Event]:
        """A body's events that are not long over."""
        return list(self._near[body])

    def curves(self, body: str) -> CurveSet:
        """The curves of a body around now: from `ASKED` seconds ago up to where everything is decided."""
        with self._lock:
            if body in self._curves:
                return self._curves[body]
            part, version = self._part(body, self._near[body]), self._version
        made = curves(part, body)  # takes some milliseconds in which events may come
        with self._lock:
            if version == self._version:
                self._curves[body] = made
        return made

    def all_curves(self) -> dict[str, CurveSet]:
        """Those of everybody."""
        return {body: self.curves(body) for body in self._bodies}

    def part(self, body: str, events: Iterable[Event]) -> Score:
        """A Score of a few events of one body, with all that they name."""
        with self._lock:
            return self._part(body, events)

    def score(self) -> Score:
        """The whole performance so far; of a long one, as its take has it."""
        with self._lock:
            if self._take is not None and self._let_go:
                return read_take(self._take.media.folder)
            return replace(
                self._score, text=self._text, bodies=tuple(self._bodies.values()), media=dict(self._media),
                groups=tuple(self._groups.values()), events=tuple(self._events),
                duration=lasting(self._events) if self.over is None else self.over,
            )  # fmt: skip

    def _part(self, body: str, events: Iterable[Event]) -> Score:
        some = tuple(events)
        named = {getattr(event, "media", None) for event in some}
        noises = (getattr(event, "noise", None) for event in some)
        named |= {source for noise in noises if noise for source in (noise.source, noise.source_nose)}
        groups = {event.group for event in some if event.group}
        return replace(
            self._score, text=self._text, duration=LARGEST if self.over is None else self.over,
            bodies=(self._bodies[body],), media={name: self._media[name] for name in named if name in self._media},
            groups=tuple(self._groups[name] for name in sorted(groups) if name in self._groups), events=some,
        )  # fmt: skip

    def _fresh(self, name: str) -> str:
        number = 2
        while f"{name}~{number}" in self._names:
            number += 1
        return f"{name}~{number}"


def _window(events: list[Event], since: float) -> list[Event]:
    """Those that reach behind a time, and what is still in force there; in their order, with the cuts that end them."""
    ends = endings(events)
    breaths = (e for e in events if e.onset < since and isinstance(e, Inspiration | Expiration | Hold))
    begun = (event for event in breaths if event.id not in ends or not ends[event.id].prevents(event))
    last = max(begun, key=lambda event: event.onset, default=None)
    near = {event.id for event in (*_moves(events, since), last) if event is not None}
    near |= {e.id for e in events if not isinstance(e, Cut) and e.end + WIDEST >= since}
    kept: list[Event] = []
    for event in events:
        if event.id in near:
            kept.append(event)
        elif isinstance(event, Cut) and (targets := tuple(name for name in event.targets if name in near)):
            kept.append(event if len(targets) == len(event.targets) else replace(event, targets=targets))
    return kept


def _moves(events: list[Event], since: float) -> list[Parameter]:
    """Those whose sound is heard from a time on: a glide begins where the one before it has come to."""
    moves = sorted((e for e in events if isinstance(e, Parameter) and e.heard), key=lambda event: event.onset)
    first = sum(move.onset < since for move in moves) - 1
    while first > 0 and moves[first - 1].onset + moves[first - 1].glide > moves[first].onset:
        first -= 1
    return moves[max(0, first - 1) :]
