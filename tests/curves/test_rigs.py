"""Rigs: a character's own shapes from the channels, whichever way the head is held."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.channels import CHANNELS
from scorebreath.curves.curve_set import curves
from scorebreath.curves.rigs.drivers import DRIVERS
from scorebreath.curves.rigs.rig import factors
from scorebreath.curves.rigs.table import RIGS, rig_named
from scorebreath.errors import InputError
from scorebreath.score.acting import EMOTIONS
from scorebreath.score.document import Score
from tests.curves.acts import performances
from tests.curves.faces import blink, brow, emotion, gaze, head, only, shown, speaking, whole_face

COUNTED = settings(max_examples=20, deadline=None)
APPLE = [
    "eyeBlinkLeft", "eyeLookDownLeft", "eyeLookInLeft", "eyeLookOutLeft", "eyeLookUpLeft", "eyeSquintLeft",
    "eyeWideLeft", "eyeBlinkRight", "eyeLookDownRight", "eyeLookInRight", "eyeLookOutRight", "eyeLookUpRight",
    "eyeSquintRight", "eyeWideRight", "jawForward", "jawLeft", "jawRight", "jawOpen", "mouthClose", "mouthFunnel",
    "mouthPucker", "mouthLeft", "mouthRight", "mouthSmileLeft", "mouthSmileRight", "mouthFrownLeft",
    "mouthFrownRight", "mouthDimpleLeft", "mouthDimpleRight", "mouthStretchLeft", "mouthStretchRight",
    "mouthRollLower", "mouthRollUpper", "mouthShrugLower", "mouthShrugUpper", "mouthPressLeft", "mouthPressRight",
    "mouthLowerDownLeft", "mouthLowerDownRight", "mouthUpperUpLeft", "mouthUpperUpRight", "browDownLeft",
    "browDownRight", "browInnerUp", "browOuterUpLeft", "browOuterUpRight", "cheekPuff", "cheekSquintLeft",
    "cheekSquintRight", "noseSneerLeft", "noseSneerRight", "tongueOut",
]  # fmt: skip
KHRONOS = ["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"]
RADIAN, AU = np.pi / 180, 1e5 * np.pi / 180


@pytest.mark.parametrize("name", RIGS)
def test_the_table_is_whole(name: str) -> None:
    rig = rig_named(name)
    assert (rig.name, len(set(rig.columns))) == (name, len(rig.columns))
    assert rig.about and "character's" in rig.signs
    known = {*(channel.name for channel in CHANNELS), *DRIVERS}
    for column in rig.table:
        assert {name for part in column.parts for name in factors(part)} <= known, column.name
        assert set(column.emotions) <= set(EMOTIONS), column.name
        assert column.low <= 0 < column.high and 0 <= column.gate <= 1, column.name
        assert column.shuts in ("", "high", *rig.columns), column.name
        assert column.made_of, column.name


def test_arkit_has_always_all_52_columns_in_apple_s_names() -> None:
    assert list(rig_named("arkit").columns[:52]) == APPLE
    assert all((column.low, column.high) == (0, 1) for column in rig_named("arkit").table[:52])
    assert sorted(name[:1].upper() + name[1:] for name in APPLE) == sorted(rig_named("livelink").columns[:52])


def test_oculus_has_the_visemes_in_khronos_order() -> None:
    assert list(rig_named("oculus").columns[:15]) == KHRONOS


@pytest.mark.parametrize("name", RIGS)
def test_every_column_that_is_made_of_something_moves(name: str) -> None:
    said = ("p", "a", "f", "uː", "θ", "iː", "k", "ɔ", "m", "ʃ", "s", "t", "ɛ", "n", "ɹ")
    rig, score = rig_named(name), speaking(whole_face(), said)
    moved = np.ptp(rig.sample(curves(score), np.arange(0, score.duration, 0.01)), axis=0)
    for column, by in zip(rig.table, moved, strict=True):
        assert (by > 1e-3) == bool(column.parts or column.emotions), column.name


@pytest.mark.parametrize("name", RIGS)
@COUNTED
@given(score=performances() | st.just(whole_face()), gate=st.booleans())
def test_no_value_leaves_its_range(name: str, score: Score, gate: bool) -> None:
    rig = rig_named(name)
    values = rig.sample(curves(score, closure_gate=gate), np.arange(-0.5, score.duration + 0.5, 0.011))
    assert np.all(np.isfinite(values))
    for column, low, high in zip(rig.table, values.min(axis=0), values.max(axis=0), strict=True):
        assert column.low <= low <= high <= column.high, column.name


@pytest.mark.parametrize("name", RIGS)
def test_a_row_depends_on_its_own_time_and_a_column_on_itself_alone(name: str) -> None:
    rig, set_ = rig_named(name), curves(whole_face())
    times = np.arange(0, 4, 0.013)
    whole = rig.sample(set_, times)
    assert np.array_equal(rig.sample(set_, times[::-7]), whole[::-7])
    assert np.array_equal(rig.sample(set_, times[100]), whole[100:101])
    for number, column in enumerate(rig.columns):
        assert np.array_equal(rig.sample(set_, times, [column])[:, 0], whole[:, number]), column
    assert rig.sample(set_, times, rig.columns[4:1:-1]).tolist() == whole[:, 4:1:-1].tolist()
    with pytest.raises(InputError, match=f"rig {name} has no column 'noSuch'"):
        rig.sample(set_, times, ["noSuch"])


@pytest.mark.parametrize(
    ("rig", "names", "scale"),
    [
        ("arkit", ("headPitch", "headYaw", "headRoll", "eyePitch", "eyeYaw"), (1, 1, 1, 1, 1)),
        ("oculus", ("headPitch", "headYaw", "headRoll", "eyePitch", "eyeYaw"), (1, 1, 1, 1, 1)),
        ("muscles", ("head_pitch", "head_yaw", "head_roll", "eye_pitch", "eye_yaw"), (1, 1, 1, 1, 1)),
        ("livelink", ("HeadPitch", "HeadYaw", "HeadRoll", "LeftEyePitch", "RightEyeYaw"), (-RADIAN,) * 5),
        ("fap", ("head_pitch", "head_yaw", "head_roll", "pitch_l_eyeball", "yaw_r_eyeball"), (-AU, AU, AU, -AU, AU)),
    ],
)
@pytest.mark.parametrize(
    "held", [(10.0, 0.0, 0.0), (0.0, 10.0, 0.0), (0.0, 0.0, 10.0)], ids=["up", "left", "right-tilt"]
)
def test_heads_are_held_as_each_rig_has_it(
    rig: str, names: tuple[str, ...], scale: tuple[float, ...], held: tuple[float, float, float]
) -> None:
    """Up, to the character's left, tilted to its right shoulder; the eyes stay on the listener."""
    pitch, yaw, roll = held
    score = only(head(1.0, pitch=pitch, yaw=yaw, roll=roll), gaze(0.5, yaw=0.0, duration=2.0))
    found = shown(rig, score, 1.4)
    expected = [angle * factor for angle, factor in zip((pitch, yaw, roll, -pitch, -yaw), scale, strict=True)]
    assert [found[name] for name in names] == pytest.approx(expected)


