"""Who moves at a pause, and when: at one pause at most one of blink, glance and search begins within 150 ms of another.

A search has a pause's beginning to itself. Where a blink and a glance are both to come, a coin says which is first if
there is room for both within the pause. Else the glance is, as it belongs into the pause; the blink comes when that is
over, if it is far enough from the glance, or not at all.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from scorebreath.expression.actor import Actor
from scorebreath.expression.scene import Scene, Silence
from scorebreath.units import snap

APART = 0.15
"""s between two of them."""
CLEAR = 1e-6
"""s more than that, one step of the grid, so that no rounding makes it less."""
SEEN = 0.1
"""s before a pause is over in which eyes still get to the listener and are seen there."""
LATER = 0.06
"""s that something in a free silence begins after the last sound, at most."""
BLINK_FIRST = 0.5
"""Share of pauses in which the blink comes before the glance."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PausePlan:
    """Onsets in one pause; None: it does not happen."""

    silence: Silence
    blink: float | None = None
    glance: float | None = None
    search: float | None = None

    @property
    def looks(self) -> tuple[float, ...]:
        """Onsets that blinks keep away from."""
        return tuple(time for time in (self.glance, self.search) if time is not None)


def plan_pauses(actor: Actor, scene: Scene) -> list[PausePlan]:
    """The pauses inside a group."""
    plans = []
    for number, silence in enumerate(scene.silences):
        asked = any(span.onset < silence.end - CLEAR and silence.onset < span.end - CLEAR for span in scene.asking)
        plans.append(plan_pause(actor, silence, number, asked=asked))
    return plans


def plan_pause(actor: Actor, silence: Silence, key: object, *, asked: bool) -> PausePlan:
    """One pause.

    Args:
        actor: Its rates and chance.
        silence: The pause.
        key: Its number in the group, for chance.
        asked: Whether the eyes are at the listener all the time: then no glance is needed.
    """
    face = actor.face
    blinks, glances, order, late, later, searches = actor.draws("pause", 6, key)
    blink, glance = blinks < face.blink_at_pause, glances < face.glance_at_pause and not asked
    search = silence.search and searches < face.word_search
    room = max(0.0, silence.end - silence.onset - APART)
    first = silence.onset + (min(LATER * late, room) if silence.free else 0.0)
    second = min(first + APART + 0.05 + 0.1 * later, silence.end) if silence.free else silence.end
    second = max(second, first + APART + CLEAR)
    fits = snap(second - silence.end) <= CLEAR
    if search:
        return PausePlan(silence=silence, search=first, blink=second if blink and fits else None)
    if not (blink and glance):
        return PausePlan(silence=silence, blink=first if blink else None, glance=first if glance else None)
    if order < BLINK_FIRST and fits and second + SEEN <= silence.end:
        return PausePlan(silence=silence, blink=first, glance=second)
    return PausePlan(silence=silence, glance=first, blink=second if fits else None)


def clear(time: float, looks: Iterable[float]) -> bool:
    """Whether a blink may begin then: no glance at a pause and no search begins beside it."""
    return all(snap(abs(time - look)) > APART for look in looks)


def beside_pauses(scene: Scene, times: Iterable[float]) -> list[float]:
    """Of some times those at a pause: in it, or so near that a blink at it would be beside them."""
    reach = APART + CLEAR
    pauses = [(scene.onset, scene.onset), *((silence.onset, silence.end) for silence in scene.silences)]
    return [time for time in times if any(low - reach <= time <= high + reach for low, high in pauses)]
