"""Where the eyes look while a group is spoken (A22, A30-A35).

First it is decided when they must be at the listener: at the accented syllables that chance chooses, throughout
questions, at pauses between phrases. In between they look away where they may: a way off begins at a phone's boundary
outside accented syllables and pitch maxima, at phrase beginnings first; before accents that are not chosen in any
case, elsewhere as long as the listener still gets his share of the time. A word that is searched for is searched for
elsewhere. Within all this they never stay quite still.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from scorebreath.expression.accents import Span
from scorebreath.expression.actor import Actor
from scorebreath.expression.coordination import PausePlan
from scorebreath.expression.scene import Scene
from scorebreath.expression.search import Search

GLANCE = 0.25
"""s that a glance at the listener lasts, at least."""
AWAY = 0.2
"""s that a look away lasts, at least."""
SWITCH = 0.3
"""s between two accented syllables within which the eyes do not both come and go: they share one chance."""
GUARD = 0.05
"""s around a pitch maximum in which no shift away is under way."""
ON_TARGET = 1.4
"""Degrees that eyes at the listener may be off, at most."""
FIXATION = (0.5, 2.0)
"""s between small shifts (physiology 7.5)."""
SPREAD = 0.2
"""Looks away go from 1 - this to 1 + this times the usual angle (Andrist 2014: 8 to 12 degrees)."""
NARROW = 0.1
"""s between two shifts, at least."""
DIRECTIONS = (("away-left", 0.33, 0.0), ("away-right", 0.33, 180.0), ("up", 0.2, 90.0), ("down", 0.14, -90.0))
"""Names, chances, and degrees counterclockwise as the listener's mirror image: mostly sideways, then up."""
SCATTER = 25.0
"""Degrees that a direction varies by, both ways."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shift:
    """The eyes turn somewhere."""

    at: float
    eyes: tuple[float, float]
    target: str
    rule: str
    why: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Glance:
    """A time for which the eyes must be at the listener, and why."""

    onset: float
    end: float
    rule: str
    why: str = ""


def near_listener(actor: Actor, size: float, angle: float, reach: float = 1.0) -> tuple[float, float]:
    """A point near the listener; `size` and `angle` are drawn."""
    return _around((0.0, 0.0), min(ON_TARGET, actor.face.gaze_range) * reach * math.sqrt(size), angle)


def _around(middle: tuple[float, float], distance: float, angle: float) -> tuple[float, float]:
    turn = 2.0 * math.pi * angle
    return middle[0] + distance * math.cos(turn), middle[1] + distance * math.sin(turn)


def aside(actor: Actor, draws: Sequence[float]) -> tuple[str, tuple[float, float]]:
    """Name and point of a look away; three numbers are drawn."""
    which, scatter, size = draws[:3]
    for name, share, degrees in DIRECTIONS:
        if which < share or name == "down":
            turn = math.radians(degrees + SCATTER * (2.0 * scatter - 1.0))
            far = actor.face.gaze_away * (1.0 + SPREAD * (2.0 * size - 1.0))
            return name, (far * math.cos(turn), far * math.sin(turn))
        which -= share
    raise AssertionError("the last direction takes what is left")


def speech_gaze(
    actor: Actor, scene: Scene, pauses: Sequence[PausePlan], searches: Sequence[Search]
) -> list[float]:  # fmt: skip
    """All gaze from the first sound of a group to its last; onsets of the glances at accents, s."""
    glances = _glances(actor, scene, pauses)
    runs = _runs(actor, scene, glances, searches)
    shifts = [shift for number, run in enumerate(runs) for shift in _shifts(actor, scene, run, number, glances)]
    shifts.sort(key=lambda shift: shift.at)
    kept: list[Shift] = []
    for shift in shifts:
        if kept and shift.at - kept[-1].at < NARROW and shift.target == kept[-1].target:
            continue
        kept.append(shift)
    for shift, after in zip(kept, [*(s.at for s in kept[1:]), scene.end], strict=True):
        eyes = shift.eyes
        if shift.target == "listener" and _stressed(scene, shift.at):
            eyes = nearer(eyes, actor.memory.eyes, 1.0)
        actor.gaze(after, eyes, shift.target, shift.rule, shift.why)
    return [shift.at for shift in kept if shift.rule == "glance at accent"]


def _stressed(scene: Scene, time: float) -> bool:
    """Whether eyes that turn then would turn in an accented syllable or at a pitch maximum."""
    turning = Span(onset=time, end=time + NARROW)
    if any(peak.time in turning for peak in scene.peaks):
        return True
    return any(accent.onset < turning.end and time < accent.end for accent in scene.accents)


def _glances(actor: Actor, scene: Scene, pauses: Sequence[PausePlan]) -> list[_Glance]:
    """When the eyes must be at the listener, ascending."""
    found = [_Glance(onset=span.onset, end=span.end, rule="look at the asked") for span in _asked(actor, scene)]
    found += [
        _Glance(onset=plan.glance, end=max(plan.silence.end, plan.glance + GLANCE), rule="glance at pause")
        for plan in pauses
        if plan.glance is not None
    ]
    chosen = _chosen(actor, scene, [glance for glance in found if glance.rule == "glance at pause"])
    for number, accent in enumerate(scene.accents):
        if chosen[number]:
            onset = _before(scene, accent.onset)
            end = scene.edge(max(accent.end, onset + GLANCE), accent.end)
            if number + 1 < len(chosen) and not chosen[number + 1]:
                end = scene.edge(accent.end)  # the next one is not for the listener: time to go
            found.append(_Glance(onset=onset, end=end, rule="glance at accent", why=f"on {accent.text!r}"))
    return sorted(found, key=lambda glance: glance.onset)


def _asked(actor: Actor, scene: Scene) -> list[Span]:
    """When somebody is being asked: throughout questions, and until what they raise is let go (A22)."""
    found = [Span(onset=scene.edge(span.onset), end=scene.edge(span.end)) for span in scene.asking]
    held = actor.memory.held
    if held > scene.onset:
        since = max((span.onset for span in found if span.onset < held), default=scene.onset)
        found.append(Span(onset=since, end=next(iter(scene.between(held, scene.end)), scene.end)))
    return found


def _chosen(actor: Actor, scene: Scene, pauses: Sequence[_Glance]) -> list[bool]:
    """For each accented syllable whether it comes with a glance.

    Syllables too close for the eyes to come and go share a chance. Where the eyes are at the listener anyway, because
    of a pause just before, there is a glance; the chance of all others is so much lower that their share is what was
    asked for.
    """
    draws = actor.draws("glance", len(scene.accents))
    sure = [
        accent.onset < scene.onset + NARROW or any(p.onset <= accent.onset < p.end + NARROW for p in pauses)
        for accent in scene.accents
    ]
    for number, (accent, after) in enumerate(pairwise(scene.accents), 1):
        if after.onset - accent.end < SWITCH:
            draws[number] = draws[number - 1]
            sure[number] = sure[number] or sure[number - 1]
    others = sure.count(False)
    chance = (actor.face.glance_at_accent * len(sure) - sure.count(True)) / others if others else 0.0
    never = actor.face.glance_at_accent <= 0.0
    return [not never and (known or draw < chance) for known, draw in zip(sure, draws, strict=True)]


def _before(scene: Scene, time: float) -> float:
    """The boundary before an accented vowel, so that the eyes are there when it sounds."""
    near = scene.between(time - 0.12, time - 0.04)
    return near[-1] if near else scene.edge(time)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Run:
    """A time that the eyes spend at one place, but for small shifts."""

    onset: float
    end: float
    search: Search | None = None
    listener: bool = False


def _runs(actor: Actor, scene: Scene, glances: Sequence[_Glance], searches: Sequence[Search]) -> list[_Run]:
    """The group's time in runs that touch each other."""
    on = _merged([(max(scene.onset, g.onset), min(scene.end, g.end)) for g in glances])
    for search in searches:
        on = _without(on, search.onset, search.end)
    chosen = [Span(onset=low, end=high) for low, high in on]
    busy = sorted([*on, *((search.onset, search.end) for search in searches)])
    asked = [glance for glance in glances if glance.rule == "look at the asked"]
    away = _away(actor, scene, _gaps(busy, scene.onset, scene.end), chosen, asked)
    others = [_Run(onset=low, end=high) for low, high in away]
    others += [_Run(onset=search.onset, end=search.end, search=search) for search in searches]
    rest = _gaps(sorted((run.onset, run.end) for run in others), scene.onset, scene.end)
    return sorted([*others, *(_Run(onset=low, end=high, listener=True) for low, high in rest)], key=lambda r: r.onset)