@pytest.mark.parametrize("rig", ["arkit", "livelink"])
def test_looks_and_lids_have_their_sides(rig: str) -> None:
    def has(found: Mapping[str, float], name: str) -> float:
        return found[name if rig == "arkit" else name[:1].upper() + name[1:]]

    left = shown(rig, only(gaze(1.0, yaw=10.5, pitch=7.0)), 1.5)
    assert has(left, "eyeLookOutLeft") == has(left, "eyeLookInRight") == pytest.approx(0.3, abs=1e-4)
    assert has(left, "eyeLookInLeft") == has(left, "eyeLookOutRight") == has(left, "eyeLookDownLeft") == 0
    assert has(left, "eyeLookUpLeft") == has(left, "eyeLookUpRight") == pytest.approx(0.2, abs=1e-4)
    assert has(left, "eyeWideRight") == pytest.approx(0.012 * 7) and has(left, "eyeBlinkRight") == 0
    down = shown(rig, only(gaze(1.0, yaw=-10.5, pitch=-7.0)), 1.5)
    assert has(down, "eyeLookOutRight") == has(down, "eyeLookInLeft") == pytest.approx(0.3, abs=1e-4)
    assert has(down, "eyeBlinkLeft") == pytest.approx(0.018 * 7) and has(down, "eyeWideLeft") == 0
    wink = shown(rig, only(blink(1.0, left=0.0)), 1.08)
    assert (has(wink, "eyeBlinkLeft"), has(wink, "eyeBlinkRight")) == (0.0, 1.0)


