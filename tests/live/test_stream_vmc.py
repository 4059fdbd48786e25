"""VMC: names, order, sizes, and bones that turn the right way."""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pythonosc.osc_bundle import OscBundle
from pythonosc.osc_message import OscMessage

from scorebreath.curves.rigs.table import rig_named
from scorebreath.errors import InputError
from scorebreath.live.picture import Picture
from scorebreath.live.streams.addresses import open_stream
from scorebreath.live.streams.datagrams import LARGEST
from scorebreath.live.streams.skeleton import COMMON, Rest, of_model
from scorebreath.live.streams.turning import STILL, Quaternion, Vector, back, share, times, turn
from scorebreath.live.streams.vmc import BONES, BREATH, PRESETS, packets, pose
from tests.curves.faces import emotion, gaze, head
from tests.live.pictures import of, picture
from tests.live.sockets import packets as heard_packets
from tests.live.sockets import port, receiver

LEFT, UP, AHEAD = (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
"""The character's own, in Unity's axes: it looks along z."""
angles = st.floats(-45, 45)


def messages(packet: bytes) -> list[OscMessage]:
    return [each for each in OscBundle(packet) if isinstance(each, OscMessage)]


def told(sent: list[bytes]) -> list[tuple[str, list[Any]]]:
    return [(each.address.removeprefix("/VMC/Ext/"), list(each.params)) for one in sent for each in messages(one)]


def blends(shown: Picture, **options: Any) -> dict[str, float]:
    return {params[0]: params[1] for kind, params in told(packets(shown, **options)) if kind == "Blend/Val"}


def bones(shown: Picture, rests: Any = COMMON) -> dict[str, Quaternion]:
    found = told(packets(shown, bones=rests))
    return {params[0]: tuple(params[4:]) for kind, params in found if kind == "Bone/Pos"}


def moved(rotation: Quaternion, vector: Vector) -> Vector:
    """The vector turned, by the formula of Rodrigues rather than by a product of quaternions."""
    axis, w = rotation[:3], rotation[3]
    once = crossed(axis, vector)
    again = crossed(axis, once)
    x, y, z = (v + 2 * (w * p + q) for v, p, q in zip(vector, once, again, strict=True))
    return x, y, z


def crossed(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@pytest.mark.parametrize(
    ("turned", "vector", "towards"),
    [
        ({"yaw": 30.0}, AHEAD, LEFT),
        ({"pitch": 30.0}, AHEAD, UP),
        ({"roll": 30.0}, UP, (1.0, 0.0, 0.0)),
    ],
)
def test_angles_of_ours_turn_a_character_of_unity(turned: dict[str, float], vector: Vector, towards: Vector) -> None:
    found = moved(turn(**{"pitch": 0.0, "yaw": 0.0, "roll": 0.0, **turned}), vector)
    wanted = tuple(math.cos(math.radians(30)) * v + math.sin(math.radians(30)) * t
                   for v, t in zip(vector, towards, strict=True))  # fmt: skip
    assert found == pytest.approx(wanted, abs=1e-9)


@given(pitch=angles, yaw=angles, roll=angles, part=st.floats(0, 1))
def test_shares_of_a_turn_make_the_whole(pitch: float, yaw: float, roll: float, part: float) -> None:
    whole = turn(pitch, yaw, roll)
    assert times(share(whole, part), share(whole, 1 - part)) == pytest.approx(whole, abs=1e-9)
    assert times(back(whole), whole) == pytest.approx(STILL, abs=1e-9)


def test_a_known_yaw_turns_neck_and_head_to_the_characters_left() -> None:
    shown = of(head(0.5, pitch=0.0, yaw=20.0, roll=0.0), time=0.9)
    yaw = shown.channels["head_yaw"]
    assert yaw == pytest.approx(20.0, abs=1.0)
    found = bones(shown)
    ahead = moved(times(found["Neck"], found["Head"]), AHEAD)
    assert ahead == pytest.approx((-math.sin(math.radians(yaw)), 0.0, math.cos(math.radians(yaw))), abs=1e-6)
    assert moved(found["Head"], AHEAD)[0] == pytest.approx(-math.sin(math.radians(0.6 * yaw)), abs=1e-6)


def test_eyes_shoulders_and_chest_move_the_right_way() -> None:
    shown = of(gaze(0.0, yaw=10.0, pitch=7.0), time=0.9)
    for eye in ("LeftEye", "RightEye"):
        ahead = moved(bones(shown)[eye], AHEAD)
        assert ahead[0] < -0.1 and ahead[1] > 0.05
    channels = {**shown.channels, "shoulder": 1.0, "thorax": 1.0}
    found = {name: turned for name, (_, turned) in pose(channels, COMMON).items()}
    assert moved(found["LeftShoulder"], LEFT)[1] == pytest.approx(math.sin(math.radians(6)))
    assert moved(found["RightShoulder"], (1.0, 0.0, 0.0))[1] == pytest.approx(math.sin(math.radians(6)))
    assert moved(found["Chest"], AHEAD)[1] > 0 and moved(found["UpperChest"], AHEAD)[1] > 0


def test_no_bones_unless_asked_for() -> None:
    assert bones(picture()).keys() == BONES.keys() == COMMON.keys()
    assert not [kind for kind, _ in told(packets(picture())) if "Pos" in kind]


def test_presets_show_what_the_curves_say() -> None:
    shown = of(emotion("happy", 0.0), emotion("kidding", 0.0, intensity=0.5), gaze(0.0, yaw=10.0), time=1.0)
    found = blends(shown)
    assert found["Joy"] == pytest.approx(shown.channels["emotion_happy"]) and found["Joy"] > 0.5
    assert found["Fun"] == pytest.approx(shown.channels["emotion_kidding"])
    assert found["LookLeft"] == pytest.approx(shown.channels["eye_yaw"] / 35, abs=1e-4) and found["LookRight"] == 0
    assert blends(picture(1.5))["A"] == pytest.approx(picture(1.5).rig("oculus")["aa"], abs=1e-6)


@pytest.mark.parametrize("case", ["pascal", "camel"])
def test_names_are_those_asked_for(case: str) -> None:
    breath = {name if case == "camel" else name[0].upper() + name[1:] for name in BREATH}
    zero, one = ({getattr(row, kind) for row in PRESETS} for kind in ("vrm0", "vrm1"))
    apple = set(rig_named("arkit" if case == "camel" else "livelink").columns[:52])
    assert not zero & one and len(apple) == 52
    assert blends(picture(), case=case).keys() == zero | breath
    assert blends(picture(), case=case, names="vrm1").keys() == one | breath
    assert blends(picture(), case=case, names="both", shapes="both").keys() == zero | one | apple | breath
    assert blends(picture(), case=case, shapes="arkit").keys() == apple | breath


@given(
    time=st.floats(-1, 8), names=st.sampled_from(["vrm0", "vrm1", "both"]),
    shapes=st.sampled_from(["presets", "arkit", "both"]), rests=st.sampled_from([None, COMMON]),
)  # fmt: skip
@settings(deadline=None, max_examples=30)
def test_packets_are_small_complete_and_end_with_apply(time: float, names: str, shapes: str, rests: Any) -> None:
    sent = packets(picture(time), names=names, shapes=shapes, bones=rests)
    assert all(len(packet) <= LARGEST and packet[8:16] == bytes([0] * 7 + [1]) for packet in sent)
    found = told(sent)
    assert found[0] == ("OK", [1, 3, 0, 1])
    assert found[1] == ("T", [struct.unpack("f", struct.pack("f", time))[0]])
    assert found[-1] == ("Blend/Apply", []) and [kind for kind, _ in found].count("Blend/Apply") == 1
    for kind, params in found:
        if kind == "Bone/Pos":
            assert math.hypot(*params[4:]) == pytest.approx(1.0, abs=1e-5)
        if kind == "Blend/Val" and params[0] not in ("Thorax", "Abdomen"):
            assert 0.0 <= params[1] <= 1.0


def test_bundles_of_a_picture_arrive_in_order() -> None:
    with receiver() as heard:
        stream = open_stream(f"vmc://127.0.0.1:{port(heard)}?names=both&shapes=both&bones=1&case=camel")
        stream.target.send(picture())
        stream.target.close()
        wanted = packets(picture(), names="both", shapes="both", case="camel", bones=COMMON)
        assert heard_packets(heard, len(wanted)) == wanted and len(wanted) > 2
    assert stream.body == ""


@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ("names=vrm2", "names='vrm2'.*did you mean"),
        ("case=snake", "expected pascal, camel"),
        ("shapes=mouth", "expected presets, arkit, both"),
        ("bones=yes", "expected 0 or 1"),
        ("model=/nowhere/a.vrm", "expected the .vrm of the character"),
    ],
)
def test_wrong_options_are_named(query: str, expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        open_stream(f"vmc://127.0.0.1?{query}")


def test_bytes_stay(golden: Callable[[str, bytes], None]) -> None:
    golden("streams/vmc.bin", b"".join(packets(picture(), names="both", shapes="both", bones=COMMON)))


HALF = math.sqrt(0.5)
NODES = [
    {"name": "root", "children": [1], "rotation": [0, HALF, 0, HALF]},
    {"name": "chest", "children": [2], "translation": [0.1, 1.0, 0.2]},
    {"name": "neck", "children": [3], "translation": [0.01, 0.2, -0.03], "rotation": [HALF, 0, 0, HALF]},
    {"name": "head", "translation": [0.0, 0.1, 0.02]},
]
BONES_OF = {"chest": 1, "neck": 2, "head": 3}


def model(path: Path, document: dict[str, Any]) -> str:
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text)
    return str(path)


