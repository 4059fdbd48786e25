"""Engines that run, as a sounder needs them: one that runs already, and silence."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Protocol

from scorebreath.engine.live.layout import GUEST, Layout, own_layout
from scorebreath.engine.live.link import Link, Reply
from scorebreath.engine.osc import message
from scorebreath.engine.rates import SAMPLE_RATE
from scorebreath.errors import EngineError

DEAF = 3.0
"""s without an answer after which an engine is taken for dead."""


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


class Linked:
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


class RunningBackend(Linked):
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
