"""Which engines there are and which work: each is made to breathe for a moment."""

from __future__ import annotations

import io
from dataclasses import dataclass

from scorebreath.engine.engines import ENGINES, engine_named
from scorebreath.engine.offline import render_sounds
from scorebreath.engine.onsets import Onset
from scorebreath.errors import EnvironmentFailure
from scorebreath.media.store import MemoryStore
from scorebreath_synthdefs.catalogue import breath_name

_LENGTH = 0.06  # s of the breath that is tried
_PATIENCE = 30.0  # s


@dataclass(frozen=True, slots=True, kw_only=True)
class EngineReport:
    """What one engine can do here."""

    name: str
    about: str
    works: bool
    version: str
    """empty where it is not installed"""
    problem: str
    """empty where it works"""
    remedy: str
    """how to get it"""


def check_engine(name: str) -> EngineReport:
    """Find an engine, ask its version, and let it render a breath.

    Args:
        name: As for `render`.

    Raises:
        InputError: There is no such engine.
    """
    engine = engine_named(name)
    version, problem = "", ""
    try:
        version = engine.version()
        sound = Onset(
            time=0.0, duration=_LENGTH, instrument=breath_name("mouth", "male"), event="check",
            controls={"level": 0.1, "attack": 0.02, "hold": 0.02, "release": 0.02, "seed": 1.0},
        )  # fmt: skip
        done = render_sounds([sound], MemoryStore(), io.BytesIO(), duration=0.1, engine=engine, timeout=_PATIENCE)
        if done.peak_db < -40:
            problem = "it made no sound"
    except EnvironmentFailure as error:  # also a disk without room: this engine does not work now
        problem = str(error)
    return EngineReport(
        name=engine.name, about=engine.about, works=not problem, version=version, problem=problem, remedy=engine.remedy
    )


def check_engines() -> tuple[EngineReport, ...]:
    """All engines of the table."""
    return tuple(check_engine(name) for name in ENGINES)