def vrm(version: int, nodes: list[dict[str, Any]] = NODES) -> dict[str, Any]:
    one = {"VRMC_vrm": {"humanoid": {"humanBones": {name: {"node": node} for name, node in BONES_OF.items()}}}}
    zero = {"VRM": {"humanoid": {"humanBones": [{"bone": name, "node": node} for name, node in BONES_OF.items()]}}}
    return {"nodes": nodes, "extensions": one if version else zero}


@pytest.mark.parametrize(("version", "place"), [(1, (-0.01, 0.2, -0.03)), (0, (0.01, 0.2, 0.03))])
def test_bones_rest_where_the_model_has_them(tmp_path: Path, version: int, place: Vector) -> None:
    found = of_model(model(tmp_path / "a.vrm", vrm(version)))
    assert set(found) == {"Chest", "Neck", "Head"}
    assert found["Neck"].place == pytest.approx(place)
    sign = 1 if version else -1
    assert found["Neck"].turned == pytest.approx((sign * HALF, 0, 0, HALF))
    assert found["Neck"].parent == pytest.approx((0, -HALF, 0, HALF))
    assert found["Head"].parent == pytest.approx(times(found["Neck"].parent, found["Neck"].turned))


@given(pitch=angles, yaw=angles, roll=angles)
@settings(max_examples=50)
def test_a_bone_that_rests_turned_turns_about_the_characters_axes(pitch: float, yaw: float, roll: float) -> None:
    channels = {**picture().channels, "head_pitch": pitch, "head_yaw": yaw, "head_roll": roll}
    rest = Rest(place=(0.0, 0.1, 0.0), turned=turn(10, 20, 30), parent=turn(-40, 15, 5))
    still = times(rest.parent, rest.turned)
    (_, now), = pose(channels, {"Head": rest}).values()  # fmt: skip
    assert times(times(rest.parent, now), back(still)) == pytest.approx(turn(pitch, yaw, roll), abs=1e-9)


