"""An OSC server in front of a desk: one thread, one socket, and bounds on everything that a stranger can send."""

from __future__ import annotations

import heapq
import selectors
import socket
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from types import TracebackType
from typing import Self

from scorebreath.errors import EnvironmentFailure, ScorebreathError
from scorebreath.live.controls.addresses import ANSWERS, ERROR, NoAddressError, hint
from scorebreath.live.controls.limits import Leave, Listeners, Sender
from scorebreath.live.controls.osc_actions import Actions, Answer
from scorebreath.live.controls.packets import Message, read_packet, write_bundles, write_message
from scorebreath.live.desk import Desk, Setting

HOST, PORT = "127.0.0.1", 57130
FARTHEST = 60.0
"""s that a time tag may lie ahead"""
MOST_WAITING = 4096
"""messages that wait for their time tags"""
TELLING = 0.02
"""s between two packets of changes: of each parameter, only the latest value is told"""
FLOOD = 1 << 22
"""Bytes that the system is asked to keep for us until we look; it gives what it likes."""
_LONGEST_ERROR = 300
_AT_A_TIME = 64


@dataclass(slots=True, kw_only=True)
class OscReport:
    """What a server has met, counted since it began."""

    received: int = 0
    """packets"""
    dropped: int = 0
    """packets that are no OSC"""
    applied: int = 0
    """messages done"""
    refused: int = 0
    """messages that named or asked what there is not, or were due too far ahead"""
    waiting: int = 0
    """messages that wait for their time tags"""
    listening: int = 0
    unanswered: int = 0
    """answers held back, because there were too many"""
    failed: int = 0
    """messages and changes at which the desk or the network failed: our bug, or a network that is gone"""


@dataclass(order=True, slots=True)
class _Waiting:
    due: float
    number: int
    message: Message = field(compare=False)
    sender: Sender = field(compare=False)


