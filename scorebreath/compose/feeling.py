"""How a body is at a moment: what its next events are placed with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from scorebreath.compose.lungs import Levels
from scorebreath.compose.state import BodyState
from scorebreath.parameters.derive import LowLevel
from scorebreath.parameters.modifiers import Modifiers
from scorebreath.score.events import Lead, Motion


@dataclass(frozen=True, slots=True, kw_only=True)
class Feeling:
    """A body at a moment, as its breathing model sees it."""

    modifiers: Modifiers
    """what person and states change"""
    low: LowLevel
    """Eq. 1 with the shares of the moment"""
    levels: Levels
    motion: Motion
    """what a unit of volume moves"""
    thorax_share: float
    """of the volume, on the grid"""
    lead: Lead
    """how far the face moves ahead of the flow"""
    lives: bool
    """whether it breathes at rest and has states: the papers' driver does neither"""


Feels = Callable[[BodyState, float], Feeling]
"""A breathing model's own: the feeling of a body at a time, s."""