CIRCLE = [{"children": [1]}, {"children": [2, 0]}, {"children": [3]}, {}]


@pytest.mark.parametrize(
    "document",
    [
        {"nodes": NODES},
        {"nodes": [], "extensions": vrm(1)["extensions"]},
        vrm(1, CIRCLE),
        vrm(1, [*NODES[:3], {"translation": ["a", 0, 0]}]),
        vrm(1, [*NODES[:3], {"translation": [1e9, 0, 0]}]),
        vrm(0, [*NODES[:3], {"rotation": [0, 0, 0, 0]}]),
        vrm(0, [*NODES[:3], {"matrix": [1.0] * 16}]),
        vrm(0, [*NODES[:3], {"children": ["x"]}]),
        {"nodes": 3, "extensions": vrm(0)["extensions"]},
        {"extensions": {"VRM": []}},
        [],
    ],
)  # fmt: skip
def test_a_broken_model_is_refused_in_one_line(tmp_path: Path, document: Any) -> None:
    with pytest.raises(InputError, match=r"expected the \.vrm of the character"):
        of_model(model(tmp_path / "a.vrm", document))


@given(data=st.binary(max_size=200), begun=st.booleans())
@settings(max_examples=50)
def test_rubbish_is_no_model(tmp_path_factory: pytest.TempPathFactory, data: bytes, begun: bool) -> None:
    path = tmp_path_factory.mktemp("model") / "a.vrm"
    path.write_bytes((struct.pack("<4sIIII", b"glTF", 2, 99, len(data), 0x4E4F534A) if begun else b"") + data)
    with pytest.raises(InputError):
        of_model(str(path))


def test_a_url_names_the_model(tmp_path: Path) -> None:
    path = model(tmp_path / "a.vrm", vrm(1))
    with receiver() as heard:
        stream = open_stream(f"vmc://127.0.0.1:{port(heard)}?model={path}")
        stream.target.send(picture())
        stream.target.close()
        wanted = packets(picture(), bones=of_model(path))
        assert heard_packets(heard, len(wanted)) == wanted
    assert [params[0] for kind, params in told(wanted) if kind == "Bone/Pos"] == ["Chest", "Neck", "Head"]