def test_brows_have_their_sides() -> None:
    score = only(brow(1.0, left=0.6, right=0.2, frown=0.3))
    arkit, fap, muscles = (shown(name, score, 1.2) for name in ("arkit", "fap", "muscles"))
    assert (arkit["browOuterUpLeft"], arkit["browOuterUpRight"]) == pytest.approx((0.6, 0.2))
    assert (arkit["browInnerUp"], arkit["browDownLeft"]) == pytest.approx((0.4, 0.3))
    assert fap["raise_l_o_eyebrow"] > fap["raise_r_o_eyebrow"] > 0 and fap["squeeze_l_eyebrow"] > 0
    assert (muscles["frontalis_outer_left"], muscles["frontalis_outer_right"]) == pytest.approx((0.6, 0.2))


PRESETS = {
    "happy": {"mouthSmile*": 0.7, "cheekSquint*": 0.5, "eyeSquint*": 0.25, "mouthDimple*": 0.1},
    "sad": {"browInnerUp": 0.7, "browDown*": 0.2, "mouthFrown*": 0.55, "mouthShrugLower": 0.25, "headPitch": -4.0},
    "angry": {
        "browDown*": 0.8, "eyeSquint*": 0.45, "eyeWide*": 0.2, "mouthPress*": 0.45, "noseSneer*": 0.2,
        "jawForward": 0.15, "nostrilDilate*": 0.7,
    },
    "surprised": {"browInnerUp": 0.8, "browOuterUp*": 0.8, "eyeWide*": 0.7, "jawOpen": 0.35},
    "disgusted": {
        "noseSneer*": 0.75, "mouthUpperUp*": 0.45, "browDown*": 0.35, "mouthFrown*": 0.3, "mouthShrugLower": 0.25,
        "eyeSquint*": 0.25,
    },
    "kidding": {
        "mouthSmileRight": 0.6, "mouthSmileLeft": 0.35, "cheekSquintRight": 0.5, "browOuterUpLeft": 0.35,
        "headRoll": 4.0,
    },
    "afraid": {
        "browInnerUp": 0.6, "browOuterUp*": 0.4, "browDown*": 0.3, "eyeWide*": 0.6, "mouthStretch*": 0.4,
        "jawOpen": 0.15,
    },
}  # fmt: skip
"""Physiology 7.7 at full intensity; kidding's wink is a blink of its own."""


@pytest.mark.parametrize("name", EMOTIONS)
def test_emotions_are_their_presets_and_half_of_one_is_half_of_it(name: str) -> None:
    expected = {
        name.replace("*", side): weight
        for name, weight in PRESETS[name].items()
        for side in (("Left", "Right") if "*" in name else ("",))
    }
    for at, share in ((2.0, 1.0), (1.5, 0.5)):
        found = shown("arkit", only(emotion(name, 1.0), gaze(0.5, yaw=0.0, duration=3.0)), at)
        for column, weight in expected.items():
            assert found[column] == pytest.approx(share * weight), column
        lids = {"eyeBlinkLeft", "eyeBlinkRight", "eyeWideLeft", "eyeWideRight", "eyePitch"} | {
            f"eyeLook{way}{side}" for way in ("Up", "Down") for side in ("Left", "Right")
        }  # of sad: half shut, and the head is down
        rest = {column: value for column, value in found.items() if column not in {*expected, *lids}}
        assert not any(rest.values()), name
    assert set(PRESETS) == set(EMOTIONS)


def test_emotions_add_up_and_are_held_within_the_range() -> None:
    """A43, Y5: different ones sum."""
    both = only(emotion("sad", 1.0), emotion("afraid", 1.0))
    found = shown("arkit", both, 2.0)
    assert found["browInnerUp"] == 1.0  # 0.7 + 0.6
    assert found["browDownLeft"] == pytest.approx(0.2 + 0.3)


@pytest.mark.parametrize(("rig", "wide", "shut"), [
    ("arkit", "eyeWideLeft", "eyeBlinkLeft"), ("muscles", "levator_palpebrae_left", "orbicularis_oculi_palpebral_left"),
])  # fmt: skip
def test_a_lid_that_shuts_is_not_wide(rig: str, wide: str, shut: str) -> None:
    score = only(emotion("surprised", 1.0), blink(1.92))
    found, before = shown(rig, score, 2.0), shown(rig, score, 1.9)
    assert (found[wide], found[shut]) == (0.0, 1.0)
    assert before[wide] == pytest.approx(0.7 * 0.9)
    assert shown("fap", score, 2.0)["close_t_l_eyelid"] == pytest.approx(10 * 1024 / 12)