def _away(
    actor: Actor, scene: Scene, gaps: Sequence[tuple[float, float]], chosen: Sequence[Span], asked: Sequence[_Glance]
) -> list[tuple[float, float]]:  # fmt: skip
    """Times for which the eyes leave the listener, all together as long as they may.

    Gaps with accents that are not for the listener come first, then the longest. What is left for the last one is
    all that is left of the time, or, if that is too short to be seen, chance.
    """
    if actor.face.gaze_away <= 0.0:
        return []
    spared = [a for a in scene.accents if not any(a.onset < s.end and s.onset < a.end for s in chosen)]
    found = []
    for low, high in gaps:
        begin = _leave(scene, (low, high), asked)
        if begin is not None:
            found.append((not any(begin <= accent.onset < high for accent in spared), begin - high, begin, high))
    left = (1.0 - actor.face.look_at_listener) * (scene.end - scene.onset)
    away = []
    for number, (_, _, low, high) in enumerate(sorted(found)):
        if left < AWAY:
            left = AWAY if actor.draws("away.last", 1, number)[0] * AWAY < left else 0.0
        end = scene.edge(low + left, low + NARROW)
        end = high if high - end <= NARROW else end
        if left > 0.0:
            away.append((low, end))
            left = max(0.0, left - (end - low))
    return away


