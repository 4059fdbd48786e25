"""How long a sound takes from the engine through the device and back: a click that is played and listened for."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from scorebreath.engine.engines import DEFAULT, engine_named
from scorebreath.engine.live import orders
from scorebreath.engine.live.backend import Device
from scorebreath.engine.live.process import StartedBackend
from scorebreath.engine.live.sounder import LOOKAHEAD
from scorebreath.engine.live.timing import LiveClock
from scorebreath.engine.osc import bundle, message
from scorebreath.errors import EngineError
from scorebreath_synthdefs.catalogue import CLICK

_LENGTH = 1.0
"""s that are listened: more than any device is late"""
_ANSWER = 5.0  # s
_FAINTEST = 1e-3
_CLEAR = 8.0
"""times the usual amplitude that a click must stand out"""
_NODE, _BUFFER = 2000, 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Loopback:
    """What was found."""

    round_trip: float | None
    """s from the engine's output through the device to its input; None: nothing came back"""
    level: float
    """amplitude of what came back, of a click of 0.5"""
    sample_rate: int
    """Hz; 0 where no engine ran"""
    about: str
    """in words"""


def measure(name: str = DEFAULT, device: Device | None = None, *, ready: Callable[[], None] | None = None) -> Loopback:
    """Play a click on a live engine of ours and listen for it on the first input.

    Args:
        name: `embedded`, `scsynth` or `scsynth:FILE`.
        device: What it plays on and listens to.
        ready: Called when the engine runs, before the click: to connect its outputs with its inputs.

    Returns:
        What came back, or words for why nothing did: without an input nothing can be measured.

    Raises:
        InputError: There is no such engine.
        EngineError: It does not run on the device, or fails.
    """
    if name == "silent" or name.startswith("scsynth@"):
        return _nothing(f"{name}: only an engine that we start can listen to itself")
    engine = engine_named(name)
    asked = replace(device or Device(), inputs=1)
    backend = StartedBackend(engine, asked)
    try:
        rate = backend.start()
    except EngineError as error:
        with_output = StartedBackend(engine, replace(asked, inputs=0))
        with_output.start()
        with_output.close()
        return _nothing(f"there is no input: the engine runs without one only ({str(error).splitlines()[0]})")
    try:
        if ready is not None:
            ready()
        with tempfile.TemporaryDirectory(prefix="scorebreath-") as folder:
            heard = _listen(backend, rate, Path(folder) / "heard.raw")
    finally:
        backend.close()
    return _judged(heard, rate)


def _nothing(about: str) -> Loopback:
    return Loopback(round_trip=None, level=0.0, sample_rate=0, about=about)


def _listen(backend: StartedBackend, rate: int, path: Path) -> NDArray[np.float32]:
    """What the input heard from the click's first sample on, (n,)."""
    frames = round(_LENGTH * rate)
    _done(backend, orders.instrument(CLICK), ("/d_recv",))
    _done(backend, message("/b_alloc", _BUFFER, frames, 1), ("/b_alloc", _BUFFER))
    clock = LiveClock(start=time.time(), sample_rate=rate)
    click = orders.synth(CLICK, _NODE, 0, 0, {"buffer": float(_BUFFER)})
    backend.send(bundle(clock.tag(LOOKAHEAD), [click]))
    time.sleep(LOOKAHEAD + _LENGTH + 0.1)
    _done(backend, message("/b_write", _BUFFER, str(path), "raw", "float", -1, 0, 0), ("/b_write", _BUFFER))
    try:
        return np.fromfile(path, dtype=np.float32)
    except OSError as error:
        raise EngineError(f"the engine wrote nothing down: {error.strerror}") from None


def _done(backend: StartedBackend, order: bytes, first: tuple[object, ...]) -> None:
    if not backend.done(order, "/done", first, _ANSWER):
        raise EngineError(f"the {backend.name} engine does not answer to {first[0]}")


def _judged(heard: NDArray[np.float32], rate: int) -> Loopback:
    """Where the click begins in what was heard, if it is there."""
    loud = np.abs(heard)
    level = float(loud.max(initial=0.0))
    if not level > max(_FAINTEST, _CLEAR * float(np.median(loud)) if len(loud) else 0.0):
        about = "no click came back: is the output connected to the input, and loud enough?"
        return Loopback(round_trip=None, level=level, sample_rate=rate, about=about)
    trip = int(np.flatnonzero(loud > level / 2)[0]) / rate
    return Loopback(
        round_trip=trip, level=level, sample_rate=rate, about=f"{1000 * trip:.1f} ms from the output back to the input"
    )
