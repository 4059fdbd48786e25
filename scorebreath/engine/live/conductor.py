"""Which bundle an engine gets when: everything waits here until its time is near, and nothing is sent for the past.

No threads and no clock of its own: whoever has them calls `pump`. It keeps what is to come, so it
changes.
"""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace

from scorebreath.engine.live import orders
from scorebreath.engine.live.journal import Entry, Journal, What
from scorebreath.engine.live.layout import BODIES, Layout
from scorebreath.engine.live.orders import Mix
from scorebreath.engine.live.tally import Tally
from scorebreath.engine.live.timing import AT_ONCE, LiveClock
from scorebreath.engine.moves import Move, Ratios
from scorebreath.engine.onsets import Onset, left_of, numbered
from scorebreath.engine.osc import message
from scorebreath.engine.play import KEEP, cut_controls, told_of_cut
from scorebreath.errors import EngineError
from scorebreath.score.cutting import Ending
from scorebreath.score.performing import Heard
from scorebreath_synthdefs.catalogue import SPEECH

MARGIN = 0.02
"""s from now: nothing is sent for earlier."""
CUT_MARGIN = 0.03
"""s that an engine needs to know of a cut, whatever its blocks and rate."""
_GRAIN = 1e-5  # s that times as floats since 1970 are right to, and more
_REMEMBERED = 600.0  # s that a cut waits for sounds that it prevents

Send = Callable[[int, Sequence[bytes]], None]
"""Gives the engine messages for a time tag."""


@dataclass(slots=True, eq=False)
class Played:
    """A sound on its way."""

    sound: Onset
    buffer: int | None = None
    file: str = ""
    """what its buffer holds"""
    node: int | None = None
    """once the engine knows it"""


@dataclass(order=True, slots=True)
class _Item:
    send_at: float
    order: int
    do: Callable[[float], None] = field(compare=False)
    played: Played | None = field(compare=False, default=None)


