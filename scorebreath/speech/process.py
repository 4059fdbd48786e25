"""One worker process with its pipes: write, read, wait no longer than a deadline, leave nothing behind."""

from __future__ import annotations

import atexit
import json
import os
import subprocess
import sys
import tempfile
import weakref
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import IO, Any, BinaryIO, cast

from scorebreath.errors import VoiceError
from scorebreath.speech.deadline import Deadline
from scorebreath.speech.wire import WireError, read_message

GRACE = 2.0
"""s a worker has to end by itself when its stdin is closed"""
SINGLE_THREADED = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Numerical libraries start a thread for each core unless told otherwise; a worker has no use for them."""
LAST_WORDS = 2000
"""bytes of a dead worker's stderr that are searched for its last line"""

_BOOT = "import json, sys; sys.path[:] = json.loads(sys.argv.pop(1)); from {module} import main; main()"


def module_command(module: str, *arguments: str) -> tuple[str, ...]:
    """The command that runs `main()` of a module in a new interpreter.

    It finds what this one finds: a checkout on `sys.path` serves as well as an installed package. A file in the working
    directory named like a module is not taken for it (`-P`).
    """
    path = [str(Path(entry).resolve()) for entry in sys.path if isinstance(entry, str)]
    return (sys.executable, "-P", "-c", _BOOT.format(module=module), json.dumps(path), *arguments)


def start_ahead(command: Sequence[str]) -> None:
    """Start a process that the next `start` with this command will give, so that it gets ready while we import."""
    if not _ahead:
        atexit.register(_abandon)
    _ahead.setdefault(tuple(command), Process(command))


def start(command: Sequence[str]) -> Process:
    """A process that runs a command: the one started ahead, or a new one.

    Raises:
        VoiceError: The system cannot start it.
    """
    return _ahead.pop(tuple(command), None) or Process(command)


class Process:
    """A live worker. It ends with `end`, when nobody refers to it, and at the latest when this program does."""

    def __init__(self, command: Sequence[str]) -> None:
        """Start it; it gets ready while we go on.

        Args:
            command: Program and arguments.

        Raises:
            VoiceError: The system cannot start it.
        """
        self._words: IO[bytes] = tempfile.TemporaryFile()  # noqa: SIM115 - closed by _end
        try:
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._words,
                env={**os.environ, **SINGLE_THREADED},
            )
        except OSError as error:
            self._words.close()
            raise VoiceError(f"the voice's worker process does not start: {error}") from error
        self._deadline = Deadline(self._process.kill)
        self.end = weakref.finalize(self, _end, self._process, self._words, self._deadline)

    @property
    def pid(self) -> int:
        """Process id."""
        return self._process.pid

    def write(self, message: bytes, deadline: float) -> None:
        """Send; if the worker is dead, `read` will tell."""
        assert self._process.stdin is not None
        with self._deadline.within(deadline), suppress(OSError):
            self._process.stdin.write(message)
            self._process.stdin.flush()

    def read(self, deadline: float) -> tuple[dict[str, Any], bytes] | None:
        """The next answer, or None when there will be none: the worker is dead then, and `why` says how it died."""
        message = None
        answers = cast(BinaryIO, self._process.stdout)
        with self._deadline.within(deadline), suppress(WireError, OSError):
            message = read_message(answers)
        return message

    def kill(self) -> None:
        """End it without waiting for anything; call `end` afterwards."""
        self._process.kill()

    def why(self) -> str:
        """How it failed, with the last line it printed; call before `end`."""
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(GRACE)
        self._words.seek(0, os.SEEK_END)
        self._words.seek(max(0, self._words.tell() - LAST_WORDS))
        lines = [line.strip() for line in self._words.read().decode("utf-8", "replace").splitlines()]
        said = next((line for line in reversed(lines) if line), "")
        missed = self._deadline.missed
        crashed = f"its worker crashed (exit status {self._process.returncode})"
        what = crashed if missed is None else f"no answer within {missed:.3g} s"
        return f"{what}: {said}" if said else what


_ahead: dict[tuple[str, ...], Process] = {}
"""Processes that nobody has asked for yet."""


def _abandon() -> None:
    while _ahead:
        _, process = _ahead.popitem()
        process.kill()
        process.end()


def _end(process: subprocess.Popen[bytes], words: IO[bytes], deadline: Deadline) -> None:
    """Close the pipes, which ends the worker; kill it if it does not."""
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            with suppress(OSError):
                stream.close()
    try:
        process.wait(GRACE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    deadline.close()
    words.close()
