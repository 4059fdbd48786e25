"""Open Sound Control 1.0 as engines read it from a file: messages in bundles.

The libraries for OSC stamp bundles with the date; a file of commands counts from its own beginning.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable

Argument = int | float | str | bytes


def message(address: str, *arguments: Argument) -> bytes:
    r"""One message.

    Args:
        address: e.g. `/s_new`.
        arguments: int is sent as int32, float as float32, str as UTF-8, bytes as a blob.

    >>> message("/b_free", 3)
    b'/b_free\x00,i\x00\x00\x00\x00\x00\x03'
    """
    tags, body = ",", b""
    for argument in arguments:
        if isinstance(argument, int):
            tags += "i"
            body += struct.pack(">i", argument)
        elif isinstance(argument, float):
            tags += "f"
            body += struct.pack(">f", argument)
        elif isinstance(argument, str):
            tags += "s"
            body += _ended(argument.encode("utf-8"))
        else:
            tags += "b"
            body += struct.pack(">i", len(argument)) + argument + bytes(-len(argument) % 4)
    return _ended(address.encode("ascii")) + _ended(tags.encode("ascii")) + body


def bundle(tag: int, messages: Iterable[bytes]) -> bytes:
    """Messages for one moment.

    Args:
        tag: Its time, in 2^-32 s.
        messages: In order.
    """
    return b"#bundle\0" + struct.pack(">Q", tag) + b"".join(struct.pack(">i", len(one)) + one for one in messages)


def _ended(text: bytes) -> bytes:
    """A text with the zeros that end it, a multiple of four bytes."""
    return text + bytes(4 - len(text) % 4)