class Conductor:
    """Keeps what is to come and sends it in time.

    Args:
        clock: Seconds to tags.
        layout: Which of the engine's numbers are ours.
        mix: How sounds leave the engine.
        send: Gives the engine a bundle.
        now: The Unix time.
        lookahead: Seconds before its time that a bundle is sent.
        journal: Told of every bundle.
        dropped: Told of sounds whose buffer is no longer needed.
        lost: Told of sounds that are never heard, or not to their end.
    """

    def __init__(
        self,
        *,
        clock: LiveClock,
        layout: Layout,
        mix: Mix,
        send: Send,
        now: Callable[[], float],
        lookahead: float,
        journal: Journal | None = None,
        dropped: Callable[[Played], None] = lambda _: None,
        lost: Callable[[Onset], None] = lambda _: None,
    ) -> None:
        """Begin with nothing to do."""
        self.clock, self.layout, self.mix, self.lookahead = clock, layout, mix, lookahead
        self.alive = True
        """whether there is an engine; while there is none, what comes due is lost"""
        self.tally = Tally()
        self.ratios = Ratios()
        self._send, self._now, self._journal, self._dropped = send, now, journal, dropped
        self._lost = lost
        self._heap: list[_Item] = []
        self._order, self._nodes = itertools.count(), itertools.count()
        self._noises = 0
        self._here: list[Played] = []
        self._endings: dict[str, Ending] = {}
        self._bodies: dict[str, int] = {}
        self._pans = dict(mix.pans)

    @property
    def waiting(self) -> int:
        """Sounds that are still to be sent."""
        return sum(played.node is None for played in self._here)

    @property
    def here(self) -> Sequence[Played]:
        """Sounds that are to come, or that sound."""
        return tuple(self._here)

    def play(self, played: Played) -> None:
        """A sound whose media are loaded; cuts that were told before hold for it."""
        (sound,) = numbered([played.sound], self._noises)
        self._noises += "seed" in sound.controls
        left = left_of(sound, self._endings.get(sound.event))
        if left is None:
            self._dropped(played)
            return
        played.sound = left
        self._here.append(played)
        self._at(left.time - self.lookahead, lambda now: self._begin(played, now), played)

    def cut(self, time: float, targets: Iterable[str], fade: float) -> None:
        """Sounds of some events end."""
        for target in targets:
            ending = Ending(time=time, fade=fade)
            known = self._endings.get(target)
            if known is not None and known <= ending:
                continue
            self._endings[target] = ending
            for played in [one for one in self._here if one.sound.event == target]:
                self._cut(played, ending)
        self._at(time + _REMEMBERED, self._forget)

    def move(self, time: float, body: str, heard: Heard, glide: float) -> None:
        """Ratios of a body go somewhere."""
        move = self.ratios.move(time=time, body=body, heard=heard, glide=glide)
        self._at(time - self.lookahead, lambda now: self._move(move, now))

    def pan(self, body: str, pan: float) -> None:
        """A body goes somewhere else, now."""
        self._pans[body] = pan
        number = self.body(body)
        if self.alive:
            self._send(AT_ONCE, [orders.controls(self.layout.place(number), {"pan": pan})])

    def body(self, name: str) -> int:
        """Number of a body, who enters if it was not there.

        Raises:
            EngineError: There are too many.
        """
        if name not in self._bodies:
            if len(self._bodies) >= BODIES:
                raise EngineError(f"more than {BODIES} bodies cannot sound at once")
            self._bodies[name] = len(self._bodies)
            if self.alive:
                self._enter(name)
        return self._bodies[name]

    def hush(self, fade: float) -> None:
        """What sounds fades out now, and what waits is dropped; what comes later is not touched."""
        ending = Ending(time=self.clock.seconds(self._now()) + MARGIN + CUT_MARGIN, fade=fade)
        for played in self.here:
            self._cut(played, ending)

    def panic(self) -> None:
        """Silence, and nothing more."""
        waiting, self._heap = self._heap, []
        self._heap = [one for one in waiting if one.played is None]  # moves and what is forgotten later
        heapq.heapify(self._heap)
        if self.alive:
            self._send(AT_ONCE, [message("/g_freeAll", self.layout.sounds)])
        now = self.clock.seconds(self._now())
        for played in self._here:
            if played.node is not None and played.sound.time > now - self.lookahead:
                self._free(played, now)
            self._dropped(played)
        self._here.clear()

    def pump(self, unix: float) -> float | None:
        """Send what is due.

        Args:
            unix: The time.

        Returns:
            Unix time at which to come again; None: when something new is told.
        """
        now = self.clock.seconds(unix)
        while self._heap and self._heap[0].send_at <= now + _GRAIN:
            heapq.heappop(self._heap).do(now)
        return self.clock.start + self._heap[0].send_at if self._heap else None

    def engine_ended(self, unix: float) -> None:
        """The engine is away: what sounds is lost, what it had been told but had not begun waits again."""
        self.alive = False
        now = self.clock.seconds(unix)
        for played in self._here:
            if played.node is None:
                continue
            played.node = None
            if played.sound.time > now:
                self._at(played.sound.time - self.lookahead, _again(self._begin, played), played)
            elif played.sound.end > now:
                self._lose(played.sound)

    def engine_began(self, layout: Layout, sample_rate: int) -> None:
        """There is an engine without anything of ours: set the stage again, with ratios as they are."""
        self.layout = layout
        self.clock = replace(self.clock, sample_rate=sample_rate)
        self.alive = True
        self._send(AT_ONCE, tuple(orders.stage(layout, self.mix)))
        for name in self._bodies:
            self._enter(name)

    def _enter(self, name: str) -> None:
        heard = self.ratios.at(name, self.clock.seconds(self._now()))
        number, pan = self._bodies[name], self._pans.get(name, 0.0)
        self._send(AT_ONCE, tuple(orders.body(self.layout, number, pan, heard)))

    def _at(self, time: float, do: Callable[[float], None], played: Played | None = None) -> None:
        heapq.heappush(self._heap, _Item(time, next(self._order), do, played))

    def _begin(self, played: Played, now: float) -> None:
        if played not in self._here or played.node is not None:
            return
        sound = played.sound
        earliest = now + MARGIN
        useful = sound.time >= earliest - _GRAIN or (sound.instrument == SPEECH and sound.end > earliest)
        if not self.alive or not useful:
            self._lose(sound)
            self._leave(played)
            return
        late = max(0.0, earliest - sound.time)
        if late > _GRAIN:
            self.tally.late_sent += 1
            sound = played.sound = _later(sound, late)
        played.node = self.layout.node(next(self._nodes))
        made = orders.sound(sound, played.node, self.layout, self.body(sound.body), played.buffer)
        self._bundle("sound", sound.time, [made], sound.event, now, instrument=sound.instrument, late=late)
        if sound.cut is not None:
            self._tell_of_cut(played)
        self._at(sound.end + KEEP, lambda now: self._is_over(played, now))

    def _cut(self, played: Played, ending: Ending) -> None:
        """A cut of a sound that is here."""
        left = left_of(played.sound, ending)
        now = self.clock.seconds(self._now())
        if left is None:
            if played.node is not None and played.sound.time <= now + MARGIN:  # it has begun, or is about to
                left = replace(played.sound, cut=Ending(time=max(played.sound.time, ending.time), fade=ending.fade))
            else:
                if played.node is not None:
                    self._free(played, now)
                self._leave(played)
                return
        if left is not played.sound:
            played.sound = left
            if played.node is not None:
                self._tell_of_cut(played)

    def _tell_of_cut(self, played: Played) -> None:
        told = told_of_cut(played.sound)
        self._at(told - self.lookahead, lambda now: self._end(played, now))

    def _end(self, played: Played, now: float) -> None:
        sound = played.sound
        if played not in self._here or played.node is None or sound.cut is None or not self.alive:
            return
        told, wanted = told_of_cut(sound), sound.cut.time
        at = max(told, now + MARGIN)
        begins = wanted if at <= told else max(wanted, at + CUT_MARGIN - MARGIN)
        if begins > wanted:
            self.tally.late_sent += 1
            sound = played.sound = replace(sound, cut=replace(sound.cut, time=begins))
        said = orders.controls(played.node, cut_controls(sound))
        self._bundle("cut", at, [said], sound.event, now, late=begins - wanted)

    def _free(self, played: Played, now: float) -> None:
        """Take back a sound that the engine knows of, at the moment at which it would begin."""
        assert played.node is not None
        at = max(played.sound.time, now + MARGIN)
        self._bundle("free", at, [message("/n_free", played.node)], played.sound.event, now)

    def _move(self, move: Move, now: float) -> None:
        if not self.alive:
            return  # whoever comes back begins with the ratios in force
        at = max(move.time, now + MARGIN)
        if at > move.time:
            self.tally.late_sent += 1
        made = orders.mover(move, self.layout.node(next(self._nodes)), self.layout, self.body(move.body))
        self._bundle("move", at, [made], move.body, now, late=at - move.time)

    def _is_over(self, played: Played, now: float) -> None:
        over = played.sound.end + KEEP
        if now < over - _GRAIN:  # it was told again, and later
            self._at(over, lambda now: self._is_over(played, now))
        else:
            self._leave(played)

    def _lose(self, sound: Onset) -> None:
        self.tally.lost += 1
        self._lost(sound)

    def _leave(self, played: Played) -> None:
        """It is over, or never will be."""
        if played in self._here:
            self._here.remove(played)
            self._dropped(played)

    def _forget(self, now: float) -> None:
        self._endings = {event: one for event, one in self._endings.items() if one.time > now - _REMEMBERED}

    def _bundle(
        self, kind: What, time: float, messages: Sequence[bytes], event: str, now: float,
        *, instrument: str = "", late: float = 0.0,
    ) -> None:  # fmt: skip
        if not self.alive:
            return
        tag = self.clock.tag(time)
        self._send(tag, messages)
        self.tally.bundle(time - now, sound=kind == "sound")
        if self._journal is not None:
            self._journal(
                Entry(
                    kind=kind, event=event, instrument=instrument, time=time, frame=self.clock.frame(time), tag=tag,
                    lead=time - now, late=late,
                )
            )  # fmt: skip


def _again(begin: Callable[[Played, float], None], played: Played) -> Callable[[float], None]:
    return lambda now: begin(played, now)


def _later(sound: Onset, late: float) -> Onset:
    """The same sound, later; where a cut ends it, it ends all the same."""
    moved = replace(sound, time=sound.time + late)
    if sound.cut is None:
        return moved
    return replace(moved, duration=max(0.0, sound.duration - late))
