"""An engine in a process that we start, watch and end. The flags are scsynth's."""

from __future__ import annotations

import contextlib
import os
import re
import socket
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Iterable
from pathlib import Path

from scorebreath.engine.engines import Engine
from scorebreath.engine.failures import ending, words
from scorebreath.engine.live.backend import Device, Linked
from scorebreath.engine.live.guard import DONE
from scorebreath.engine.live.layout import own_layout
from scorebreath.engine.live.link import Link
from scorebreath.engine.osc import message
from scorebreath.errors import EngineError

BOOT = 20.0
"""s that an engine may take to answer."""
SHARED = "/dev/shm/SuperColliderServer_{port}"
"""Where Linux has what an engine shares with other programs."""
CLIENT = "scorebreath"
"""What an engine of ours is called in JACK, if it is told where to go."""
_LATE = re.compile(r"^late\s+(\d+(?:\.\d*)?)")
_NOT_FOUND = "matching device NOT found"
_OPTION = re.compile(r"^- (?P<name>\S+ : .+)$")
_LATENCY = re.compile(r"Latency \(in/out\): [\d.]+ / (?P<out>\d+\.\d+) sec")
_BLOCK = re.compile(r"driver's block size = (?P<block>\d+)")
_KEPT = 40  # lines of what an engine said
_OWN_GROUP = 0 if os.name == "posix" else None  # a terminal's Ctrl-C is for the program; it has us end in its time
_GONE = 1.0  # s that an ended process may take to go


class StartedBackend(Linked):
    """An engine in a process of ours: scsynth, or the embedded engine's look-alike."""

    def __init__(self, engine: Engine, device: Device | None = None) -> None:
        """Which one, and what it plays on."""
        self.engine = engine
        self.device = device if device is not None else Device()
        self.layout = own_layout(self.device.outputs + self.device.inputs)
        self.name = engine.name
        self.late = 0
        self.output_latency = 0.0
        self._port = 0
        self._process: subprocess.Popen[str] | None = None
        self._guard: subprocess.Popen[bytes] | None = None
        self._reader: threading.Thread | None = None
        self._said: deque[str] = deque(maxlen=_KEPT)

    @property
    def pid(self) -> int | None:
        """Of the process, while there is one."""
        return None if self._process is None else self._process.pid

    def start(self) -> int:
        """Start it and wait until it answers."""
        self._end()
        self.name = f"{self.engine.name} ({self.engine.version()})"
        port = self._port = free_port()
        self._said.clear()
        try:
            self._process = subprocess.Popen(
                [*self.engine.command(), *self._flags(port)],
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                encoding="utf-8", errors="replace", bufsize=1, process_group=_OWN_GROUP,
            )  # fmt: skip
        except OSError as error:
            raise EngineError(f"the {self.engine.name} engine does not start: {error}") from None
        self._guard = subprocess.Popen(
            [sys.executable, "-I", "-S", str(Path(__file__).with_name("guard.py")), str(self._process.pid)],
            stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, process_group=_OWN_GROUP,
        )  # fmt: skip
        self._reader = threading.Thread(target=self._read, args=(self._process,), name="engine-words", daemon=True)
        self._reader.start()
        link = Link("127.0.0.1", port)
        until = time.monotonic() + BOOT
        while not self._ask_status(link, 0.1):
            status = self._process.poll()
            if status is not None or time.monotonic() > until:
                link.close()
                self._end()
                what = ending(status) if status is not None else f"did not answer within {BOOT:g} s"
                raise EngineError(f"the {self.engine.name} engine {what}{_hint(self._said)}", words(self._said))
        self._link = link
        self.output_latency = latency_said(self._said, link.rate)
        if any(_NOT_FOUND in line for line in self._said):  # it plays on another one instead
            self.close()
            raise EngineError(f"device={self.device.name!r} is not there", devices_said(self._said))
        return round(link.rate)

    def trouble(self) -> str:
        """Whether its process lives and answers."""
        process, link = self._process, self._link
        if process is None or link is None:
            return "is not running"
        status = process.poll()
        return ending(status) if status is not None else self._deaf(link)

    def close(self) -> None:
        """Ask it to quit, and see that it does."""
        self.send(message("/quit"))
        self._end(_GONE)

    def _flags(self, port: int) -> list[str]:
        device = self.device
        flags = [
            "-u", str(port), "-B", "127.0.0.1", "-o", str(device.outputs), "-i", str(device.inputs),
            "-D", "0", "-R", "0", "-l", "8", "-n", "4096", "-m", "65536",
        ]  # fmt: skip
        if device.sample_rate:
            flags += ["-S", str(device.sample_rate)]
        return [*flags, "-H", self._device_name()] if device.name else flags

    def _device_name(self) -> str:
        """As scsynth's `-H` takes it: where that is JACK, a word alone would be a client's name and not a server's."""
        name = self.device.name
        jack = sys.platform == "linux" and self.engine.name == "scsynth"
        return f"{name}:{CLIENT}" if jack and ":" not in name else name

    def _read(self, process: subprocess.Popen[str]) -> None:
        assert process.stdout is not None
        for line in process.stdout:
            if _LATE.match(line):
                self.late += 1
            elif line.strip():
                self._said.append(line.rstrip())
        process.stdout.close()

    def _end(self, patience: float = 0.0) -> None:
        self._unlink()
        process, self._process = self._process, None
        if process is None:
            return
        try:
            process.wait(patience)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait(_GONE)
        with contextlib.suppress(OSError):  # one that was killed leaves its shared memory behind
            Path(SHARED.format(port=self._port)).unlink()
        if self._reader is not None:
            self._reader.join(_GONE)
        guard, self._guard = self._guard, None
        if guard is not None:
            with contextlib.suppress(OSError, subprocess.TimeoutExpired):
                guard.communicate(DONE, timeout=_GONE)
            guard.kill()
            guard.wait()


def devices_said(lines: Iterable[str]) -> tuple[str, ...]:
    """Names of devices that an engine listed.

    >>> devices_said(["Device options:", "- ALSA : default", "  (128 ins, 128 outs)"])
    ('ALSA : default',)
    """
    return tuple(found["name"] for line in lines if (found := _OPTION.match(line)))


def latency_said(lines: Iterable[str], rate: float) -> float:
    """Output latency in s: PortAudio's own number, or two of the driver's blocks, which JACK keeps usually.

    >>> latency_said(["  Latency (in/out): 0.000 / 0.009 sec"], 48000)
    0.009
    >>> latency_said(["SC_AudioDriver: sample rate = 48000.000000, driver's block size = 240"], 48000)
    0.01
    """
    for line in lines:
        if found := _LATENCY.search(line):
            return float(found["out"])
        if found := _BLOCK.search(line):
            return 2 * int(found["block"]) / rate
    return 0.0


def free_port() -> int:
    """A UDP port that nobody uses."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])


def _hint(said: deque[str]) -> str:
    """What to do about what it said, as far as we know it."""
    text = "\n".join(said)
    if "jack server is not running" in text.lower() or "could not initialize audio" in text.lower():
        if sys.platform == "linux":
            return "; it has no sound device: start JACK (jackd, or PipeWire's pw-jack), or use --engine silent"
        return "; it has no sound device"
    return ""
