"""Channels as plain OSC: what a foreign reader finds in the packets."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pythonosc.osc_bundle import OscBundle
from pythonosc.osc_message import OscMessage

from scorebreath.curves.channels import CHANNELS
from scorebreath.engine.osc import message
from scorebreath.errors import InputError
from scorebreath.live.streams.addresses import open_stream
from scorebreath.live.streams.datagrams import AT_ONCE, LARGEST, Datagrams, bundles, time_tag
from scorebreath.live.streams.osc import OscTarget, packets
from tests.live.pictures import START, named, picture
from tests.live.sockets import packets as heard_packets
from tests.live.sockets import port, receiver

NAMES = [channel.name for channel in CHANNELS]


def messages(packet: bytes) -> list[OscMessage]:
    return [each for each in OscBundle(packet) if isinstance(each, OscMessage)]


def values(sent: list[bytes]) -> dict[str, object]:
    return {each.address: each.params[0] for packet in sent for each in messages(packet)}


def test_a_foreign_reader_finds_every_channel() -> None:
    shown = picture(1.5)
    found = values(packets(shown, (), AT_ONCE))
    told = {f"/scorebreath/body/{name}": np.float32(value) for name, value in shown.channels.items()}
    assert found == {**told, "/scorebreath/body/time": 1.5, "/scorebreath/body/frame": 90}
    assert len(set(told.values())) > 10


def test_every_bundle_has_time_frame_tag_and_a_size_that_passes() -> None:
    sent = packets(picture(1.5), (), time_tag(START + 1.5))
    assert len(sent) > 1
    for packet in sent:
        assert len(packet) <= LARGEST
        assert [each.address for each in messages(packet)[:2]] == ["/scorebreath/body/time", "/scorebreath/body/frame"]
        assert OscBundle(packet).timestamp == pytest.approx(START + 1.5, abs=1e-6)


@given(unix=st.floats(0, 4e9))
def test_a_time_tag_is_the_unix_time(unix: float) -> None:
    assert time_tag(unix) / 2**32 - 2_208_988_800 == pytest.approx(unix, abs=1e-6)


@given(
    texts=st.lists(st.text(st.characters(codec="ascii", exclude_characters="\0"), max_size=300), max_size=60),
    most=st.integers(200, 2000),
)
@settings(deadline=None, max_examples=60)
def test_nothing_is_lost_or_moved_when_bundles_are_split(texts: list[str], most: int) -> None:
    told = [message("/a", text) for text in texts]
    head = [message("/head", 1)]
    made = bundles(AT_ONCE, head, told, most)
    found = [each.params[0] for packet in made for each in messages(packet) if each.address == "/a"]
    assert found == texts
    for packet in made:
        assert len(packet) <= most or len(messages(packet)) == 2  # one that is too long alone
        assert messages(packet)[0].address == "/head"


@pytest.mark.parametrize("most", range(60, 160, 4))
def test_bundles_are_filled_to_the_last_byte(most: int) -> None:
    told = [message("/a", "x" * (number % 9)) for number in range(100)]
    made = bundles(AT_ONCE, (), told, most)
    for packet, following in pairwise(made):
        assert len(packet) <= most < len(packet) + 4 + int.from_bytes(following[16:20], "big")


@given(chosen=st.lists(st.sampled_from(NAMES), min_size=1, unique=True))
@settings(deadline=None, max_examples=30)
def test_only_the_channels_asked_for_are_sent_in_their_order(chosen: list[str]) -> None:
    found = [each.address for packet in packets(picture(), chosen, AT_ONCE) for each in messages(packet)]
    assert [each.rpartition("/")[2] for each in found if not each.endswith(("/time", "/frame"))] == chosen


@pytest.mark.parametrize("host", ["127.0.0.1", "::1"])
def test_packets_arrive(host: str) -> None:
    with receiver(host) as heard:
        written = f"[{host}]" if ":" in host else host
        stream = open_stream(f"osc://{written}:{port(heard)}?channels=lung_volume,airflow&tag=now")
        stream.target.send(picture(0.5, shown=named("body2"), body="body 2/x"))
        stream.target.close()
        (packet,) = heard_packets(heard, 1)
    assert [each.address for each in messages(packet)] == [
        f"/scorebreath/body_2_x/{each}" for each in ("time", "frame", "lung_volume", "airflow")
    ]
    assert packet[8:16] == AT_ONCE.to_bytes(8, "big")


def test_nobody_needs_to_listen() -> None:
    with receiver() as heard:
        gone = port(heard)
    target = OscTarget("osc", Datagrams("127.0.0.1", gone))
    for _ in range(5):
        target.send(picture())
    target.close()


@pytest.mark.parametrize(
    ("address", "expected"),
    [
        ("osc://127.0.0.1?channels=lung_volum", "did you mean lung_volume"),
        ("osc://127.0.0.1?tag=soon", "expected heard or now"),
    ],
)
def test_wrong_options_are_named(address: str, expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        open_stream(address)


def test_bytes_stay(golden: Callable[[str, bytes], None]) -> None:
    golden("streams/osc.bin", b"".join(packets(picture(), (), time_tag(START + 1.5))))
