"""Bytes of OSC 1.0, read as hostile and written small.

Written with python-osc, read without it: its reader turns for ever at an element whose size is below zero, runs out
of stack in bundles within bundles, and takes a torn float for 0.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from pythonosc.osc_message_builder import OscMessageBuilder

from scorebreath.errors import InputError, shortened

Argument = float | int | str | bool | None

LARGEST_ANSWER = 1400
"""Bytes of a packet that we send: what passes any network in one piece."""
MOST_MESSAGES = 1024
MOST_ARGUMENTS = 256
DEEPEST = 4
"""Bundles in each other."""
LONGEST_ADDRESS = 200

_BUNDLE = b"#bundle\x00"
_AT_ONCE = 1
_SINCE_1900 = 2_208_988_800
"""s from the beginning of time tags to that of Unix time"""
_NUMBERS = {tag: struct.Struct(f">{code}") for tag, code in (("i", "i"), ("f", "f"), ("h", "q"), ("d", "d"))}
_CONSTANTS: dict[str, Argument] = {"T": True, "F": False, "N": None, "I": True}
"""An impulse is a button pressed."""
_TAGS = " ".join((*_NUMBERS, *_CONSTANTS, "s", "S"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Message:
    """One message of a packet."""

    address: str
    arguments: tuple[Argument, ...] = ()
    when: float | None = None
    """s since 1970, of the bundle's time tag; None: at once"""


def read_packet(data: bytes) -> tuple[Message, ...]:
    """The messages of a packet, in order; all of them can be read or none.

    Raises:
        InputError: It is no OSC, too deep, too much, or has arguments of a kind that nothing here takes.

    >>> read_packet(write_message("/scorebreath/nose_share", 0.5))
    (Message(address='/scorebreath/nose_share', arguments=(0.5,), when=None),)
    """
    found: list[Message] = []
    _read(data, None, 0, found)
    return tuple(found)


def write_message(address: str, *arguments: Argument) -> bytes:
    """A message; flags become 1 and 0, which every receiver understands."""
    builder = OscMessageBuilder(address=address)
    for argument in arguments:
        if isinstance(argument, bool):
            builder.add_arg(int(argument))
        elif isinstance(argument, str):
            builder.add_arg(argument.replace("\x00", " ").encode("utf-8", "replace").decode("utf-8"))
        else:
            builder.add_arg(argument)
    return bytes(builder.build().dgram)


def write_bundles(messages: Iterable[bytes], largest: int = LARGEST_ANSWER) -> list[bytes]:
    """Bundles to be done at once, none larger than `largest` unless a single message is.

    >>> [len(packet) for packet in write_bundles([bytes(36)] * 3, 100)]
    [96, 56]
    """
    head = _BUNDLE + struct.pack(">Q", _AT_ONCE)
    packets: list[bytes] = []
    for message in messages:
        element = struct.pack(">i", len(message)) + message
        if packets and len(packets[-1]) + len(element) <= largest:
            packets[-1] += element
        else:
            packets.append(head + element)
    return packets


def _read(data: bytes, when: float | None, depth: int, found: list[Message]) -> None:
    if len(found) >= MOST_MESSAGES:
        raise InputError(f"OSC packet: more than {MOST_MESSAGES} messages")
    if data.startswith(b"/"):
        found.append(_message(data, when))
    elif data.startswith(_BUNDLE):
        if depth >= DEEPEST:
            raise InputError(f"OSC packet: more than {DEEPEST} bundles in each other")
        _read_bundle(data, when, depth, found)
    else:
        raise InputError(f"OSC packet: begins with {data[:8]!r}, expected an address or #bundle")


def _read_bundle(data: bytes, when: float | None, depth: int, found: list[Message]) -> None:
    if len(data) < 16:
        raise InputError(f"OSC packet: a bundle of {len(data)} bytes, expected 16 or more")
    (tag,) = struct.unpack_from(">Q", data, 8)
    if tag > _AT_ONCE:  # what is inside another bundle is never due before it (OSC 1.0)
        due = tag / 2**32 - _SINCE_1900
        when = due if when is None else max(due, when)
    place = 16
    while place < len(data):
        if len(data) - place < 4:
            raise InputError(f"OSC packet: byte {place}: a torn size")
        (size,) = struct.unpack_from(">i", data, place)
        place += 4
        if not 0 < size <= len(data) - place:
            raise InputError(f"OSC packet: byte {place - 4}: size {size}, expected 1 to {len(data) - place}")
        _read(data[place : place + size], when, depth + 1, found)
        place += size


def _message(data: bytes, when: float | None) -> Message:
    address, place = _string(data, 0)
    if len(address) > LONGEST_ADDRESS or not (address.isascii() and address.isprintable()):
        raise InputError(
            f"OSC packet: address {shortened(address, 40)!r}, expected {LONGEST_ADDRESS} of printable ASCII"
        )
    if place == len(data):  # old programs leave out the type tags where there are no arguments
        return Message(address=address, when=when)
    tags, place = _string(data, place)
    if not tags.startswith(",") or len(tags) > MOST_ARGUMENTS:
        raise InputError(f"OSC packet: type tags {shortened(tags)!r}, expected a comma and {MOST_ARGUMENTS} at most")
    arguments: list[Argument] = []
    for tag in tags[1:]:
        if tag in _CONSTANTS:
            arguments.append(_CONSTANTS[tag])
        elif tag in _NUMBERS:
            size = _NUMBERS[tag].size
            if place + size > len(data):
                raise InputError(f"OSC packet: {address}: torn in an argument of type {tag}")
            arguments.append(_NUMBERS[tag].unpack_from(data, place)[0])
            place += size
        elif tag in "sS":
            text, place = _string(data, place)
            arguments.append(text)
        else:
            raise InputError(f"OSC packet: {address}: type tag {tag!r}, expected one of {_TAGS}")
    return Message(address=address, arguments=tuple(arguments), when=when)


def _string(data: bytes, place: int) -> tuple[str, int]:
    """A text that ends with a zero byte, and where the next thing begins."""
    end = data.find(b"\x00", place)
    after = (end // 4 + 1) * 4
    if end < 0 or after > len(data):
        raise InputError(f"OSC packet: byte {place}: a text without end")
    try:
        return data[place:end].decode("utf-8"), after
    except UnicodeDecodeError as error:
        raise InputError(f"OSC packet: byte {place + error.start}: not UTF-8") from None


def arguments_text(arguments: Sequence[Argument]) -> str:
    """Arguments as one text: programs that send words one by one mean a sentence.

    >>> arguments_text(("I", "have", 3, "dogs."))
    'I have 3 dogs.'
    """
    return " ".join(
        argument if isinstance(argument, str) else f"{argument:g}" for argument in arguments if argument is not None
    )
