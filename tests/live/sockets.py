"""Receivers of UDP on this machine."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def receiver(host: str = "127.0.0.1") -> Iterator[socket.socket]:
    """A socket at a free port, which waits for ten seconds at most."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family, socket.SOCK_DGRAM) as heard:
        heard.bind((host, 0))
        heard.settimeout(10.0)
        yield heard


def port(heard: socket.socket) -> int:
    found: int = heard.getsockname()[1]
    return found


def packets(heard: socket.socket, count: int) -> list[bytes]:
    return [heard.recv(65536) for _ in range(count)]
