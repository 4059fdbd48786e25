"""A JACK server without a sound card, for tests: each has its own name, so that many may run at a time."""

from __future__ import annotations

import itertools
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import IO

import pytest

RATE = 48000
needs_jack = [
    pytest.mark.jack,
    pytest.mark.scsynth,
    pytest.mark.skipif(
        shutil.which("jackd") is None or shutil.which("scsynth") is None, reason="needs jackd and scsynth"
    ),
]
_NUMBERS = itertools.count()
TURNS = 15
"""Times that a server is begun."""
_BEGINS = 20.0
"""s that a server may take to begin"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Jack:
    """A server that runs."""

    name: str
    env: Mapping[str, str]
    """what a program's environment needs, so that it finds this server and begins no other"""
    process: subprocess.Popen[bytes]
    _log: IO[bytes]

    def xruns(self) -> int:
        """How often it could not keep time, and dropped blocks, so far."""
        said = os.pread(self._log.fileno(), os.fstat(self._log.fileno()).st_size, 0)
        return said.count(b"XRun")


@contextmanager
def jack_server(*, synchronous: bool = True) -> Iterator[Jack]:
    """Start `jackd` with the dummy driver, wait until it takes clients, and end it behind.

    The environment of this process points to it meanwhile. Skips the test where there is no `jackd`. A synchronous
    server waits five seconds for a client that was killed, and so does whoever comes next.
    """
    if not shutil.which("jackd"):
        pytest.skip("jackd is not installed")
    name = f"sbt-{os.getpid()}-{next(_NUMBERS)}"  # short: with 24 characters, JACK 1.9.21 clients overrun their memory
    env = {"JACK_DEFAULT_SERVER": name, "JACK_NO_START_SERVER": "1", "JACK_NO_AUDIO_RESERVATION": "1"}
    before = {key: os.environ.get(key) for key in env}
    command = ["jackd", "-r", *(["-S"] if synchronous else []), "-n", name, "-d", "dummy", "-r", str(RATE), "-p", "256"]
    os.environ.update(env)
    log = tempfile.TemporaryFile()  # noqa: SIM115 - closed below, after its writer
    process = _begun(command, name, log)
    try:
        yield Jack(name=name, env=env, process=process, _log=log)
    finally:
        end(process)
        log.close()
        for key, value in before.items():
            if value is None:
                os.environ.pop(key, None)
            else:
                os.environ[key] = value


def end(process: subprocess.Popen[bytes]) -> None:
    """End a process of ours, and wait for it; does nothing the second time."""
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(10.0)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def connect(source: str, target: str) -> None:
    """Connect two ports of the server that is in use."""
    subprocess.run(["jack_connect", source, target], capture_output=True, timeout=10, check=True)


def _begun(command: list[str], name: str, log: IO[bytes]) -> subprocess.Popen[bytes]:
    """A server that takes clients. A machine holds a few of them only: where others run, it waits for its turn."""
    for _ in range(TURNS):
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        if _await(process, name):
            return process
        end(process)
        time.sleep(1.0)
    pytest.skip("jackd with the dummy driver does not begin here, or too many of them run")


def _await(process: subprocess.Popen[bytes], name: str) -> bool:
    """Until it takes clients: `jack_lsp` tells, or, where there is none, a client of ours; whether it does."""
    until = time.monotonic() + _BEGINS
    while process.poll() is None and time.monotonic() < until:
        asked = shutil.which("jack_lsp")
        if asked:
            if subprocess.run([asked, "-s", name], capture_output=True, check=False).returncode == 0:
                return True
        elif _takes_midi():
            return True
        time.sleep(0.05)
    return False


def _takes_midi() -> bool:
    rtmidi = pytest.importorskip("rtmidi", reason="python-rtmidi is not installed")
    try:
        client = rtmidi.MidiIn(rtmidi.API_UNIX_JACK)
    except OSError:
        return False
    client.delete()
    return True
