"""Breathing states as a table (`states.toml`; physiology 4.2), and how they come and go."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """A state goes from one intensity to another, linearly over `ramp`, and may then fade by itself."""

    name: str
    time: float
    """s"""
    start: float
    """0..1"""
    target: float
    """0..1"""
    ramp: float
    """s"""
    recovery: float = 0.0
    """time constant of fading after the ramp, s; 0: it stays"""

    def at(self, time: float) -> float:
        """Intensity at a time not before `self.time`."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True, kw_only=True)
class Blend:
    """The states of a body: the latest change of each."""

    changes: Mapping[str, Change] = field(default_factory=dict)

    def at(self, time: float) -> dict[str, float]:
        """States in force at a time, with their intensities; those at 0 are left out."""
        raise NotImplementedError

    def changed(
        self, time: float, name: str, intensity: float, ramp: float, *, held: bool = False
    ) -> tuple[Blend, tuple[Change, ...]]:
        """A state is set: it goes to `intensity`; a mood takes the place of other moods, `neutral` of all states.

        Args:
            time: s, not before any earlier change.
            name: Of a state in the table, or `neutral`.
            intensity: 0..1.
            ramp: s.
            held: Whether it stays where it would recover by itself.

        Returns:
            The blend from then on, and the changes that began.

        Raises:
            InputError: There is no such state; names what may be meant.
        """
        raise NotImplementedError
