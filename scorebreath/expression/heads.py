"""The head: raised at pitch maxima by their height, at rest at minima, often rolled (A25-A27); questions (A23, Y6)."""

from __future__ import annotations

from collections.abc import Sequence

from scorebreath.equations.looking import HEAD_FASTEST, NOD, movement_time
from scorebreath.expression.accents import Peak
from scorebreath.expression.actor import Actor
from scorebreath.expression.scene import Question, Scene

SPREAD = 0.4
"""Rolls go from 1 - this to 1 + this times the usual angle."""
SETTLE = 0.3
"""s in which the head comes back from a question (physiology 7.5: 250 to 400 ms)."""


def heads(actor: Actor, scene: Scene, held: Sequence[tuple[Question, float]]) -> None:
    """Movements while a group is spoken.

    Args:
        actor: Whose head.
        scene: The group.
        held: Its questions, and when speech goes on behind each: minima in between bring no rest (Y6).
    """
    moves: list[tuple[float, int, Peak | Question]] = []
    for number, peak in enumerate(scene.peaks):
        if not any(question.onset <= peak.time < until for question, until in held):
            moves.append((peak.time, number, peak))
    for number, (question, _) in enumerate(held):
        moves.append((question.onset, len(scene.peaks) + number, question))
    until = {id(question): time for question, time in held}
    draws = iter(actor.draws("head", 4 * (len(scene.peaks) + len(held))))
    chances = [tuple(next(draws) for _ in range(4)) for _ in range(len(scene.peaks) + len(held))]
    for _, number, what in sorted(moves, key=lambda move: move[:2]):
        if isinstance(what, Question):
            _question(actor, scene, (what, until[id(what)]), _roll(actor, chances[number]))
        elif chances[number][3] < actor.face.head_at_maximum:
            _accent(actor, scene, what, _roll(actor, chances[number]))


def raised(actor: Actor, semitones: float) -> float:
    """How far the head goes up, degrees (A25)."""
    return min(actor.face.head_highest, max(0.0, semitones) * actor.face.head_per_semitone)


def _roll(actor: Actor, chances: Sequence[float]) -> float:
    """Degrees; towards the right shoulder +."""
    happens, side, size, _ = chances
    if happens >= actor.face.roll_at_raise:
        return 0.0
    return (1.0 if side < 0.5 else -1.0) * actor.face.roll_angle * (1.0 + SPREAD * (2.0 * size - 1.0))


def _needs(pitch: float, roll: float) -> float:
    """How long a nod's rise takes, s."""
    return movement_time(max(pitch, 1.5 * abs(roll)), HEAD_FASTEST, NOD)  # rolls may add up with those around them


def _accent(actor: Actor, scene: Scene, peak: Peak, roll: float) -> None:
    low = actor.state.time
    apex = scene.edge(peak.time, low)
    pitch = raised(actor, peak.semitones)
    if pitch <= 0.0 and roll == 0.0:
        return
    onset = max(low, min(scene.edge(peak.before, low), _at_or_before(scene, apex - _needs(pitch, roll))))
    room = max(1e-6, apex - onset)
    share = min(1.0, room / _needs(pitch, roll))
    pitch, roll = pitch * share, roll * share
    slower = 2.0 if onset < actor.memory.head_until else 1.0  # it comes back from a question at the same time
    end = max(scene.edge(peak.after, low), apex + slower * _needs(pitch, roll))
    why = peak.why if share == 1.0 else f"{peak.why}, cut short"
    actor.head((onset, apex, apex, end), pitch, roll, "head at maximum", why)


def _at_or_before(scene: Scene, time: float) -> float:
    """The last phone boundary up to a time; the time itself where speech has not begun."""
    before = scene.between(time - 0.5, time)
    return before[-1] if before else time


def _question(actor: Actor, scene: Scene, held: tuple[Question, float], roll: float) -> None:
    question, until = held
    semitones = max((peak.semitones for peak in scene.peaks if peak.time in question), default=0.0)
    pitch = max(actor.face.question_raise, raised(actor, semitones))
    if actor.face.question_raise <= 0.0:
        return
    onset = max(actor.state.time, scene.edge(question.onset))
    apex = onset + _needs(pitch, roll)
    back = max(until, apex)
    end = back + movement_time(max(pitch, 1.5 * abs(roll)), HEAD_FASTEST, SETTLE)
    actor.note(head_until=end, held=max(actor.memory.held, back))
    actor.head((onset, apex, back, end), pitch, roll, "question", f"on {question.text!r}")
