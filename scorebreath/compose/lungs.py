"""Between which levels a body breathes, and how deep it must breathe for what it is about to say (physiology 2.2)."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.parameters.modifiers import Modifiers
from scorebreath.parameters.table import Parameters
from scorebreath.score.document import Person

UPRIGHT_REST = 0.38
"""Resting level that `termination_volume` belongs to, fraction of VC (physiology 2.2)."""
RESERVE = 0.11
"""How far below the usual termination speech may end: 25 of 36 % (physiology 2.2)."""
LAST_RESORT = 0.05
"""How far below that in need: 20 %."""
HIGHEST = 0.88
"""Where the deepest breath before speech ends (physiology 2.2: loud, up to 85 %)."""
LOWEST = 0.15
"""Never below, fraction of VC (physiology 10)."""
TOP = 0.95
"""Never above (physiology 10)."""
SMALLEST = 0.065
"""The smallest breath before speech, 0.33 L of 5.1: less is hardly drawn (physiology 2.2: 0.2 to 1.8 L)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Levels:
    """Volumes a body keeps to, fractions of VC above residual volume."""

    rest: float
    """at the end of a resting expiration"""
    termination: float
    """where speech usually ends"""
    reserve: float
    """where it ends at the lowest"""
    floor: float
    """what is not gone below even in need"""


EMPTY = Levels(rest=0.0, termination=0.0, reserve=0.0, floor=0.0)
"""The papers' driver: nothing below 0."""


def levels(p: Parameters, person: Person, modifiers: Modifiers) -> Levels:
    """The levels of a body in its present state: lying down moves them with the resting level."""
    usual = p.termination_volume + person.resting_volume - UPRIGHT_REST
    termination = min(HIGHEST - 0.1, max(LOWEST + 0.02, usual + modifiers.start))
    reserve = max(LOWEST + 0.01, min(termination, usual, person.resting_volume) - RESERVE)
    return Levels(
        rest=person.resting_volume,
        termination=termination,
        reserve=reserve,
        floor=max(LOWEST, reserve - LAST_RESORT),
    )


def initiation(level: Levels, now: float, need: float, recovery: float, deviation: float) -> float:
    r"""Volume to breathe in to before speech (physiology 2.2): :math:`T + need + r |now - T| + \epsilon`.

    What the last group left too much stays in part; what it took too much is made up for by a deeper breath. A quarter
    of the capacity stays in the lungs at the end where one breath can hold that much.

    Args:
        level: The body's levels.
        now: Present volume.
        need: Volume that will be spent.
        recovery: :math:`r`, share of the deviation of the last termination that is carried over.
        deviation: :math:`\epsilon`: this breath's own.

    >>> level = Levels(rest=0.38, termination=0.36, reserve=0.25, floor=0.20)
    >>> [round(initiation(level, now, 0.162, 0.3, 0.0), 3) for now in (0.36, 0.42, 0.25)]
    [0.522, 0.54, 0.555]
    """
    wanted = level.termination + need + recovery * abs(now - level.termination) + deviation
    return min(HIGHEST, max(wanted, level.reserve + need, now + SMALLEST))
