"""OSC by bytes: what we read is what was sent, by python-osc too, and rubbish is one error, at once."""

from __future__ import annotations

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pythonosc.osc_bundle_builder import OscBundleBuilder
from pythonosc.osc_message_builder import OscMessageBuilder
from pythonosc.osc_packet import OscPacket

from scorebreath.errors import InputError
from scorebreath.live.controls.packets import (
    DEEPEST,
    MOST_MESSAGES,
    Argument,
    Message,
    read_packet,
    write_bundles,
    write_message,
)
from scorebreath.parameters.table import Parameters

SINCE_1900 = 2_208_988_800
WORDS = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\x00"), max_size=40)
ARGUMENTS = st.lists(
    st.one_of(
        st.floats(width=32, allow_nan=False),
        st.integers(-(2**31), 2**31 - 1),
        st.integers(2**31, 2**62),
        WORDS,
        st.none(),
    ),
    max_size=6,
)
ADDRESSES = st.sampled_from([*(f"/scorebreath/{name}" for name in Parameters.model_fields), "/scorebreath/say", "/x"])


def bundle(*elements: bytes, tag: int = 1) -> bytes:
    return b"#bundle\x00" + struct.pack(">Q", tag) + b"".join(struct.pack(">i", len(e)) + e for e in elements)


@given(ADDRESSES, ARGUMENTS)
def test_a_message_is_read_as_it_was_written(address: str, arguments: list[Argument]) -> None:
    packet = write_message(address, *arguments)
    assert len(packet) % 4 == 0
    assert read_packet(packet) == (Message(address=address, arguments=tuple(arguments)),)
    (other,) = OscPacket(packet).messages
    assert (other.message.address, other.message.params) == (address, arguments)


@given(st.lists(st.tuples(ADDRESSES, ARGUMENTS), max_size=60), st.integers(200, 1400))
def test_bundles_hold_everything_in_order(said: list[tuple[str, list[Argument]]], largest: int) -> None:
    messages = [write_message(address, *arguments) for address, arguments in said]
    packets = write_bundles(messages, largest)
    read = [message for packet in packets for message in read_packet(packet)]
    assert [(m.address, list(m.arguments), m.when) for m in read] == [(a, g, None) for a, g in said]
    assert all(len(packet) <= max(largest, 20 + max(map(len, messages))) for packet in packets)


def test_time_tags_and_bundles_in_bundles() -> None:
    inner = OscBundleBuilder(1000.5)  # type: ignore[arg-type]  # says int, means s
    message = OscMessageBuilder("/scorebreath/sigh")
    inner.add_content(message.build())
    outer = OscBundleBuilder(2000.25)  # type: ignore[arg-type]
    outer.add_content(inner.build())
    outer.add_content(message.build())
    assert [m.when for m in read_packet(outer.build().dgram)] == [2000.25, 2000.25]  # never before what it is in
    assert [m.when for m in read_packet(inner.build().dgram)] == [1000.5]
    assert [m.when for m in read_packet(bundle(write_message("/x")))] == [None]
    (late,) = read_packet(bundle(write_message("/x"), tag=2**64 - 1))
    assert late.when == pytest.approx(2**32 - SINCE_1900)


def test_every_kind_of_argument() -> None:
    packet = (
        b"/x\0\0,TFNIifsdhS\0" + struct.pack(">if", 7, 0.5) + b"ab\0\0" + struct.pack(">dq", 0.25, 2**40) + b"sy\0\0"
    )
    (message,) = read_packet(packet)
    assert message.arguments == (True, False, None, True, 7, 0.5, "ab", 0.25, 2**40, "sy")
    assert read_packet(b"/x\0\0") == (Message(address="/x"),)
    assert write_message("/x", True, False) == b"/x\0\0,ii\0" + struct.pack(">ii", 1, 0)


@pytest.mark.parametrize(
    "packet",
    [
        b"",
        b"\0\0\0\0",
        b"hello",
        b"#bundle\0",
        b"#bundle\0" + bytes(7),
        b"#bundle\0" + bytes(8) + b"\xff\xff\xff\xfc",  # a size below zero: a naive reader turns here for ever
        b"#bundle\0" + bytes(8) + bytes(4) * 10_000,  # thousands of nothings
        b"#bundle\0" + bytes(8) + b"\x7f\xff\xff\xff/x\0\0",
        b"#bundle\0" + bytes(8) + b"\0\0\0",
        b"/" + b"a" * 60_000,
        b"/" + b"a" * 60_000 + b"\0\0\0\0,\0\0\0",
        b"/x\xff\0,\0\0\0",
        b"/x\n\0,\0\0\0",
        b"/x\0\0,f\0\0",  # a reader that pads takes it for 0
        b"/x\0\0,d\0\0" + bytes(4),
        b"/x\0\0,s\0\0abcd",
        b"/x\0\0,s\0\0\xff\xfe\0\0",
        b"/x\0\0,b\0\0\xff\xff\xff\xf0",
        b"/x\0\0,b\0\0\0\0\0\x04abcd",
        b"/x\0\0,[[[[\0\0\0",
        b"/x\0\0,q\0\0",
        b"/x\0\0,",
        b"/x\0\0ifs\0",
        b"/x\0\0," + b"T" * 60_000 + b"\0",
    ],
    ids=lambda packet: repr(packet[:24]),
)
def test_rubbish_is_refused(packet: bytes) -> None:
    with pytest.raises(InputError, match="OSC packet"):
        read_packet(packet)


def test_depth_and_number_are_bounded() -> None:
    packet = write_message("/x")
    for _ in range(DEEPEST):
        packet = bundle(packet)
    assert len(read_packet(packet)) == 1
    with pytest.raises(InputError, match="in each other"):
        read_packet(bundle(packet))
    while len(packet) < 60_000:
        packet = bundle(packet)
    with pytest.raises(InputError, match="in each other"):
        read_packet(packet)
    assert len(read_packet(bundle(*[b"/x\0\0"] * MOST_MESSAGES))) == MOST_MESSAGES
    with pytest.raises(InputError, match="more than"):
        read_packet(bundle(*[b"/x\0\0"] * (MOST_MESSAGES + 1)))


@st.composite
def damaged(draw: st.DrawFn) -> bytes:
    """A packet that was right, with bytes changed, lost and added."""
    messages = [write_message(draw(ADDRESSES), *draw(ARGUMENTS)) for _ in range(draw(st.integers(1, 4)))]
    packet = bytearray(messages[0] if draw(st.booleans()) else bundle(*messages, tag=draw(st.integers(0, 2**64 - 1))))
    for _ in range(draw(st.integers(1, 6))):
        place = draw(st.integers(0, len(packet)))
        match draw(st.sampled_from(["change", "cut", "add", "size"])):
            case "change" if place < len(packet):
                packet[place] = draw(st.integers(0, 255))
            case "cut":
                del packet[place : place + draw(st.integers(1, 12))]
            case "add":
                packet[place:place] = draw(st.binary(max_size=12))
            case "size":
                packet[place : place + 4] = struct.pack(
                    ">i", draw(st.sampled_from([-(2**31), -4, -1, 0, 1, 2**31 - 1]))
                )
    return bytes(packet)


@given(st.one_of(st.binary(max_size=300), st.binary(max_size=300).map(lambda b: b"#bundle\0" + b), damaged()))
def test_any_bytes_are_read_or_refused(packet: bytes) -> None:
    try:
        messages = read_packet(packet)
    except InputError as error:
        assert len(str(error)) < 300
    else:
        assert len(messages) <= MOST_MESSAGES
        assert all(m.address.startswith("/") and len(m.address) <= 200 for m in messages)