class OscServer:
    """Listens for OSC by UDP and does what it says; answers whoever sent it, and tells those who listen."""

    def __init__(
        self,
        desk: Desk,
        *,
        host: str = HOST,
        port: int = PORT,
        wall: Callable[[], float] = time.time,
        steady: Callable[[], float] = time.monotonic,
    ) -> None:
        """Prepare; `start` begins.

        Args:
            desk: What is moved.
            host: Address to listen at; only this machine, unless told otherwise.
            port: UDP port; 0 takes any free one.
            wall: s since 1970, for time tags.
            steady: s on a clock that never jumps, for limits.
        """
        self._desk, self._host, self._wanted, self._wall, self._steady = desk, host, port, wall, steady
        self._listeners = Listeners()
        self._actions = Actions(desk, self._listeners)
        self._errors = Leave(5.0, 10.0, 8.0)
        self._answers = Leave(200.0, 400.0, 8.0)
        self._report = OscReport()
        self._waiting: list[_Waiting] = []
        self._came: deque[tuple[bytes, Sender]] = deque()
        self._number = 0
        self._changes: dict[tuple[str, str], Setting] = {}
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._stopping = False
        self._told = 0.0
        self.port = port
        """the port in use, once started"""

    def start(self) -> None:
        """Open the port and begin.

        Raises:
            EnvironmentFailure: The address is taken or not this machine's.
        """
        if self._thread:
            return
        family = socket.AF_INET6 if ":" in self._host else socket.AF_INET
        self._socket = socket.socket(family, socket.SOCK_DGRAM)
        try:
            self._socket.bind((self._host, self._wanted))
        except (OSError, OverflowError, UnicodeError) as error:
            self._socket.close()
            raise EnvironmentFailure(f"OSC: {self._host}:{self._wanted} cannot be opened: {error}") from None
        with suppress(OSError):
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, FLOOD)
        self._socket.setblocking(False)
        self.port = int(self._socket.getsockname()[1])
        self._wake, self._woken = socket.socketpair()
        self._wake.setblocking(False)
        self._woken.setblocking(False)
        self._stopping = False
        self._unlisten = self._desk.listen(self._changed)
        self._thread = threading.Thread(target=self._serve, name="osc", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """End the thread and close the port; does nothing the second time."""
        if not self._thread:
            return
        self._unlisten()
        self._stopping = True
        self._poke()
        self._thread.join()
        self._thread = None
        for each in (self._socket, self._wake, self._woken):
            each.close()
        self._waiting.clear()
        self._came.clear()

    def report(self) -> OscReport:
        """What it has met so far."""
        made = OscReport(**{name: getattr(self._report, name) for name in OscReport.__slots__})
        made.waiting, made.listening = len(self._waiting), self._listeners.count(self._steady())
        return made

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def receive(self, packet: bytes, sender: Sender) -> list[Answer]:
        """Do what a packet says, or keep it until it is due.

        Args:
            packet: Bytes of anybody's.
            sender: Whose.

        Returns:
            What is to be answered; whatever the packet holds, nothing is raised.
        """
        self._report.received += 1
        try:
            messages = read_packet(packet)
        except ScorebreathError as error:
            self._report.dropped += 1
            return self._error(str(error), sender)
        answers: list[Answer] = []
        for message in messages:
            ahead = 0.0 if message.when is None else message.when - self._wall()
            if ahead <= 0.0:
                answers += self._do(message, sender)
            elif ahead > FARTHEST or len(self._waiting) >= MOST_WAITING:
                self._report.refused += 1
                why = f"due in {ahead:.6g} s, expected {FARTHEST:g} at most" if ahead > FARTHEST else "too many wait"
                answers += self._error(f"{message.address}: {why}", sender)
            else:
                self._number += 1
                due = message.when or 0.0
                heapq.heappush(self._waiting, _Waiting(due, self._number, message, sender))
        return answers

    def due(self) -> list[Answer]:
        """Do what has waited for its time, in order; returns what is to be answered."""
        answers: list[Answer] = []
        while self._waiting and self._waiting[0].due <= self._wall():
            waiting = heapq.heappop(self._waiting)
            answers += self._do(waiting.message, waiting.sender)
        return answers

    def _do(self, message: Message, sender: Sender) -> list[Answer]:
        if message.address in ANSWERS:
            return []
        now = self._steady()
        try:
            answers = self._actions.do(message, sender, now)
        except ScorebreathError as error:
            self._report.refused += 1
            lost = isinstance(error, NoAddressError)
            return self._error(str(error), sender, lambda: hint(message.address, self._desk.bodies) if lost else "")
        except Exception as error:  # a desk that fails must not take the other controls with it
            self._report.failed += 1
            return self._error(f"{message.address}: {type(error).__name__}: {error}", sender)
        self._report.applied += 1
        return [answer for answer in answers if self._may(self._answers, sender, len(answer.packets))]

    def _error(self, text: str, sender: Sender, more: Callable[[], str] = lambda: "") -> list[Answer]:
        if not self._may(self._errors, sender):
            return []
        packet = write_message(ERROR, " ".join(f"{text}{more()}".split())[:_LONGEST_ERROR])
        return [Answer(to=sender, packets=(packet,))]

    def _may(self, leave: Leave, sender: Sender, cost: int = 1) -> bool:
        if leave.take(sender, self._steady(), cost):
            return True
        self._report.unanswered += 1
        return False

    # The thread

    def _serve(self) -> None:
        with selectors.DefaultSelector() as selector:
            selector.register(self._socket, selectors.EVENT_READ)
            selector.register(self._woken, selectors.EVENT_READ)
            while not self._stopping:
                for key, _ in selector.select(self._patience()):
                    self._take_in() if key.fileobj is self._socket else self._hush()
                self._work()
                self._send(self.due())
                self._tell()

    def _patience(self) -> float:
        """How long there is nothing to do, s."""
        least = 0.0 if self._came else 1.0
        if self._waiting:
            least = min(least, self._waiting[0].due - self._wall())
        if self._changes:
            least = min(least, self._told + TELLING - self._steady())
        return max(0.0, least)

    def _work(self) -> None:
        """Do some of what has come; meanwhile all that comes is taken in, or the system would drop a flood's end."""
        for _ in range(_AT_A_TIME):
            if not self._came:
                return
            self._send(self.receive(*self._came.popleft()))
            self._take_in()

    def _take_in(self) -> None:
        while len(self._came) < MOST_WAITING:
            try:
                packet, sender = self._socket.recvfrom(65536)
            except OSError:  # nothing more, or somebody we answered is gone
                return
            self._came.append((packet, (sender[0], sender[1])))

    def _send(self, answers: list[Answer]) -> None:
        for answer in answers:
            if answer.to[1] == self.port:  # to ourselves, or to another one of us: it would never end
                continue
            for packet in answer.packets:
                try:
                    self._socket.sendto(packet, answer.to)
                except OSError:
                    self._report.failed += 1

    # Changes, told by any thread, sent by ours

    def _changed(self, body: str, name: str, value: Setting) -> None:
        with self._lock:
            first = not self._changes
            self._changes[body, name] = value
        if first:
            self._poke()

    def _poke(self) -> None:
        with suppress(OSError):  # closed, or full of pokes that say the same
            self._wake.send(b"!")

    def _hush(self) -> None:
        with suppress(OSError):
            self._woken.recv(4096)

    def _tell(self) -> None:
        if not self._changes or self._steady() < self._told + TELLING:
            return
        self._told = self._steady()
        with self._lock:
            changes, self._changes = self._changes, {}
        listeners = self._listeners.there(self._told)
        if not listeners:
            return
        try:
            messages = [
                one for (body, name), value in changes.items() for one in self._actions.value(name, value, body)
            ]
        except Exception:  # a value of a kind that no parameter has: the desk's bug, not ours to die of
            self._report.failed += 1
            return
        packets = tuple(write_bundles(messages))
        self._send([Answer(to=listener, packets=packets) for listener in listeners])
