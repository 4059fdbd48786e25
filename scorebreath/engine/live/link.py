"""The way to an engine and back: datagrams over UDP, and answers that somebody waits for."""

from __future__ import annotations

import contextlib
import socket
import struct
import threading
import time
from collections.abc import Callable

from scorebreath.engine.osc import Argument, message

_LARGEST = 65507
_GLANCE = 0.2  # s between looks whether it is over
Reply = tuple[str, tuple[Argument, ...]]


class Link:
    """A socket to one engine, with a thread that listens.

    Args:
        host: Where it is.
        port: Its UDP port.
    """

    def __init__(self, host: str, port: int) -> None:
        """Open it; nothing is sent.

        Raises:
            OSError: There is no such host.
        """
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.connect((host, port))
        except OSError:
            self._socket.close()
            raise
        self._socket.settimeout(_GLANCE)
        self._over = threading.Event()
        self._waiting: list[tuple[Callable[[Reply], bool], list[Reply], threading.Event]] = []
        self._lock = threading.Lock()
        self.heard = 0.0
        """`time.monotonic()` of the last answer"""
        self.rate = 0.0
        """Hz, as the engine last said"""
        self._thread = threading.Thread(target=self._listen, name="engine-link", daemon=True)
        self._thread.start()

    def send(self, datagram: bytes) -> None:
        """Send; what cannot be sent is gone, as everything is with UDP."""
        with contextlib.suppress(OSError):
            self._socket.send(datagram)

    def ask(self, datagram: bytes, wanted: Callable[[Reply], bool], timeout: float) -> Reply | None:
        """Send, and wait for an answer; None where none came in time, or the link was closed."""
        found: list[Reply] = []
        came = threading.Event()
        row = wanted, found, came
        with self._lock:
            self._waiting.append(row)
        try:
            self.send(datagram)
            until = time.monotonic() + timeout
            while not came.is_set() and not self._over.is_set() and (left := until - time.monotonic()) > 0:
                came.wait(min(left, _GLANCE))
        finally:
            with self._lock:
                self._waiting.remove(row)
        return found[0] if found else None

    def status(self) -> None:
        """Ask how it does; whoever answers was heard."""
        self.send(message("/status"))

    def close(self) -> None:
        """Stop listening."""
        self._over.set()
        self._thread.join(5 * _GLANCE)
        self._socket.close()

    def _listen(self) -> None:
        while not self._over.is_set():
            try:
                datagram = self._socket.recv(_LARGEST)
            except TimeoutError:
                continue
            except OSError:  # nobody is there, or not yet
                self._over.wait(0.01)
                continue
            reply = read_message(datagram)
            if reply is None:
                continue
            self.heard = time.monotonic()
            if reply[0] == "/status.reply" and len(reply[1]) >= 9 and isinstance(reply[1][7], float):
                self.rate = reply[1][7]
            with self._lock:
                for wanted, found, came in self._waiting:
                    if not came.is_set() and wanted(reply):
                        found.append(reply)
                        came.set()


def read_message(datagram: bytes) -> Reply | None:
    r"""One OSC message, or None if it is none; engines answer with ints, floats and strings.

    >>> read_message(message("/synced", 7))
    ('/synced', (7,))
    >>> read_message(b"rubbish")
    """
    try:
        address, place = _text(datagram, 0)
        tags, place = _text(datagram, place)
        if not address.startswith("/") or not tags.startswith(","):
            return None
        values: list[Argument] = []
        for tag in tags[1:]:
            if tag in _NUMBERS:
                layout = _NUMBERS[tag]
                values.append(layout.unpack_from(datagram, place)[0])
                place += layout.size
            elif tag == "s":
                text, place = _text(datagram, place)
                values.append(text)
            else:
                return None
    except (struct.error, ValueError):
        return None
    return address, tuple(values)


_NUMBERS = {"i": struct.Struct(">i"), "f": struct.Struct(">f"), "d": struct.Struct(">d"), "h": struct.Struct(">q")}


def _text(datagram: bytes, place: int) -> tuple[str, int]:
    end = datagram.index(b"\0", place)
    return datagram[place:end].decode("utf-8"), place + (end - place) // 4 * 4 + 4
