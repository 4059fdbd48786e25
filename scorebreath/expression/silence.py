"""The face while nobody is heard: at the pause behind a group, and for as long as the body only breathes or listens.

Eyes are at the listener when speech ends (A34); after a while they wander as those of somebody who listens, and are
back before speech goes on or all is over. What happens at a time is known `LOOK_AHEAD` later at the latest, however
the silence was told.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from scorebreath.expression.actor import SHORTEST, Actor
from scorebreath.expression.blinks import BETWEEN, LONGEST, blink, due, free
from scorebreath.expression.coordination import APART, PausePlan, clear, plan_pause
from scorebreath.expression.emotion import LONGEST_SILENCE
from scorebreath.expression.gaze import FIXATION, NARROW, aside, near_listener, nearer
from scorebreath.expression.scene import PAUSE, Silence
from scorebreath.units import snap

LOOK_AHEAD = LONGEST_SILENCE
"""s that must be known of what follows."""
THOUGHT = 1.5
"""s after speech from which on eyes wander."""
AWAY, AWAY_SPREAD = 1.14, 0.27
"""s of a look away while listening, and its spread (Andrist 2014)."""
HOME = 0.5
"""s before the end from which on the eyes are at the listener."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bounds:
    """How far a silence can be decided."""

    since: float
    """s"""
    speech: float | None
    """s when speech goes on; None: not known yet"""
    over: float | None
    """s when all is over; None: not known yet"""
    horizon: float
    """s up to which something is known"""
    opening: tuple[float, ...] = ()
    """s; onsets of what the eyes may do as soon as speech goes on"""

    def ready(self, time: float) -> bool:
        """Whether enough is known to decide what happens then."""
        return self.speech is not None or self.over is not None or time + LOOK_AHEAD <= self.horizon

    @property
    def begins(self) -> tuple[float, ...]:
        """When speech goes on, if it does: an accent may bring a glance there."""
        return () if self.speech is None else (self.speech,)

    @property
    def last(self) -> float:
        """When it ends, s; infinity: not within `LOOK_AHEAD`."""
        return min((time for time in (self.speech, self.over) if time is not None), default=math.inf)

    @property
    def end(self) -> float:
        """Up to where it can be decided, s."""
        return self.last if self.last < math.inf else self.horizon - LOOK_AHEAD

    def fitted(self, time: float) -> float:
        """A time when something ends: where speech begins, if hardly anything would fit in between."""
        return time if self.speech is None or time < self.speech - NARROW - PAUSE else self.speech

    def soon(self) -> float:
        """How long the silence lasts, as far as it matters, s."""
        return snap(min(LOOK_AHEAD, self.last - self.since))


def silence(actor: Actor, bounds: Bounds) -> None:
    """Go on being silent as far as it can be decided."""
    if not actor.memory.entered:
        if not bounds.ready(bounds.since):
            return
        _enter(actor, bounds)
    _blinks(actor, bounds)
    _wander(actor, bounds)


def behind(actor: Actor, bounds: Bounds, *, asked: bool) -> PausePlan | None:
    """What happens at the pause behind a group; None: nothing does."""
    length = bounds.soon()
    if actor.memory.place == "start" or length < PAUSE:
        return None
    pause = Silence(onset=bounds.since, end=snap(bounds.since + length), free=True, search=False)
    plan = plan_pause(actor, pause, "behind", asked=asked)
    if plan.glance is not None and not clear(plan.glance, bounds.opening):  # a search comes with the next word
        return replace(plan, glance=bounds.since)
    return plan