def _leave(scene: Scene, gap: tuple[float, float], asked: Sequence[_Glance]) -> float | None:
    """Where in a gap the eyes may leave the listener; None: nowhere."""
    for edge in scene.between(gap[0], gap[1] - AWAY):
        if any(span.onset - 1e-6 <= edge < span.end - 1e-6 for span in asked):
            continue
        moving = Span(onset=edge - GUARD, end=edge + NARROW + GUARD)
        if not any(peak.time in moving for peak in scene.peaks) and not _stressed(scene, edge):
            return edge
    return None


def _merged(spans: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    found: list[tuple[float, float]] = []
    for low, high in sorted(spans):
        if found and low <= found[-1][1]:
            found[-1] = found[-1][0], max(high, found[-1][1])
        elif high > low:
            found.append((low, high))
    return found


def _without(spans: Sequence[tuple[float, float]], low: float, high: float) -> list[tuple[float, float]]:
    parts = [part for begin, end in spans for part in ((begin, min(end, low)), (max(begin, high), end))]
    return [(begin, end) for begin, end in parts if end - begin > NARROW]


def _gaps(spans: Sequence[tuple[float, float]], low: float, high: float) -> list[tuple[float, float]]:
    """What is between the spans, which ascend."""
    found, time = [], low
    for begin, end in spans:
        if begin - time > 1e-6:
            found.append((time, begin))
        time = max(time, end)
    if high - time > 1e-6:
        found.append((time, high))
    return found


def _shifts(actor: Actor, scene: Scene, run: _Run, number: int, glances: Sequence[_Glance]) -> list[Shift]:
    """The shift that begins a run, and those within it."""
    if run.search is not None:
        what = run.search
        return [Shift(at=run.onset, eyes=what.eyes, target=what.target, rule="search", why=what.why)]
    if run.listener:
        return _at_listener(actor, scene, run, number, glances)
    phrase = sum(span.onset <= run.onset + 1e-6 for span in scene.phrases)
    name, middle = aside(actor, actor.draws("away", 3, phrase))
    found = [Shift(at=run.onset, eyes=middle, target=name, rule="look away")]
    for at, draws in _fidgets(actor, scene, run, number, []):
        size = min(actor.face.gaze_range, 0.5 * actor.face.gaze_away) * math.sqrt(draws[0])
        found.append(Shift(at=at, eyes=_around(middle, size, draws[1]), target=name, rule="small shift"))
    return found


def _at_listener(
    actor: Actor, scene: Scene, run: _Run, number: int, glances: Sequence[_Glance]
) -> list[Shift]:  # fmt: skip
    """Eyes at the listener: each glance brings them a little nearer to the very middle, in between they drift."""
    inside = [glance for glance in glances if run.onset - 1e-6 <= glance.onset < run.end - NARROW]
    size, angle = actor.draws("look", 2, number)
    first = inside[0] if inside and inside[0].onset - run.onset < NARROW else None
    found = [
        Shift(
            at=run.onset, eyes=near_listener(actor, size, angle, 0.5 if first else 1.0), target="listener",
            rule=first.rule if first else "look at listener", why=first.why if first else "",
        )
    ]  # fmt: skip
    for order, glance in enumerate(inside):
        if glance is not first and glance.onset - found[-1].at >= NARROW:
            size, angle = actor.draws("nearer", 2, f"{number}.{order}")
            closer = near_listener(actor, size, angle, 0.4)
            found.append(
                Shift(at=glance.onset, eyes=nearer(closer, found[-1].eyes), target="listener", rule=glance.rule,
                      why=glance.why)
            )  # fmt: skip
    for at, draws in _fidgets(actor, scene, run, number, [shift.at for shift in found[1:]]):
        eyes = near_listener(actor, *draws[:2])
        found.append(Shift(at=at, eyes=eyes, target="listener", rule="small shift"))
    return found


def nearer(eyes: tuple[float, float], than: tuple[float, float], share: float = 0.9) -> tuple[float, float]:
    """The point, brought as near to the listener as a share of another one's distance."""
    far, limit = math.hypot(*eyes), share * math.hypot(*than)
    if far <= limit:
        return eyes
    return eyes[0] * limit / far, eyes[1] * limit / far


def _fidgets(
    actor: Actor, scene: Scene, run: _Run, number: int, taken: Sequence[float]
) -> list[tuple[float, tuple[float, float]]]:
    """Times of small shifts, at boundaries where no accent and no maximum is, with two numbers drawn for each."""
    found: list[tuple[float, tuple[float, float]]] = []
    if actor.face.gaze_range <= 0.0:
        return found
    time, order = run.onset, 0
    while True:
        wait, size, angle = actor.draws("fidget", 3, f"{number}.{order}")
        time += FIXATION[0] + (FIXATION[1] - FIXATION[0]) * wait
        order += 1
        if time > run.end - 2 * NARROW:
            return found
        at = scene.edge(time)
        if not run.onset + NARROW <= at <= run.end - NARROW or any(abs(at - other) < NARROW for other in taken):
            continue
        if _stressed(scene, at):
            continue
        found.append((at, (size, angle)))
