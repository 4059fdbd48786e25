"""Packets over UDP, and OSC messages that are packed into them."""

from __future__ import annotations

import math
import socket
from collections.abc import Iterator, Sequence

from scorebreath.engine import osc
from scorebreath.errors import InputError

LARGEST = 1400
"""Bytes of a packet: what passes any network in one piece."""
AT_ONCE = 1
"""The time tag that means now (OSC 1.0)."""
SINCE_1900 = 2_208_988_800
"""s from the beginning of time tags to that of Unix time"""
_HEAD, _SIZE = 16, 4
"""Bytes of a bundle before its messages, and before each of them."""


class Datagrams:
    """A UDP socket towards one receiver. Nobody needs to listen; nothing here waits.

    Args:
        host: Name, IPv4 or IPv6 address; a broadcast address is fine.
        port: 1..65535.

    Raises:
        InputError: The host is not known.
    """

    def __init__(self, host: str, port: int) -> None:
        """Look the host up, once."""
        family, kind, protocol, _, self._address = found(host, port, socket.SOCK_DGRAM)
        self._socket = socket.socket(family, kind, protocol)
        self._socket.setblocking(False)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)

    def send(self, packets: Sequence[bytes]) -> None:
        """Send them in their order.

        Raises:
            OSError: One of them could not be sent at once; those behind it were not tried.
        """
        for packet in packets:
            self._socket.sendto(packet, self._address)

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()


Found = tuple[socket.AddressFamily, socket.SocketKind, int, str, tuple[str, int] | tuple[str, int, int, int]]


def found(host: str, port: int, kind: socket.SocketKind) -> Found:
    """Where a host is: its IPv4 address before others, since that is where most receivers listen.

    Raises:
        InputError: The host is not known.
    """
    try:
        places = socket.getaddrinfo(host, port, type=kind)
    except (OSError, UnicodeError) as error:
        raise InputError(f"host {host!r} cannot be found: {error}") from None
    return min(places, key=lambda place: place[0] != socket.AF_INET)  # type: ignore[return-value]


def bundles(tag: int, head: Sequence[bytes], messages: Sequence[bytes], most: int = LARGEST) -> list[bytes]:
    """OSC messages in as few bundles as keep their order and stay within a size.

    Args:
        tag: Time tag of each bundle.
        head: Messages that every bundle begins with.
        messages: What is told, in order.
        most: Bytes of a bundle; a message that is longer by itself gets a bundle that is, too.

    Returns:
        At least one bundle.
    """
    return [osc.bundle(tag, [*head, *part]) for part in _parts(head, messages, most)]


def _parts(head: Sequence[bytes], messages: Sequence[bytes], most: int) -> Iterator[Sequence[bytes]]:
    empty = _HEAD + sum(_SIZE + len(one) for one in head)
    size, first = empty, 0
    for number, message in enumerate(messages):
        if size + _SIZE + len(message) > most and number > first:
            yield messages[first:number]
            size, first = empty, number
        size += _SIZE + len(message)
    yield messages[first:]


def time_tag(unix: float) -> int:
    """A Unix time as a time tag: seconds since 1900 in 2^-32 s, the form of NTP.

    >>> hex(time_tag(0.5)), hex(time_tag(1_800_000_000.25))
    ('0x83aa7e8080000000', '0xeef4508040000000')
    """
    seconds = math.floor(unix)
    return ((seconds + SINCE_1900) << 32) + int((unix - seconds) * 2**32)