def _enter(actor: Actor, bounds: Bounds) -> None:
    """The pause's own blink and glance."""
    actor.note(entered=True)
    plan = behind(actor, bounds, asked=actor.memory.asked)
    if plan is None:
        return
    end = plan.silence.end
    if plan.glance is not None:
        actor.gaze(plan.glance, actor.memory.eyes, actor.memory.target, _staying(actor))
        size, angle = actor.draws("look", 2, "behind")
        until = bounds.fitted(min(plan.glance + FIXATION[0] + size, end))
        actor.gaze(until, near_listener(actor, size, angle), "listener", "glance at pause")
    elif not actor.memory.asked:
        actor.note(run_until=min(end, bounds.since + THOUGHT), run=actor.memory.eyes)
    looks = (*actor.memory.looks, *bounds.opening, *bounds.begins)
    if plan.blink is not None and free(actor, plan.blink) and clear(plan.blink, looks):
        blink(actor, plan.blink, "pause", looks=looks, until=bounds.last - LONGEST)


def _staying(actor: Actor) -> str:
    return "look at listener" if actor.memory.target == "listener" else "listen"


def _blinks(actor: Actor, bounds: Bounds) -> None:
    """Blinks that the eyes need."""
    looks = (*actor.memory.looks, *bounds.opening, *bounds.begins)
    while (at := max(due(actor), bounds.since, actor.memory.blink_end + BETWEEN)) < bounds.end:
        if not bounds.ready(at) or (bounds.over is not None and at + LONGEST > bounds.over):
            return
        if not clear(at, looks):
            actor.note(blink_due=max(look for look in looks if not clear(at, (look,))) + APART + 0.01)
        elif free(actor, at):
            blink(actor, at, "need", looks=looks, until=bounds.last - LONGEST)
        else:
            wink = max(end for begin, end in actor.memory.winks if begin <= at + LONGEST)
            actor.note(blink_due=wink + BETWEEN)


def _wander(actor: Actor, bounds: Bounds) -> None:
    """Gaze from where it has been decided up to the end."""
    while (time := actor.memory.eyes_until) < bounds.end - SHORTEST and bounds.ready(time):
        number = actor.memory.numbers.get("gaze", 0)
        draws = actor.draws("silence", 6, number)
        length = FIXATION[0] + (FIXATION[1] - FIXATION[0]) * draws[0]
        if bounds.over is not None and bounds.over - time <= length + HOME and bounds.speech is None:
            actor.gaze(bounds.over, (0.0, 0.0), "listener", "look at listener", "at the end")
            return
        if actor.memory.run_until is None or time >= actor.memory.run_until - SHORTEST:
            _turn(actor, bounds, time, draws)
        until = min(time + length, actor.memory.run_until or time + length)
        _look(actor, bounds.fitted(max(until, time + NARROW)), draws)


def _turn(actor: Actor, bounds: Bounds, time: float, draws: list[float]) -> None:
    """A run is over: eyes go away, or come back; for how long."""
    share = actor.face.look_when_silent
    speaking = actor.memory.place != "start" and time < max(bounds.since + THOUGHT, actor.memory.held)
    soon = bounds.speech is not None and bounds.speech - time < AWAY + THOUGHT
    leaves = actor.memory.target == "listener" and actor.memory.run_until is not None
    if leaves and not speaking and not soon and share < 1.0 and actor.face.gaze_away > 0.0:
        length = AWAY + AWAY_SPREAD * (2.0 * draws[1] - 1.0)
        name, eyes = aside(actor, draws[3:])
        actor.note(run_until=time + length, target=name, run=eyes)
        return
    odds = share / (1.0 - share) if share < 1.0 else 1e6
    length = AWAY * odds * (0.5 + draws[1])
    actor.note(run_until=time + max(NARROW, length), target="listener", run=(0.0, 0.0))


def _look(actor: Actor, until: float, draws: list[float]) -> None:
    """One fixation of a run."""
    memory = actor.memory
    if memory.target == "listener":
        eyes = near_listener(actor, draws[1], draws[2])
        if memory.silent is not None and memory.eyes_until <= memory.silent + SHORTEST:
            eyes = nearer(eyes, memory.eyes, 1.0)  # the last sound may be a pitch maximum
        actor.gaze(until, eyes, "listener", "look at the asked" if memory.asked else "listen")
        return
    drift = near_listener(actor, draws[1], draws[2])
    actor.gaze(until, (memory.run[0] + drift[0], memory.run[1] + drift[1]), memory.target, "listen")
