"""The performance: decides, a moment before it happens, what everybody does; a Score that grows.

It knows no clock and no thread: whoever has one calls `advance` with the time, and is told when to call again. The
steps are those of `compile_text`: `Ensemble.step`, `express`; so a text that nobody touches becomes the events that it
becomes offline.

A group is decided `Timing.ahead` before it begins, or before what is said before it ends, for then its face begins to
know what follows. Where there is no group, bodies breathe at rest, and what is placed so far ahead that faces can live
with it is cut as soon as there is one.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import replace

from scorebreath.engine.onsets import onsets
from scorebreath.ensemble import BODY, Performer
from scorebreath.expression.interrupted import FACE
from scorebreath.expression.silence import LOOK_AHEAD
from scorebreath.live.backstage import Backstage
from scorebreath.live.company import Company, Turn
from scorebreath.live.conditions import Counts, Sounder, Timing, Told
from scorebreath.live.heard import AS_MADE
from scorebreath.live.interrupting import BREATHS, interrupt
from scorebreath.live.ledger import Ledger
from scorebreath.live.preparing import Prepared
from scorebreath.live.prompter import ALL, NOTHING, SENTENCES
from scorebreath.media.store import MediaStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import breath_media, group_of
from scorebreath.score.events import Blink, Cut, Emotion, Event, Parameter, WarningEvent
from scorebreath.script.marks import Mark
from scorebreath.units import snap

READY = 3
"""Groups that are ready before they are needed: one is next, one shows the face what follows, one is in reserve."""
SOON = 0.5
"""s before a group is due from which on an unfinished text is taken for it."""
GLANCE = 0.25
"""s after which it looks again, whatever happens."""
FADE = 0.1
"""s in which a breath at rest gives way."""
GENERATORS = 64.0


class Performance:
    """What happens, decided step by step.

    Args:
        company: Who performs.
        backstage: Where groups are prepared.
        ledger: Where everything is written.
        sounder: What sounds.
        media: Samples of what is said.
        timing: How far ahead.
        lead: s before the first breath.
        tail: s after the last body has come to rest.
        begun: Marks that put the first body into its states.
        tell: Told of what somebody should know.
    """

    def __init__(
        self,
        company: Company,
        backstage: Backstage,
        ledger: Ledger,
        sounder: Sounder,
        media: MediaStore,
        *,
        timing: Timing,
        lead: float = 0.5,
        tail: float = 1.0,
        begun: tuple[Mark, ...] = (),
        tell: Told = lambda _: None,
    ) -> None:
        """Begin: nothing sounds yet."""
        self.company, self.backstage, self.ledger = company, backstage, ledger
        self.timing, self.tell = timing, tell
        self.counts = Counts()
        self.now = -timing.ahead
        self.paused = self.ending = False
        self.over: float | None = None
        self.queue: deque[Prepared] = deque()
        self.generation = 0
        self.last: Turn | None = None
        """the group that was decided last"""
        self.silent = lead
        """s; when the last sound of what is decided is over"""
        self.resting: set[str] = set()
        """bodies that breathe at rest because nobody knew what follows"""
        self.made: dict[str, Parameters] = {}
        """by body: what its latest events were made with"""
        self.inbox: deque[Callable[[Performance], None]] = deque()
        self.fed = self.now
        """s; when text came last"""
        self._sounder, self._media, self._tail = sounder, media, tail
        self._heard = dict.fromkeys(ledger.bodies, AS_MADE)
        self._next: Turn | None = None
        self._late: float | None = None
        self._breaths = 0
        company.ensemble.begin(lead, begun)
        self.decide(company.drain())

    # -- time

    def advance(self, now: float) -> float:
        """Decide everything that must be decided now.

        Args:
            now: s; never less than the last time.

        Returns:
            When to call again at the latest, s; sooner if something comes in.
        """
        self.now = now
        while self.inbox:
            self.inbox.popleft()(self)
        self.backstage.want(READY - len(self.queue), self._flush())
        self._collect()
        if self.over is None:
            while self._decide_next():
                pass
            self._rest()
        self.backstage.want(READY - len(self.queue), self._flush())
        return self._wake()

    @property
    def line(self) -> float:
        """When the next group may begin, s."""
        return self.company.ensemble.clock

    @property
    def speaker(self) -> Performer:
        """Who spoke last, or begins."""
        return self.company.ensemble.speaker or self.company.ensemble.performer("")

    @property
    def due(self) -> float:
        """When the next group must be decided, s; minus infinity: as soon as there is one."""
        if self.last is None or self.speaker.state.body in self.resting:
            return float("-inf")
        line = self._next.before[1] if self._next else self.line
        return min(self.silent - self.timing.reaction - self.timing.margin, line - self.timing.ahead)

    @property
    def waits(self) -> bool:
        """Whether the text that there is has not been prepared yet."""
        return not self.queue and not self.backstage.starved and not self.backstage.idle

    def _wake(self) -> float:
        if self.over is not None:
            return self.over
        need = [who.state.time - self.timing.ahead - LOOK_AHEAD for who in self.company.performers]
        times = [time for time in (self.due, *need) if time > self.now]
        return min([self.now + GLANCE, *times])

    def _flush(self) -> int:
        """How much of an unfinished text is taken: the more, the more it is needed."""
        if self.queue or (self.due > self.now + SOON):
            return NOTHING
        return ALL if self.now - self.fed > self.timing.patience else SENTENCES

    # -- groups

    def _collect(self) -> None:
        for made in self.backstage.collect():
            if made.generation != self.generation:
                continue
            if made.problem:
                self.counts.unspoken += 1
                self.warn("unspoken", f"{made.problem}: {_shown(made.group.text)}")
                continue
            self.queue.append(made)

    def _decide_next(self) -> bool:
        """Decide a group, if it is time for it."""
        if self.paused or self.now < self.due:
            return False
        turn = self._next or self._placed(now=True)
        if turn is None:
            return self._end()
        self._next = None
        following = self._placed(now=False) if self._same_body(turn) else None
        if following is None:
            if self._finished():
                self._decide_turn(turn)
                self._finish()
                return False
            turn.who.hurry()
            turn.shown.extend(self.company.drain())
        self._decide_turn(turn, following)
        self._next = following
        return True

    def _same_body(self, turn: Turn) -> bool:
        return bool(self.queue) and self.queue[0].group.voice == turn.prepared.group.voice

    def _placed(self, *, now: bool) -> Turn | None:
        """The next group that is ready, placed."""
        if not self.queue:
            return None
        prepared = self.queue.popleft()
        if now:
            self._make_way(prepared)
        return self.company.place(prepared)

    def _make_way(self, prepared: Prepared) -> None:
        """Whoever speaks next stops to breathe at rest, as soon as it is their turn."""
        reaction = self.now + self.timing.reaction
        who, joins = self.company.performer(prepared.group.voice, max(self.line, reaction))
        body = who.state.body
        if joins:
            self.ledger.body(who.body())
            self._heard[body] = AS_MADE
        begin = snap(max(self.line, reaction))
        if body in self.resting or who.state.time < self.now + self.timing.ahead - self.timing.margin:
            self._border(who, begin)
        if self._late is not None:
            late = begin - self._late
            self.counts.late += 1
            self.counts.latest = max(self.counts.latest, late)
            self.warn("late", f"{late:.3f} s late: the voice was not ready: {_shown(prepared.group.text)}", at=begin)
            self._late = None

    def _border(self, who: Performer, at: float) -> None:
        """Whatever a body does is cut there, and it goes on with something else."""
        if who.state.time < at:  # held up for so long that nobody knows what it did
            self.counts.stalls += 1
            who.go_on(self.company.ensemble.breathing.rest(who.state, at, "held_up"))
            self.decide(self.company.drain())
        interrupt(self, who, at, fade=FADE)
        self.company.ensemble.clock = max(self.line, at)

    def _decide_turn(self, turn: Turn, following: Turn | None = None) -> None:
        """What was placed happens."""
        group = turn.prepared.group
        self.ledger.group(group_of(turn.spoken, turn.who.state.body), turn.prepared.media)
        self.silent = turn.silent
        self.last = turn
        self.counts.groups += 1
        self.backstage.tell(lambda preparer: preparer.prompter.done(group))
        self._catch_up(turn.who, turn.onset)
        self.decide([*turn.events, *turn.shown, *(following.shown if following else ())])
        if following:
            following.shown = []

    def take_back(self) -> None:
        """The group that was placed on trial is not decided: it will be placed again."""
        turn, self._next = self._next, None
        if turn is None:
            return
        self.company.take_back(turn)
        self.queue.appendleft(turn.prepared)
        body = turn.who.state.body
        lost = [event for event in self.ledger.near(body) if _emotional(event) and event.onset >= turn.onset]
        if lost:
            at = snap(max(self.now + self.timing.reaction, min(event.onset for event in lost)))
            self.decide([self.cutting(body, at, [event.id for event in lost], 0.1)])

    # -- the end

    def _finished(self) -> bool:
        return self.ending and not self.queue and self.backstage.idle

    def _end(self) -> bool:
        if self._finished():
            self._finish()
        return False

    def _finish(self) -> None:
        """Everybody comes to rest, and all is over."""
        for who in self.company.performers:
            if who.state.body in self.resting:
                interrupt(self, who, snap(max(self.line, self.now + self.timing.reaction)), fade=FADE)
        over = self.company.ensemble.finish(self._tail)
        self.decide(self.company.drain())
        self.over = over
        self.ledger.end(over)

    # -- rest

    def _rest(self) -> None:
        """Bodies with nothing to do breathe on, as far ahead as their faces must know."""
        if self.over is not None:
            return
        until = self.now + self.timing.ahead + LOOK_AHEAD
        for who in self.company.performers:
            speaks = who is self.speaker and self.last is not None and who.state.body not in self.resting
            if (speaks and self.now < self.due) or who.state.time >= until:
                continue
            if speaks and self.waits and not self.paused:
                self._late = self.line
            begun = who.state.time
            while who.state.time < until:
                self.resting.add(who.state.body)
                who.go_on(self.company.ensemble.breathing.idle(who.state))
            self._catch_up(who, begun)
            self.decide(self.company.drain())

    # -- what is decided

    def decide(self, events: list[Event]) -> None:
        """These happen: they are written, and sound."""
        if not events:
            return
        used = breath_media(events, self.company.ensemble.recordings)
        self.ledger.media_used(used)
        written = self.ledger.events(events, self.now)
        bodies = dict.fromkeys(event.body for event in written)
        for body in bodies:
            own = [event for event in written if event.body == body]
            self._sound(body, [event for event in own if not isinstance(event, (*FACE, Cut, Parameter))])
            for event in own:
                if isinstance(event, Cut):
                    self.counts.cuts += 1
                    self._sounder.cut(event.onset, event.targets, event.fade)
                elif isinstance(event, Parameter) and event.heard is not None:
                    self._sounder.move(event.onset, body, event.heard, event.glide)
                    self._heard[body] = event.heard
            if any(isinstance(event, BREATHS) for event in own):
                self.made[body] = self._parameters(body)

    def _sound(self, body: str, events: list[Event]) -> None:
        sounds = []
        for sound in onsets(self.ledger.part(body, events)):
            if "rand_id" not in sound.controls:
                sounds.append(sound)
                continue
            own = {"rand_id": float(self._breaths % GENERATORS)}  # breaths that overlap must not share one
            sounds.append(replace(sound, controls={**sound.controls, **own}))
            self._breaths += 1
        if sounds:
            self._sounder.play(sounds, self._media)

    def _parameters(self, body: str) -> Parameters:
        return next(who.state.parameters for who in self.company.performers if who.state.body == body)

    def _catch_up(self, who: Performer, onset: float) -> None:
        """What begins now was made with all that was moved: the sound is as the events say."""
        body = who.state.body
        if self._heard[body] != AS_MADE:
            self.decide(
                [
                    Parameter(
                        id=f"{body}.as_made", body=body, onset=snap(max(onset, self.now)), duration=0.0,
                        rule="the plan has caught up", name="", heard=AS_MADE,
                    )
                ]
            )  # fmt: skip

    def cutting(self, body: str, at: float, targets: list[str], fade: float) -> Cut:
        """The event that ends others."""
        return Cut(
            id=f"{body}.cut{self.counts.cuts + 1}", body=body, onset=at, duration=fade, origin="performer",
            rule="cut", targets=tuple(targets), fade=fade,
        )  # fmt: skip

    def warn(self, code: str, text: str, at: float | None = None) -> None:
        """Say it now, and write it down."""
        self.tell(f"{code}: {text}")
        onset = snap(max(0.0, self.now if at is None else at))
        self.decide(
            [WarningEvent(id=f"{BODY}.{code}", body=BODY, onset=onset, duration=0.0, rule=code, code=code, text=text)]
        )


def _emotional(event: Event) -> bool:
    return isinstance(event, Emotion) or (isinstance(event, Blink) and event.left != event.right)


def _shown(text: str) -> str:
    words = " ".join(text.split())
    return words if len(words) <= 60 else words[:57] + "..."
