"""Search for a word: in prolonged pauses within a sentence, and on hesitation words (A32, A33, Y2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from scorebreath.equations.looking import BROW_FASTEST, movement_time
from scorebreath.expression.actor import Actor
from scorebreath.expression.brows import FALL, RISE, remember, rested
from scorebreath.expression.coordination import PausePlan
from scorebreath.expression.scene import Scene
from scorebreath.units import snap

RIGHT = -4.0
"""Degrees of yaw: slightly to the character's own right (A33; physiology 7.5)."""
UP, DOWN = 10.0, -10.0
"""Degrees of pitch (physiology 7.5)."""
FROWN, RAISE = 0.4, 0.35
SHORTEST = 0.3
"""s for which a search is seen at least."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Search:
    """A word is searched for."""

    onset: float
    end: float
    up: bool
    """to the ceiling with raised brows; else down with a frown"""
    why: str

    @property
    def target(self) -> str:
        """Where to."""
        return "up" if self.up else "down"

    @property
    def eyes(self) -> tuple[float, float]:
        """Yaw and pitch, degrees."""
        return RIGHT, UP if self.up else DOWN


def searches(actor: Actor, scene: Scene, pauses: Sequence[PausePlan]) -> list[Search]:
    """Those of a group, ascending; one that follows another at once goes on with it."""
    wanted = [
        (plan.search, plan.silence.end, f"{plan.silence.end - plan.silence.onset:.1f} s of silence")
        for plan in pauses
        if plan.search is not None
    ]
    draws = actor.draws("search", 2 * len(scene.hesitations))
    for number, word in enumerate(scene.hesitations):
        if draws[2 * number] < actor.face.word_search:
            onset = scene.edge(word.onset)
            wanted.append((onset, scene.edge(max(word.end, onset + SHORTEST)), f"on {word.text!r}"))
    found: list[Search] = []
    for number, (onset, end, why) in enumerate(sorted(wanted)):
        if found and snap(onset - found[-1].end) < SHORTEST:
            last = found.pop()
            found.append(Search(onset=last.onset, end=max(end, last.end), up=last.up, why=f"{last.why}, {why}"))
        else:
            up = actor.draws("search.where", 1, number)[0] < 0.5 and rested(actor, onset)
            if up:
                remember(actor, onset)
            found.append(Search(onset=onset, end=min(end, scene.end), up=up, why=why))
    return [search for search in found if snap(search.end - search.onset) >= SHORTEST / 2]


def search_brows(actor: Actor, found: Sequence[Search]) -> None:
    """A frown while looking down, a raise while looking up."""
    for search in found:
        height = RAISE if search.up else FROWN
        rise, fall = (movement_time(height, BROW_FASTEST, least) for least in (RISE, FALL))
        back = max(search.onset + rise, search.end)
        shape = (height, height, 0.0) if search.up else (0.0, 0.0, height)
        actor.brow((search.onset, search.onset + rise, back, back + fall), shape, "search", search.why)
