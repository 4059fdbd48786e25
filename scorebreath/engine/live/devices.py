"""What a live engine could play on here, as far as anybody can be asked."""

from __future__ import annotations

import shutil
import subprocess
import time
from dataclasses import dataclass

from scorebreath.engine.engines import Embedded, engine_named
from scorebreath.engine.live.process import devices_said, free_port
from scorebreath.engine.lookalike import READY
from scorebreath.errors import EngineError

_PATIENCE = 10.0  # s
_SILENT = "silent"


@dataclass(frozen=True, slots=True, kw_only=True)
class Devices:
    """What was found."""

    names: tuple[str, ...]
    """as `--device` takes them"""
    about: str
    """how they were found, or why there are none"""


def devices(name: str) -> Devices:
    """Devices of an engine.

    Args:
        name: As for `backend_named`.

    Raises:
        InputError: There is no such engine.
        EngineError: It is not installed.
    """
    if name == _SILENT:
        return Devices(names=(), about="the silent engine plays on nothing")
    if name.startswith("scsynth@"):
        return Devices(names=(), about=f"{name} runs already, on a device of its own")
    engine = engine_named(name)
    return _listed(engine) if isinstance(engine, Embedded) else _of_jack()


def _listed(engine: Embedded) -> Devices:
    """The engine lists devices as it starts, whether one works or not."""
    command = [*engine.command(), "-u", str(free_port()), "-i", "0", "-o", "2", "-D", "0", "-R", "0"]
    lines: list[str] = []
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
        errors="replace",
    ) as process:  # fmt: skip
        assert process.stdout is not None
        until = time.monotonic() + _PATIENCE
        try:
            for line in process.stdout:
                lines.append(line.rstrip())
                if READY in line or time.monotonic() > until:
                    break
        finally:
            process.kill()
    found = devices_said(lines)
    return Devices(names=found, about="as PortAudio knows them" if found else "PortAudio finds no sound device here")


def _of_jack() -> Devices:
    """Without JACK's own tools nobody tells; elsewhere than on Linux scsynth lists devices as it starts."""
    program = shutil.which("jack_lsp")
    if program is None:
        return Devices(names=(), about="jack_lsp is not installed: nobody can say what JACK has")
    try:
        done = subprocess.run(
            [program], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=_PATIENCE, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise EngineError(f"{program!r} does not answer: {error}") from None
    if done.returncode != 0:
        return Devices(names=(), about="no JACK server is running")
    clients = dict.fromkeys(line.partition(":")[0] for line in done.stdout.splitlines() if ":" in line)
    return Devices(
        names=tuple(clients),
        about="clients of the JACK server; scsynth connects to its physical ports, see SC_JACK_DEFAULT_OUTPUTS",
    )
