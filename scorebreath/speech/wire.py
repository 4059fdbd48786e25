"""Messages between the program and a voice's worker process: a JSON object and some bytes, each length first.

Nothing is pickled, so neither side can be made to run what the other one sends.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any, BinaryIO

HEADER = struct.Struct("<II")
"""bytes of JSON, bytes of payload"""


class WireError(Exception):
    """The stream ended inside a message, or does not hold one."""


def write_message(stream: BinaryIO, fields: Mapping[str, Any], payload: bytes = b"") -> None:
    """Send one message and flush.

    Args:
        stream: Where to.
        fields: What JSON can hold; lone surrogates are kept.
        payload: Samples or other numbers as bytes.
    """
    stream.write(pack(fields, payload))
    stream.flush()


def pack(fields: Mapping[str, Any], payload: bytes = b"") -> bytes:
    """One message as bytes."""
    text = json.dumps(fields, separators=(",", ":")).encode("ascii")
    return HEADER.pack(len(text), len(payload)) + text + payload


def read_message(stream: BinaryIO) -> tuple[dict[str, Any], bytes] | None:
    """Receive one message; waits for it.

    Args:
        stream: Where from, in blocking mode.

    Returns:
        Its fields and payload, or None when the stream ends before it.

    Raises:
        WireError: The stream ends inside the message, or it is not one.
    """
    head = stream.read(HEADER.size)
    if not head:
        return None
    if len(head) < HEADER.size:
        raise WireError("the stream ended inside a message")
    length, size = HEADER.unpack(head)
    text, payload = stream.read(length), stream.read(size)
    if len(text) < length or len(payload) < size:
        raise WireError("the stream ended inside a message")
    try:
        fields = json.loads(text)
    except ValueError as error:
        raise WireError("a message is not JSON") from error
    if not isinstance(fields, dict):
        raise WireError("a message is not a JSON object")
    return fields, payload
