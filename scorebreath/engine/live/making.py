"""Sounders by name: which engine plays live, and on what."""

from __future__ import annotations

import re
from typing import Any

from scorebreath.engine.engines import DEFAULT, engine_named
from scorebreath.engine.live.backend import Backend, Device, RunningBackend, SilentBackend
from scorebreath.engine.live.process import StartedBackend
from scorebreath.engine.live.server import LiveServer
from scorebreath.errors import InputError

SILENT = "silent"
NAMES = (DEFAULT, "scsynth", "scsynth:FILE", "scsynth@HOST:PORT", SILENT)
"""What a live engine is asked for by."""
_RUNNING = re.compile(r"scsynth@(?P<host>[^:@\s]+|\[[0-9a-fA-F:]+\]):(?P<port>\d{1,5})\Z")


def backend_named(name: str = DEFAULT, device: Device | None = None) -> Backend:
    """An engine to play live on, not yet running.

    Args:
        name: `embedded`, `scsynth`, `scsynth:FILE`, one that runs already as `scsynth@HOST:PORT`, or `silent`.
        device: What an engine of ours plays on.

    Raises:
        InputError: There is no such engine, or a device is given to one that has its own.
    """
    if name == SILENT and device is not None and device.name:
        raise InputError(f"device={device.name!r}: the silent engine has none")
    if name == SILENT:
        return SilentBackend(*((device.sample_rate,) if device is not None and device.sample_rate else ()))
    if name.startswith("scsynth@"):
        found = _RUNNING.match(name)
        if found is None or not 0 < int(found["port"]) < 65536:
            raise InputError(f"engine={name!r} must be scsynth@HOST:PORT, such as scsynth@127.0.0.1:57110")
        if device is not None and device.name:
            raise InputError(f"device={device.name!r}: {name} has its own")
        return RunningBackend(found["host"], int(found["port"]))
    try:
        return StartedBackend(engine_named(name), device)
    except InputError:
        raise InputError(f"engine={name!r} must be one of {', '.join(NAMES)}") from None


def sounder_named(name: str = DEFAULT, *, device: Device | None = None, **settings: Any) -> LiveServer:
    """A sounder that is ready to play.

    Args:
        name: As for `backend_named`.
        device: What an engine of ours plays on.
        settings: Of `LiveServer`.

    Raises:
        InputError: There is no such engine, or a setting is out of range.
        EngineError: It does not come.
    """
    return LiveServer(backend_named(name, device), **settings)
