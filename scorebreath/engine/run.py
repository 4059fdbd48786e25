"""One offline run of an engine: commands in, raw samples out, and every way to fail made one error."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from threading import Event

from scorebreath.engine.clock import BLOCK
from scorebreath.engine.engines import Engine
from scorebreath.engine.failures import ending, failure, words
from scorebreath.errors import EngineError

COMMANDS, SAMPLES, _SAID = "score.osc", "mix.raw", "engine.txt"
_GLANCE = 0.02  # s between looks at how far it is
_LEAST_SECONDS, _SECONDS_A_SECOND = 60.0, 0.5
_READ_AT_MOST = 1_000_000
_FRAME = 4  # bytes of a float32 sample
_MEMORY, _NODE = 8192, 64  # kB an engine reserves, and for a sound; it touches what it needs


@dataclass(frozen=True, slots=True, kw_only=True)
class Needs:
    """What the engine must make room for."""

    buffers: int
    nodes: int
    """sounds at once"""


def run(
    engine: Engine,
    folder: Path,
    *,
    frames: int,
    sample_rate: int,
    needs: Needs,
    timeout: float | None = None,
    on_progress: Callable[[float], None] | None = None,
    stopped: Event | None = None,
) -> Path:
    """Render `folder/score.osc`; names of files in it are relative to the folder, so none needs more than ASCII.

    Args:
        engine: Which engine.
        folder: Where the commands are and the samples go.
        frames: How many are wanted; the engine may give some more.
        sample_rate: Hz.
        needs: What to make room for.
        timeout: Seconds; None allows a minute and half the length of the sound (engines take 1/500 of it).
        on_progress: Called with the share that is done.
        stopped: Set by whoever no longer wants the sound; the engine is killed then.

    Returns:
        The file of float32 samples in the machine's byte order, one channel, without a header.

    Raises:
        EngineError: Whatever went wrong, with the engine's own words.
    """
    allowed = timeout if timeout is not None else _LEAST_SECONDS + _SECONDS_A_SECOND * frames / sample_rate
    made = folder / SAMPLES
    started = time.monotonic()
    with (folder / _SAID).open("wb") as said:
        try:
            process = subprocess.Popen(
                [*engine.command(), *_flags(sample_rate, needs)],
                cwd=folder, stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT,
            )  # fmt: skip
        except OSError as error:
            raise EngineError(f"the {engine.name} engine does not start: {error}") from None
        try:
            while not _ended(process):
                if stopped is not None and stopped.is_set():
                    raise EngineError(f"the {engine.name} engine was stopped")
                if time.monotonic() - started > allowed:
                    raise EngineError(f"the {engine.name} engine was not done after {allowed:g} s", _said(folder))
                if on_progress is not None and frames:
                    on_progress(min(1.0, _size(made) / (frames * _FRAME)))
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
    _judge(engine, process.returncode, _said(folder), _size(made), frames)
    return made


def _flags(sample_rate: int, needs: Needs) -> list[str]:
    return [
        "-N", COMMANDS, "_", SAMPLES, str(sample_rate), "RAW", "float",
        "-o", "1", "-i", "0", "-D", "0", "-z", str(BLOCK), "-V", "-1",
        "-b", str(max(1024, needs.buffers)),
        "-n", str(max(1024, needs.nodes + 64)),
        "-m", str(_MEMORY + _NODE * max(1024, needs.nodes)),
    ]  # fmt: skip


def _ended(process: subprocess.Popen[bytes]) -> bool:
    try:
        process.wait(_GLANCE)
    except subprocess.TimeoutExpired:
        return False
    return True


def _judge(engine: Engine, status: int, said: tuple[str, ...], size: int, frames: int) -> None:
    found = failure(said)
    if found is not None:
        raise EngineError(f"the {engine.name} engine failed: {found[0]}", found[1])
    if status != 0:
        raise EngineError(f"the {engine.name} engine {ending(status)}", words(said))
    if size < frames * _FRAME:
        raise EngineError(f"the {engine.name} engine made {size // _FRAME} frames of {frames}", words(said))


def _said(folder: Path) -> tuple[str, ...]:
    with (folder / _SAID).open("rb") as stream:
        return tuple(stream.read(_READ_AT_MOST).decode("utf-8", "replace").splitlines())


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0
