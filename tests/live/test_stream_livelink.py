"""Live Link Face: the datagram byte by byte, and as somebody else's decoder reads it (test_stream_foreign)."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.curves.rigs.table import rig_named
from scorebreath.errors import InputError
from scorebreath.live.picture import Picture
from scorebreath.live.streams.addresses import open_stream
from scorebreath.live.streams.livelink import ANGLES, ORDER, frame_time, packet
from tests.curves.faces import gaze, head
from tests.live.pictures import of, picture
from tests.live.sockets import packets, port, receiver


def read(made: bytes) -> tuple[bytes, bytes, tuple[int, float, int, int], dict[str, float]]:
    """Device, subject, time and values, by the layout alone."""
    assert made[0] == 6
    (length,) = struct.unpack_from(">i", made, 1)
    (named,) = struct.unpack_from(">i", made, 5 + length)
    at = 9 + length + named
    assert len(made) == 306 + named and length == 36 and made[at + 16] == 61
    values = struct.unpack_from(">61f", made, at + 17)
    return made[5:41], made[45:at], struct.unpack_from(">ifii", made, at), dict(zip(ORDER, values, strict=True))


def test_order_is_unreals_and_holds_the_columns_of_the_app() -> None:
    table = rig_named("livelink").columns
    assert sorted(ORDER) == sorted(table)
    moved = [name for name, other in zip(ORDER, table, strict=True) if name != other]
    assert moved == ["JawLeft", "JawRight", "MouthLeft", "MouthRight"]


@given(time=st.floats(0, 7))
def test_every_value_arrives(time: float) -> None:
    shown = picture(time)
    device, subject, _, values = read(packet(shown))
    assert values == pytest.approx(dict(shown.rig("livelink")), abs=1e-6)
    assert subject == b"scorebreath" and device.isascii()


@given(time=st.floats(0, 1e6), rate=st.integers(1, 240))
def test_frame_and_part_are_the_time(time: float, rate: int) -> None:
    frame, part = frame_time(time, rate)
    assert 0 <= struct.unpack("f", struct.pack("f", part))[0] < 1
    assert (frame + part) / rate == pytest.approx(time, abs=2e-6)


@pytest.mark.parametrize("rate", [24, 30, 60, 120])
def test_times_of_frames_are_whole(rate: int) -> None:
    assert [frame_time(number / rate, rate) for number in range(0, 100_000, 7)] == [
        (number, 0.0) for number in range(0, 100_000, 7)
    ]


@pytest.mark.parametrize("angles", sorted(ANGLES))
def test_a_head_that_turns_left_has_a_negative_yaw(angles: str) -> None:
    shown = of(head(0.5, pitch=4.0, yaw=6.0, roll=-3.0), time=0.9)
    yaw, pitch, roll = shown.channels["head_yaw"], shown.channels["head_pitch"], shown.channels["head_roll"]
    assert (yaw, pitch, roll) == pytest.approx((6, 4, -3), abs=0.5)
    *_, values = read(packet(shown, factor=ANGLES[angles]))
    unit = {"radians": 180 / math.pi, "degrees": 1.0, "half-turns": 180.0}[angles]
    found = [values[f"Head{each}"] * unit for each in ("Yaw", "Pitch", "Roll")]
    assert found == pytest.approx([-yaw, -pitch, -roll], abs=1e-4)
    assert values["JawOpen"] == pytest.approx(shown.rig("livelink")["JawOpen"])


def test_eyes_that_look_left_and_up_turn_both_and_show_their_shapes() -> None:
    shown = of(gaze(0.0, yaw=10.0, pitch=7.0), time=0.9)
    *_, values = read(packet(shown))
    for side in ("Left", "Right"):
        assert math.degrees(values[f"{side}EyeYaw"]) == pytest.approx(-shown.channels["eye_yaw"], abs=1e-4)
        assert math.degrees(values[f"{side}EyePitch"]) == pytest.approx(-shown.channels["eye_pitch"], abs=1e-4)
    assert shown.channels["eye_yaw"] > 5 and shown.channels["eye_pitch"] > 3
    assert values["EyeLookOutLeft"] == values["EyeLookInRight"] > 0 == values["EyeLookInLeft"]


@given(name=st.text(max_size=300))
def test_any_name_fits(name: str) -> None:
    shown = picture(1.0, name=name)
    made = packet(shown)
    _, subject, _, _ = read(made)
    assert len(made) < 1400
    assert name.encode("utf-8", "replace").startswith(subject) and subject.decode("utf-8") is not None


def test_bodies_are_subjects_of_devices_of_their_own() -> None:
    one, other = picture(name="Ada"), picture(name="Bob")
    assert read(packet(one))[0] != read(packet(other))[0]
    assert read(packet(one))[0] == read(packet(picture(2.0, name="Ada")))[0]


def test_datagrams_arrive() -> None:
    with receiver() as heard:
        stream = open_stream(f"livelink://localhost:{port(heard)}?frames=30&angles=degrees")
        shown: Picture = picture(1.5)
        stream.target.send(shown)
        stream.target.close()
        (made,) = packets(heard, 1)
    assert made == packet(shown, rate=30, factor=180 / math.pi)
    assert read(made)[2] == (45, 0.0, 30, 1)


def test_wrong_angles_are_named() -> None:
    with pytest.raises(InputError, match="expected radians, degrees, half-turns"):
        open_stream("livelink://127.0.0.1?angles=grad")


def test_bytes_stay(golden: Callable[[str, bytes], None]) -> None:
    golden("streams/livelink.bin", packet(picture()))
