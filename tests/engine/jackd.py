"""A JACK server without hardware for tests, and what is connected there."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

RATE = 48000
_PATIENCE = 20.0
needs_jack = [
    pytest.mark.jack,
    pytest.mark.scsynth,
    pytest.mark.skipif(
        shutil.which("jackd") is None or shutil.which("scsynth") is None, reason="needs jackd and scsynth"
    ),
]


@contextmanager
def jack_server(synchronous: bool = True) -> Iterator[str]:
    """Name of a server with the dummy driver; this process's JACK clients use it meanwhile.

    A synchronous server waits five seconds for a client that was killed, and so does whoever comes next.
    """
    name = f"scorebreath-{os.getpid()}-{uuid.uuid4().hex[:6]}"
    process = subprocess.Popen(
        ["jackd", "-r", *(["-S"] if synchronous else []), "-n", name, "-d", "dummy", "-r", str(RATE), "-p", "256"],
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    before = {key: os.environ.get(key) for key in ("JACK_DEFAULT_SERVER", "JACK_NO_START_SERVER")}
    os.environ.update(JACK_DEFAULT_SERVER=name, JACK_NO_START_SERVER="1")
    try:
        until = time.monotonic() + _PATIENCE
        while not ports():
            if process.poll() is not None or time.monotonic() > until:
                pytest.skip("jackd with the dummy driver does not start here")
            time.sleep(0.05)
        yield name
    finally:
        for key, value in before.items():
            if value is None:
                os.environ.pop(key, None)
            else:
                os.environ[key] = value
        process.terminate()
        try:
            process.wait(5)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait(5)


def ports() -> list[str]:
    """All ports of the server that is in use."""
    done = subprocess.run(["jack_lsp"], capture_output=True, text=True, timeout=10, check=False)
    return done.stdout.split() if done.returncode == 0 else []


def connect(source: str, target: str) -> None:
    """Connect two ports."""
    subprocess.run(["jack_connect", source, target], capture_output=True, timeout=10, check=True)
