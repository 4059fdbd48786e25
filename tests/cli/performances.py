"""Performances for tests: the program on a silent engine, with the voice that hums, under somebody's hands."""

from __future__ import annotations

import json
import os
import re
import select
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.cli.running import ENVIRONMENT, PROGRAM

QUIET = ("--engine", "silent", "--voice", "tone", "--no-osc")
PATIENCE = 60.0
"""s after which a test gives up; none of them measures time."""
_CODES = re.compile(r"\x1b\[[0-9;?]*[ -/]*[@-~]|\x1b[()][A-Z0-9]|\x1b[=>]")


@contextmanager
def performance(*arguments: object, **options: Any) -> Iterator[subprocess.Popen[bytes]]:
    """`live`, running; it ends with the test."""
    with program("live", *QUIET, *arguments, **options) as process:
        yield process


@contextmanager
def program(*arguments: object, **options: Any) -> Iterator[subprocess.Popen[bytes]]:
    """Any command, running; it ends with the test."""
    for stream in ("stdin", "stdout", "stderr"):
        options.setdefault(stream, subprocess.PIPE)
    options.setdefault("env", ENVIRONMENT)
    line = [*PROGRAM, *(str(each) for each in arguments)]
    with subprocess.Popen(line, **options) as process:
        try:
            yield process
        finally:
            process.kill()


def told(process: subprocess.Popen[bytes], until: str = "") -> list[dict[str, Any]]:
    """What `--json` tells, up to an event of that name, or to the end."""
    assert process.stdout is not None
    found: list[dict[str, Any]] = []
    for line in process.stdout:
        found.append(json.loads(line))
        if found[-1]["event"] == until:
            return found
    assert not until, (until, found)
    return found


def journal(take: Path) -> list[dict[str, Any]]:
    """What the engine was told."""
    return [json.loads(line) for line in (take / "journal.jsonl").read_text("utf-8").splitlines()]


class Screen:
    """A terminal that somebody types on.

    Args:
        descriptor: Its other end.
    """

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        self._raw = b""

    def type(self, keys: str) -> None:
        os.write(self._descriptor, keys.encode())

    @property
    def text(self) -> str:
        """All that was shown, without its colours."""
        return _CODES.sub("", self._raw.decode("utf-8", "replace"))

    @property
    def raw(self) -> str:
        return self._raw.decode("utf-8", "replace")

    def forget(self) -> None:
        """What was shown does not count any more."""
        self._raw = b""

    def wait(self, wanted: str) -> None:
        """Until it shows something."""
        until = time.monotonic() + PATIENCE
        while wanted not in self.text:
            assert time.monotonic() < until, f"{wanted!r} is not shown:\n{self.text[-3000:]}"
            self.look(0.1)

    @property
    def frame(self) -> str:
        """The last picture that is complete."""
        frames = self.raw.split("\x1b[H")
        return _CODES.sub("", frames[-2]) if len(frames) > 1 else ""

    def wait_until(self, wanted: Callable[[str], bool]) -> None:
        """Until a picture is as wanted."""
        until = time.monotonic() + PATIENCE
        while not wanted(self.frame):
            assert time.monotonic() < until, self.frame
            self.look(0.1)

    def look(self, seconds: float) -> bool:
        """Take in what is shown; whether there is anybody any more."""
        if select.select([self._descriptor], [], [], seconds)[0]:
            try:
                data = os.read(self._descriptor, 65536)
            except OSError:  # nobody writes any more
                return False
            self._raw += data
            return bool(data)
        return True
