"""Breathing states (`states.toml`; physiology 4.2), and how they come and go."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import exp, isfinite

from scorebreath.errors import InputError
from scorebreath.parameters.state_table import NEUTRAL, STATES, StateRow, find_state

__all__ = ["NEUTRAL", "STATES", "Blend", "Change", "StateRow", "find_state"]

FADED = 1e-3
"""Intensity below which a state that fades by itself is over."""


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
        """Intensity at a time; before `self.time` it is what it was then.

        >>> rise = Change(name="exertion", time=10.0, start=0.0, target=0.8, ramp=2.0, recovery=45.0)
        >>> rise.at(0.0), rise.at(11.0), rise.at(12.0), round(rise.at(57.0) / 0.8, 3)
        (0.0, 0.4, 0.8, 0.368)
        """
        if time < self.time:
            return self.start
        if time < self.time + self.ramp:
            return self.start + (self.target - self.start) * (time - self.time) / self.ramp
        if not self.recovery:
            return self.target
        left = self.target * exp((self.time + self.ramp - time) / self.recovery)
        return left if left >= FADED else 0.0

    def over(self, time: float) -> bool:
        """Whether the state is at 0 from this time on."""
        return time >= self.time + self.ramp and self.at(time) == 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Blend:
    """The states of a body: the latest change of each."""

    changes: Mapping[str, Change] = field(default_factory=dict)

    def at(self, time: float) -> dict[str, float]:
        """States in force at a time, with their intensities; those at 0 are left out."""
        levels = {name: change.at(time) for name, change in self.changes.items()}
        return {name: level for name, level in levels.items() if level > 0.0}

    def changed(
        self, time: float, name: str, intensity: float, ramp: float, *, held: bool = False
    ) -> tuple[Blend, tuple[Change, ...]]:
        """A state is set: it goes to `intensity`; a mood takes the place of other moods, `neutral` of all states.

        Args:
            time: s, not before any earlier change.
            name: Of a state in the table, in any case, or another word for it; or `neutral`.
            intensity: 0..1; at 0 the state ends, and no other does; of no matter for `neutral`.
            ramp: s.
            held: Whether it stays where it would recover by itself.

        Returns:
            The blend from then on, and the changes that began: states that end first.

        Raises:
            InputError: There is no such state; names what may be meant. Or a number is out of its range.

        >>> blend, _ = Blend().changed(0.0, "calm", 1.0, 0.0)
        >>> blend, began = blend.changed(5.0, "afraid", 0.8, 2.0)
        >>> [change.name for change in began], blend.at(6.0)
        (['calm', 'anxious'], {'calm': 0.5, 'anxious': 0.4})
        """
        row = find_state(name)
        if not 0.0 <= intensity <= 1.0:
            raise InputError(f"state {name}: intensity={intensity:g} must be a number in [0, 1]")
        if not (isfinite(ramp) and ramp >= 0.0):
            raise InputError(f"state {name}: ramp={ramp:g} must be a number of seconds, 0 or more")
        running = {key: change for key, change in self.changes.items() if not change.over(time)}
        began = [
            Change(name=key, time=time, start=change.at(time), target=0.0, ramp=ramp)
            for key, change in running.items()
            if key != row.name and _replaces(row, intensity, STATES[key])
        ]
        if row.name != NEUTRAL and (intensity > 0.0 or row.name in running):
            start = running[row.name].at(time) if row.name in running else 0.0
            recovery = 0.0 if held or not intensity else row.recovery
            began.append(Change(name=row.name, time=time, start=start, target=intensity, ramp=ramp, recovery=recovery))
        return Blend(changes=running | {change.name: change for change in began}), tuple(began)


def _replaces(new: StateRow, intensity: float, old: StateRow) -> bool:
    return new.name == NEUTRAL or (intensity > 0.0 and new.kind == "mood" and old.kind == "mood")
