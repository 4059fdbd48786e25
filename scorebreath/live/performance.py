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

from scorebreath.ensemble import Performer
from scorebreath.errors import InputError
from scorebreath.expression.silence import LOOK_AHEAD
from scorebreath.live.backstage import Backstage
from scorebreath.live.closing import FADE, Closing
from scorebreath.live.company import Company, Turn
from scorebreath.live.conditions import Sounder, Timing, Told
from scorebreath.live.deciding import Decisions
from scorebreath.live.interrupting import interrupt
from scorebreath.live.ledger import Ledger
from scorebreath.live.preparing import Prepared
from scorebreath.live.prompter import ALL, NOTHING, SENTENCES, WORDS
from scorebreath.live.supply import Supply
from scorebreath.live.text import Text
from scorebreath.media.store import MediaStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import group_of
from scorebreath.score.performing import GIVES_WAY
from scorebreath.script.marks import Mark
from scorebreath.units import snap

SOON = 0.5
"""s before a group is due from which on an unfinished text is taken for it."""
WORD = 5.0
"""Times the usual patience that a word waits for its other half."""
GLANCE = 0.25
"""s after which it looks again, whatever happens."""
SETTLED, REST = 0.1, 0.6
"""s after a move, and after the last time, before plans are made anew."""
NEAR = 1.0
"""s before it is due within which a group that is ready stays as it was planned."""
LATE = 0.001
"""s from which on a group is late."""


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
        self.company, self.ledger = company, ledger
        self.timing, self.tell = timing, tell
        self.now = -timing.ahead
        self.decisions = Decisions(company.ensemble, ledger, sounder, media, clock=lambda: self.now, tell=tell)
        self.paused = self.ending = False
        self.over: float | None = None
        self.supply = Supply(backstage, self.now)
        self.last: Turn | None = None
        """the group that was decided last"""
        self.silent = lead
        """s; when the last sound of what is decided is over"""
        self.resting: set[str] = set()
        """bodies that breathe at rest because nobody knew what follows"""
        self.inbox: deque[Callable[[Performance], None]] = deque()
        self.settings: dict[str, Parameters] = {}
        """by voice: parameters that were moved; the backstage speaks with them"""
        self.begun_with = {
            who.state.body: who.state.parameters.set_by_hand() for who in company.ensemble.performers.values()
        }
        """by body: what was set at the beginning"""
        self.floor: str | None = None
        """voice of whoever has taken the floor, and has not spoken yet"""
        self.shown = 0.0
        """s; until when a face shows what a text without a word asked for"""
        self.acts = 0
        """commands that were acts"""
        self.closing = Closing(tail)
        self._next: Turn | None = None
        self._late: float | None = None
        self._planning: float | None = None
        self._planned = self.now
        company.ensemble.begin(lead, begun)
        self.decisions.decide(company.drain())

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
            order = self.inbox.popleft()
            try:
                order(self)
            except InputError as error:  # what two moves together make, for one, is known only now
                self.tell(f"refused: {error}")
        if self._planning is not None and now >= self._planning:
            self.plan_again(keep=1 if self.supply.ready and self.due - now < NEAR else 0)
        self.supply.want(self._flush())
        for failed in self.supply.collect():
            self.decisions.counts.unspoken += 1
            self.decisions.warn("unspoken", f"{failed.problem}: {_shown(failed.group.text)}")
        if self.over is None:
            while self._decide_next():
                pass
            self._rest()
        self.supply.want(self._flush())
        near = self.timing.nudge + self.timing.margin
        return min(self._wake(), self.decisions.keep_up(now + near) - near)

    @property
    def line(self) -> float:
        """When the next group may begin, s."""
        return self.company.ensemble.clock

    @property
    def speaker(self) -> Performer:
        """Who spoke last, or begins."""
        return self.company.ensemble.speaker or self.company.ensemble.performer("")

    @property
    def speaks(self) -> bool:
        """Whether a group that was decided is not over yet."""
        return self.last is not None and self.speaker.state.body not in self.resting and self.now < self.line

    @property
    def due(self) -> float:
        """When the next group must be decided, s; minus infinity: as soon as there is one."""
        resting = self.speaker.state.body in self.resting
        if resting or self.last is None:
            return self.line - self.timing.ahead if resting else float("-inf")
        line = self._next.before[2] if self._next else self.line
        return min(self.silent - self.timing.reaction - self.timing.margin, line - self.timing.ahead)

    @property
    def coming(self) -> list[Prepared]:
        """Groups that are ready and not decided, in order."""
        return [*([self._next.prepared] if self._next else ()), *self.supply.ready]

    def _wake(self) -> float:
        if self.over is not None:
            return self.over
        need = [who.state.time - self.timing.ahead - LOOK_AHEAD for who in self.company.performers]
        times = [time for time in (self.due, *need) if time > self.now]
        return min([self.now + GLANCE, *times])

    def _flush(self) -> int:
        """How much of an unfinished text is taken: the more, the more it is needed."""
        if self.supply.ready or self.due > self.now + SOON:
            return NOTHING
        waited = self.now - self.supply.fed
        if waited > WORD * self.timing.patience:
            return ALL
        return WORDS if waited > self.timing.patience else SENTENCES

    def parameters(self, voice: str) -> Parameters:
        """Of whoever speaks with a voice, or would."""
        ensemble = self.company.ensemble
        return self.settings.get(voice) or ensemble.cast.get(voice, ensemble.parameters)

    # -- groups

    def _decide_next(self) -> bool:
        """Decide a group, if it is time for it."""
        if self.paused or self.now < self.due:
            return False
        if self._next is not None and self._next.onset < self.now + self.timing.ahead - self.timing.margin:
            self.take_back()  # too late for it to happen as it is placed
        turn = self._next or self._placed(now=True)
        if turn is None:
            return self._end()
        self._next = None
        following = self._placed(now=False) if self._same_body(turn) else None
        if following is None:
            if self._finished():
                self._decide_turn(turn)
                self.closing.decide(self)
                return False
            turn.who.hurry()
            turn.shown.extend(self.company.drain())
        self._decide_turn(turn, following)
        self._next = following
        return True

    def _same_body(self, turn: Turn) -> bool:
        ready = self.supply.ready
        return bool(ready) and ready[0].group.voice == turn.prepared.group.voice

    def _placed(self, *, now: bool) -> Turn | None:
        """The next group that is ready, placed."""
        if not self.supply.ready:
            return None
        prepared = self.supply.ready.popleft()
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
            self.begun_with[body] = who.state.parameters.set_by_hand()
        begin = snap(max(self.line, reaction))
        if body in self.resting or who.state.time < self.now + self.timing.ahead - self.timing.margin:
            interrupt(self, who, begin, fade=FADE, rule=GIVES_WAY)
            self.company.ensemble.clock = max(self.line, begin)
        if self._late is not None and begin - self._late >= LATE:
            late = begin - self._late
            self.decisions.counts.late += 1
            self.decisions.counts.latest = max(self.decisions.counts.latest, late)
            self.decisions.warn(
                "late", f"{late:.3f} s late: the voice was not ready: {_shown(prepared.group.text)}", at=begin
            )
        self._late = None

    def _decide_turn(self, turn: Turn, following: Turn | None = None) -> None:
        """What was placed happens."""
        if self.last is not None:
            self.supply.said(self.last.prepared.group)
        early = following.seen_before() if following else []
        for one in (turn, following if following and following.announced else None):
            if one is not None and one.spoken.id not in self.ledger.groups:
                self.ledger.group(group_of(one.spoken, one.who.state.body), one.prepared.media)
        self.silent = turn.silent
        self.last = turn
        if self.floor == turn.prepared.group.voice:
            self.floor = None
        self.decisions.counts.groups += 1
        self.decisions.decide([*turn.events, *turn.shown, *early])

    def take_back(self) -> None:
        """The group that was placed on trial is not decided: it will be placed again."""
        turn, self._next = self._next, None
        if turn is None:
            return
        self.company.take_back(turn)
        self.supply.ready.appendleft(turn.prepared)

    def occupied(self, who: Performer) -> None:
        """Something else than a group was placed for a body: nobody speaks before it is over."""
        if who is self.speaker:
            self.company.ensemble.clock = max(self.line, who.state.time)
        self.resting.add(who.state.body)

    def hear(self, text: Text) -> None:
        """There is something to say: behind what there is already, or first, by whoever has taken the floor."""
        self.supply.hear(text, self.now)
        if self.floor == text.voice:
            self.plan_again(prefer=text.voice)

    def plan_soon(self) -> None:
        """What has not been decided is planned anew, but not for each of many moves: voices need their time."""
        if self._planning is None:
            self._planning = max(self.now + SETTLED, self._planned + REST)

    def plan_again(self, place: int | None = None, *, keep: int = 0, prefer: str | None = None) -> None:
        """What has not been decided is planned anew, see `Supply.plan_again`."""
        self._planning, self._planned = None, self.now
        self.take_back()
        ensemble = self.company.ensemble
        self.supply.plan_again(
            place, self.last.prepared.group if self.last else None, keep=keep, prefer=prefer,
            parameters=self.parameters(""), cast=dict(ensemble.cast), blend=self.speaker.state.blend, time=self.line,
        )  # fmt: skip

    # -- the end

    def _finished(self) -> bool:
        return self.ending and self.supply.idle and self.shown <= self.now + self.timing.ahead

    def _end(self) -> bool:
        if self._finished():
            self.closing.decide(self)
        return False

    @property
    def is_over(self) -> bool:
        """Whether nothing that is told now can happen before all is over."""
        return self.over is not None and self.now + self.timing.reaction >= self.over

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
            if speaks and self.supply.late and not self.paused:
                self._late = self.line
            while who.state.time < until:
                self.resting.add(who.state.body)
                who.go_on(self.company.ensemble.breathing.idle(who.state))
            self.decisions.decide(self.company.drain())


def _shown(text: str) -> str:
    words = " ".join(text.split())
    return words if len(words) <= 60 else words[:57] + "..."
