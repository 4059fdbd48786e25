"""Blinks: at pauses, and when the eyes need one (A20, A21, Y3).

Every blink, whatever its cause, restarts the eyes' own clock. Lids are shut within 75 ms, mostly not quite, and open
slower (physiology 7.5); no blink lasts 300 ms, which would be seen as a sign (Hoemke 2018).
"""

from __future__ import annotations

from collections.abc import Sequence

from scorebreath.equations.looking import blink_interval, blink_limit
from scorebreath.expression.actor import SHORTEST, Actor
from scorebreath.expression.coordination import APART, CLEAR, PausePlan, clear
from scorebreath.expression.scene import Scene
from scorebreath.units import snap

CLOSE, HOLD = 0.075, 0.01
OPEN = (0.12, 0.205)
"""s of opening, from and to."""
CLOSED = (0.75, 1.0)
"""How far lids close: most blinks are not complete."""
BETWEEN, AT_ONCE = 0.2, 0.06
"""s from one blink's end to the next, at least; to the second one of two."""
LONGEST = CLOSE + HOLD + OPEN[1]
NUDGE = 0.25
"""s that a blink by itself may be moved to be at a phone's boundary outside stressed vowels."""
RULES = {"pause": "blink at pause", "need": "blink by itself", "double": "double blink"}


def due(actor: Actor) -> float:
    """When the next blink by itself is due, s."""
    memory = actor.memory
    if memory.blink_due is None:
        actor.note(blink_due=_draw(actor, 0.0, "begin"))
    return actor.memory.blink_due or 0.0


def blink(
    actor: Actor, onset: float, cause: str, why: str = "", *, looks: Sequence[float], until: float,
    scene: Scene | None = None,
) -> None:  # fmt: skip
    """Blink, some times twice, and draw when to do so again.

    Args:
        actor: Who blinks.
        onset: s.
        cause: One of `RULES`.
        why: What made it.
        looks: Onsets, s, that a second blink keeps away from.
        until: s; a second blink begins before.
        scene: The group that is being spoken: a second blink keeps to its phones.
    """
    number = actor.memory.numbers.get("blink", 0)
    opening, closed, twice = actor.draws("blink", 3, number)
    parts = (CLOSE, HOLD, OPEN[0] + (OPEN[1] - OPEN[0]) * opening)
    actor.blink(onset, parts, CLOSED[0] + (CLOSED[1] - CLOSED[0]) * closed, RULES[cause], why)
    end = onset + sum(parts)
    if cause != "double" and twice < actor.face.blink_double:
        soon = (end + AT_ONCE, *sorted(snap(look + APART + CLEAR) for look in looks))
        places = scene.between(end + AT_ONCE, end + LONGEST) if scene else soon
        again = next((at for at in places if end + AT_ONCE <= at <= end + LONGEST and clear(at, looks)), None)
        actor.note(blink_end=end - BETWEEN)
        if again is not None and again < until and free(actor, again):
            blink(actor, again, "double", looks=looks, until=until, scene=scene)
            return
    actor.note(blink_end=end, blink_due=_draw(actor, onset, number))


def _draw(actor: Actor, since: float, key: object) -> float:
    mean = actor.face.blink_interval
    waited = blink_interval(mean, actor.draws("blink.interval", 3, key))
    return since + min(waited, max(0.5 * mean, blink_limit(mean) - NUDGE - APART))


def free(actor: Actor, onset: float) -> bool:
    """Whether a blink fits there: the last one is over, no wink is in its way, and it ends before all is over."""
    if actor.over is not None and onset + LONGEST > actor.over:
        return False
    if onset < actor.memory.blink_end + BETWEEN - 1e-6:
        return False
    return all(onset + LONGEST < begin or end < onset for begin, end in actor.memory.winks)


def speech_blinks(actor: Actor, scene: Scene, pauses: Sequence[PausePlan], coming: Sequence[float]) -> None:
    """All blinks while a group is spoken, its gaze being decided.

    Args:
        actor: Who blinks.
        scene: The group.
        pauses: The plans of its pauses.
        coming: Onsets, s, of what the eyes do right behind it.
    """
    looks = [*actor.memory.looks, *coming]
    planned = [at for plan in pauses if (at := _spared(plan, looks)) is not None]
    while True:
        need = max(due(actor), scene.onset)
        if planned and planned[0] <= need + NUDGE:
            at = planned.pop(0)
            if free(actor, at):
                blink(actor, at, "pause", looks=looks, until=scene.end, scene=scene)
        elif need < scene.end:
            low = max(scene.onset, actor.memory.blink_end + BETWEEN)
            at = _calm(scene, need, low, looks)
            if at >= scene.end - SHORTEST:
                return
            if free(actor, at):
                why = f"{at - _since(actor, at):.1f} s after the last one ended"
                blink(actor, at, "need", why, looks=looks, until=scene.end, scene=scene)
            else:
                actor.note(blink_due=max(_after_wink(actor, at), need + BETWEEN))  # or it would come back to the same
        else:
            return


def _spared(plan: PausePlan, looks: Sequence[float]) -> float | None:
    """Where the blink of a pause goes: where it was planned, else where the pause is over; None: nowhere."""
    wanted = () if plan.blink is None else (snap(plan.blink), plan.silence.end)
    return next((at for at in wanted if clear(at, looks)), None)


def _since(actor: Actor, at: float) -> float:
    """Onset of the last blink, roughly: where its end is known alone."""
    return min(at, max(0.0, actor.memory.blink_end))


def _after_wink(actor: Actor, at: float) -> float:
    """When a wink that is in the way is over; a wink is a blink, too."""
    ends = [end for begin, end in actor.memory.winks if not (at + LONGEST < begin or end < at)]
    return max([at, *ends]) + BETWEEN


def _calm(scene: Scene, time: float, low: float, looks: Sequence[float]) -> float:
    """The place near a time where a blink disturbs nobody: not in a stressed vowel, nor beside a glance at a pause."""

    def calm(at: float) -> bool:
        stressed = any(at in span for span in scene.stressed)
        return not stressed and clear(at, looks)

    open_ = [silence for silence in scene.silences if silence.free and time in silence]
    if open_ and time >= low and calm(time):
        return time
    near = [edge for edge in scene.between(max(low, time - NUDGE), time + NUDGE) if calm(edge)]
    if near:
        return min(near, key=lambda edge: abs(edge - time))
    return next((edge for edge in scene.between(max(low, time), scene.end) if calm(edge)), scene.end)
