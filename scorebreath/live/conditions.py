"""How far ahead things are decided, and who hears of them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from typing import Protocol

from scorebreath.engine.onsets import Onset
from scorebreath.media.store import MediaStore
from scorebreath.score.events import EVENTS
from scorebreath.score.performing import Heard

LEAD = max(reach.lead for _, reach in EVENTS.values())
"""s that an event reaches before its onset, at most."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Timing:
    """How far ahead of the sound things are decided, s."""

    lookahead: float = 0.15
    """that the engine is told of a sound before it begins"""
    curve_lead: float = 0.0
    """that curves are sent before they are due"""
    margin: float = 0.1
    """that a decision may take"""
    patience: float = 0.6
    """after which what has been streamed is taken as it stands, if nothing more comes"""

    @property
    def reaction(self) -> float:
        """From a command to what it brings about."""
        return max(self.lookahead, self.curve_lead) + 0.03

    @property
    def nudge(self) -> float:
        """From a move to what it does to the sound."""
        return max(0.0, self.curve_lead) + 0.06

    @property
    def ahead(self) -> float:
        """Before an event's onset, within which nothing of it can be decided any more."""
        return self.reaction + LEAD + self.margin


class Sounder(Protocol):
    """What sounds; `engine.live` has several. Nothing here waits."""

    def play(self, sounds: Sequence[Onset], media: MediaStore) -> None:
        """These sound when they say."""

    def cut(self, time: float, targets: Collection[str], fade: float) -> None:
        """Events end then: their sounds fade, those to come never begin."""

    def move(self, time: float, body: str, heard: Heard, glide: float) -> None:
        """What sounds of a body changes."""

    def panic(self) -> None:
        """Silence at once."""


@dataclass(slots=True, kw_only=True)
class Counts:
    """What happened so far, in numbers. It counts, so it changes."""

    groups: int = 0
    late: int = 0
    """groups that began later than they should have"""
    latest: float = 0.0
    """s, the most"""
    unspoken: int = 0
    """groups that the voice failed at"""
    cuts: int = 0
    """interruptions: by a command, or by words that are cut in"""
    stalls: int = 0
    """times the performer itself was held up for so long that something could not be decided in time"""


Told = Callable[[str], None]
"""Told in one line what somebody should know."""
