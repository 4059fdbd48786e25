"""Engines that run: one that we start, one that runs already, and silence. The flags are scsynth's."""

from __future__ import annotations

import contextlib
import re
import socket
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from scorebreath.engine.engines import Engine
from scorebreath.engine.failures import ending, words
from scorebreath.engine.live.guard import DONE
from scorebreath.engine.live.layout import GUEST, Layout, own_layout
from scorebreath.engine.live.link import Link, Reply
from scorebreath.engine.osc import message
from scorebreath.engine.rates import SAMPLE_RATE
from scorebreath.errors import EngineError

BOOT = 20.0
"""s that an engine may take to answer."""
DEAF = 3.0
"""s without an answer after which an engine is taken for dead."""
_LATE = re.compile(r"^late\s+(\d+(?:\.\d*)?)")
_KEPT = 40  # lines of what an engine said
_NOT_FOUND = "matching device NOT found"
_OPTION = re.compile(r"^- (?P<name>\S+ : .+)$")
_LATENCY = re.compile(r"Latency \(in/out\): [\d.]+ / (?P<out>\d+\.\d+) sec")
_BLOCK = re.compile(r"driver's block size = (?P<block>\d+)")
_GONE = 1.0  # s that an ended process may take to go


class Backend(Protocol):
    """Something that OSC can be sent to."""

    @property
    def name(self) -> str:
        """Which engine, and its version."""

    @property
    def layout(self) -> Layout:
        """Which of its numbers are ours."""

    @property
    def late(self) -> int:
        """How often it said that a bundle came too late."""

    @property
    def output_latency(self) -> float:
        """Seconds from its output to the speaker, as far as it says; 0 where it does not."""

    def start(self) -> int:
        """Have it run; its sample rate, Hz. May be called again when it has ended.

        Raises:
            EngineError: It does not come.
        """

    def send(self, datagram: bytes) -> None:
        """Send one datagram."""

    def done(self, datagram: bytes, address: str, first: tuple[object, ...], timeout: float) -> bool:
        """Send one datagram and wait for the answer that begins so; whether it came."""

    def trouble(self) -> str:
        """Why it cannot be used now; empty while it can."""

    def close(self) -> None:
        """Let go of it; end it, if we started it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Device:
    """What a started engine plays on."""

    name: str = ""
    """scsynth's `-H`: of JACK `SERVER` or `SERVER:CLIENT`, else a device's name; empty: the usual one"""
    outputs: int = 2
    """channels of the engine"""
    inputs: int = 0
    sample_rate: int = 0
    """Hz; 0: the device's own"""


class SilentBackend:
    """Takes everything and does nothing."""

    name = "silent"
    late = 0
    output_latency = 0.0

    def __init__(self, sample_rate: int = SAMPLE_RATE) -> None:
        """Pretend a sample rate, Hz."""
        self._rate = sample_rate
        self.layout = own_layout(2)

    def start(self) -> int:
        """The rate."""
        return self._rate

    def send(self, datagram: bytes) -> None:
        """Nothing."""

    def done(self, datagram: bytes, address: str, first: tuple[object, ...], timeout: float) -> bool:
        """At once."""
        return True

    def trouble(self) -> str:
        """None."""
        return ""

    def close(self) -> None:
        """Nothing."""


class _Linked:
    """What engines behind a link share."""

    _link: Link | None = None

    def send(self, datagram: bytes) -> None:
        """Send one datagram."""
        if self._link is not None:
            self._link.send(datagram)

    def done(self, datagram: bytes, address: str, first: tuple[object, ...], timeout: float) -> bool:
        """Send one datagram and wait for the answer that begins so; whether it came."""
        link = self._link

        def wanted(reply: Reply) -> bool:
            return reply[0] == address and reply[1][: len(first)] == first

        return link is not None and link.ask(datagram, wanted, timeout) is not None

    def _ask_status(self, link: Link, timeout: float) -> bool:
        reply = link.ask(message("/status"), lambda reply: reply[0] == "/status.reply", timeout)
        return reply is not None

    def _deaf(self, link: Link) -> str:
        """Ask how it does, and say so if it has not answered for long."""
        link.status()
        return "does not answer" if time.monotonic() - link.heard > DEAF else ""

    def _unlink(self) -> None:
        link, self._link = self._link, None
        if link is not None:
            link.close()


class RunningBackend(_Linked):
    """An engine that somebody else started. It is left running, without anything of ours."""

    late = 0
    output_latency = 0.0
    layout = GUEST

    def __init__(self, host: str, port: int) -> None:
        """Where it is."""
        self.host, self.port = host, port
        self.name = f"scsynth@{host}:{port}"

    def start(self) -> int:
        """Find it, and clear away what an earlier performance may have left."""
        self._unlink()
        try:
            link = Link(self.host, self.port)
        except OSError as error:
            raise EngineError(f"{self.name}: {error.strerror or error}") from None
        until = time.monotonic() + DEAF
        while not self._ask_status(link, 0.3):
            if time.monotonic() > until:
                link.close()
                raise EngineError(f"{self.name}: nothing answers there; is scsynth running, and is that its UDP port?")
        self._link = link
        self.send(message("/n_free", self.layout.root))
        return round(link.rate)

    def trouble(self) -> str:
        """Whether it still answers."""
        return "was let go" if self._link is None else self._deaf(self._link)

    def close(self) -> None:
        """Take our group away and leave."""
        self.send(message("/n_free", self.layout.root))
        self._unlink()


class StartedBackend(_Linked):
    """An engine in a process of ours: scsynth, or the embedded engine's look-alike."""

    def __init__(self, engine: Engine, device: Device | None = None) -> None:
        """Which one, and what it plays on."""
        self.engine = engine
        self.device = device if device is not None else Device()
        self.layout = own_layout(self.device.outputs + self.device.inputs)
        self.name = engine.name
        self.late = 0
        self.output_latency = 0.0
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
        port = free_port()
        self._said.clear()
        try:
            self._process = subprocess.Popen(
                [*self.engine.command(), *self._flags(port)],
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                encoding="utf-8", errors="replace", bufsize=1,
            )  # fmt: skip
        except OSError as error:
            raise EngineError(f"the {self.engine.name} engine does not start: {error}") from None
        self._guard = subprocess.Popen(
            [sys.executable, "-I", "-S", str(Path(__file__).with_name("guard.py")), str(self._process.pid)],
            stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
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
        return [*flags, "-H", device.name] if device.name else flags

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
