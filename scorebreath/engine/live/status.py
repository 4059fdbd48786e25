"""How a live engine does."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Status:
    """Counts since the beginning."""

    alive: bool
    engine: str
    """name and version"""
    sample_rate: int
    """Hz"""
    latency: float
    """s from a sound's time to the engine's output: the limiter's look-ahead"""
    sent: int
    """bundles"""
    late: int
    """bundles of which the engine said that they came too late; of one that is not ours we do not hear it"""
    late_sent: int
    """what was given to us too late, and happened later than it should"""
    lost: int
    """sounds that never were heard: too late, or while the engine was away"""
    restarts: int
    waiting: int
    """what has its time still to come"""
    lead_min: float
    """s before its time that a sound was sent, at worst; infinite before the first"""
    lead_mean: float
    """s"""
