"""Brows: raised at pitch maxima, the left one by their height (A28, A29), and on a question's last word (A23)."""

from __future__ import annotations

from collections.abc import Sequence

from scorebreath.equations.looking import BROW_FASTEST, movement_time
from scorebreath.expression.accents import Peak
from scorebreath.expression.actor import Actor
from scorebreath.expression.scene import Question, Scene

RISE, HOLD, FALL = 0.15, 0.15, 0.25
"""s of a raise (physiology 7.5: 300 to 600 ms in all)."""
LEAD = 0.06
"""s before the accented syllable (Flecha-Garcia 2010)."""
USUAL = 6.0
"""Semitones above the voice's low tone of an accent of usual height."""
LEFT = (0.43, 1.7)
"""The left brow's least and most, relative to the right one's (physiology 7.5: 0.15 to 0.6 against 0.35)."""
MINUTE = 60.0
SEEN = 0.2
"""s that a raise may be late and still belong to its accent (A54)."""
APART = 0.3
"""s between two raises at least: closer ones are one."""


def brows(actor: Actor, scene: Scene, held: Sequence[tuple[Question, float]], coming: Sequence[float]) -> None:
    """Raises while a group is spoken.

    Args:
        actor: Who raises them.
        scene: The group.
        held: Its questions, and when speech goes on behind each.
        coming: Onsets of raises that are sure to come: what is raised at an accent keeps its distance from them.
    """
    questions = [question for question, _ in held]
    draws = actor.draws("brow", len(scene.peaks))
    raises: list[tuple[float, Peak | tuple[Question, float]]] = [
        (scene.edge(question.onset, actor.state.time), (question, until)) for question, until in held
    ]
    for peak, draw in zip(scene.peaks, draws, strict=True):
        if draw < actor.face.brow_at_maximum and not any(_within(peak, question) for question in questions):
            raises.append((_onset(scene, peak, actor.state.time), peak))
    ahead = sorted([*coming, *(question.onset for question in questions)])
    for planned, what in sorted(raises, key=lambda item: item[0]):
        onset = _delayed(actor, scene, planned) if isinstance(what, Peak) else planned
        if isinstance(what, Peak):
            near = any(-1e-9 < later - onset < max(APART, actor.face.brow_interval) for later in ahead)
            if not near and rested(actor, onset):
                _accent(actor, onset, what)
        elif rested(actor, onset):
            _question(actor, onset, *what)


def _onset(scene: Scene, peak: Peak, low: float) -> float:
    early = peak.time - 0.5
    begun = peak.syllable if peak.syllable is not None and peak.syllable > early else peak.time - RISE + LEAD
    return scene.edge(min(begun, peak.time) - LEAD, max(low, 0.0))


def _delayed(actor: Actor, scene: Scene, onset: float) -> float:
    """A raise right behind another one comes a little later, where that is soon enough to be seen as one with it."""
    free = max((time + APART for time in actor.memory.raised if time <= onset), default=onset)
    later = scene.edge(free, free)
    return later if onset < free and later - onset <= SEEN else onset


def _within(peak: Peak, question: Question) -> bool:
    return question.onset - LEAD <= peak.time <= question.end + LEAD


def rested(actor: Actor, onset: float) -> bool:
    """Whether the brows may be raised then, beside all raises that are sure."""
    near = [time for time in actor.memory.raised if abs(onset - time) < MINUTE]
    least = max(APART, actor.face.brow_interval)
    return all(abs(onset - time) >= least for time in near) and len(near) < actor.face.brow_per_minute


def remember(actor: Actor, onset: float) -> None:
    """Count a raise."""
    actor.note(raised=(*(t for t in actor.memory.raised if onset - t < MINUTE), onset))


def _accent(actor: Actor, onset: float, peak: Peak) -> None:
    height = actor.face.brow_height
    left = min(1.0, height * min(LEFT[1], max(LEFT[0], peak.semitones / USUAL)))
    rise, fall = (movement_time(max(left, height), BROW_FASTEST, least) for least in (RISE, FALL))
    times = (onset, onset + rise, onset + rise + HOLD, onset + rise + HOLD + fall)
    remember(actor, onset)
    actor.brow(times, (left, height, 0.0), "brow at maximum", peak.why)


def _question(actor: Actor, onset: float, question: Question, until: float) -> None:
    height = actor.face.question_brow
    if height <= 0:
        return
    rise, fall = (movement_time(height, BROW_FASTEST, least) for least in (RISE, FALL))
    back = max(until, onset + rise)
    remember(actor, onset)
    actor.note(held=max(actor.memory.held, back))
    actor.brow((onset, onset + rise, back, back + fall), (height, height, 0.0), "question", f"on {question.text!r}")
