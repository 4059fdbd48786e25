"""Rigs: a character's own shapes from the channels, whichever way the head is held."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.channels import CHANNELS
from scorebreath.curves.curve_set import curves
from scorebreath.curves.rigs.drivers import DRIVERS
from scorebreath.curves.rigs.rig import Rig, factors
from scorebreath.curves.rigs.table import RIGS, read_rig, rig_named
from scorebreath.errors import InputError
from scorebreath.score.acting import EMOTIONS
from scorebreath.score.document import Score
from scorebreath.score.events import Event
from tests.curves.acts import breathe_in, performances
from tests.curves.faces import blink, brow, emotion, gaze, head, said_in, whole_face
from tests.curves.scores import score_of

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


def shown(rig: str | Rig, score: Score, at: float, *, gate: bool = True) -> Mapping[str, float]:
    """A rig's columns at one moment."""
    found = rig_named(rig) if isinstance(rig, str) else rig
    values = found.sample(curves(score, closure_gate=gate), [at])[0].tolist()
    return dict(zip(found.columns, values, strict=True))


def only(*events: Event) -> Score:
    return score_of(events, duration=10.0)


@pytest.mark.parametrize("name", RIGS)
def test_the_table_is_whole(name: str) -> None:
    rig = rig_named(name)
    assert (rig.name, len(set(rig.columns))) == (name, len(rig.columns))
    assert rig.about and "character's" in rig.signs
    shares = rig.prototypes.names if rig.prototypes else ()
    known = {*(channel.name for channel in CHANNELS), *DRIVERS, *shares}
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
    rig, times = rig_named(name), np.arange(0, whole_face().duration, 0.01)
    moved = np.ptp(rig.sample(curves(whole_face()), times), axis=0)
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


# -- lips


def closures(*events: Event) -> tuple[Score, np.ndarray]:
    """Speech full of p, b and m with an open vowel between, and moments within its closures."""
    score = only(said_in(2.4, "a", "p", "a", "b", "a", "m", "a", "a"), *events)
    times = np.arange(0, 2.6, 1 / 240)
    return score, times[curves(score).sample(times, ["lip_close"])[:, 0] >= 0.98]


FEELINGS = [emotion(name, 0.0, duration=2.6, apex=1.3) for name in EMOTIONS]


@pytest.mark.parametrize("feeling", FEELINGS, ids=EMOTIONS)
def test_no_emotion_opens_p_b_m(feeling: Event) -> None:
    """Design, Mixing: aperture at most 2 % in closures; mouthClose at most jawOpen everywhere."""
    score, shut = closures(feeling)
    assert len(shut) >= 3 * 0.05 * 240
    arkit = rig_named("arkit")
    jaw, close = arkit.sample(curves(score), shut, ["jawOpen", "mouthClose"]).T
    assert np.all(close <= jaw) and float(np.max(jaw - close)) <= 0.02
    parting = ["mouthFunnel", "mouthLowerDownLeft", "mouthLowerDownRight", "mouthUpperUpLeft", "mouthUpperUpRight"]
    assert np.max(arkit.sample(curves(score), shut, parting)) <= 0.02
    everywhere = arkit.sample(curves(score), np.arange(0, 3, 0.007), ["jawOpen", "mouthClose"])
    assert np.all(everywhere[:, 1] <= everywhere[:, 0])
    lips = rig_named("fap").sample(curves(score), shut, ["raise_b_midlip", "lower_t_midlip", "raise_b_lip_lm"])
    assert np.max(np.abs(lips)) <= 0.02 * 1536
    muscles = rig_named("muscles").sample(
        curves(score), shut, ["orbicularis_oris_marginal", "depressor_labii_inferioris_left"]
    )
    assert np.min(muscles[:, 0]) >= 0.98 and np.max(muscles[:, 1]) <= 0.02
    assert np.min(rig_named("oculus").sample(curves(score), shut, ["PP"])) >= 0.98


def test_without_the_gate_it_is_the_paper_s_plain_sum() -> None:
    """A18, A43: contractions of speech and of emotion add up, and nothing else happens to them."""
    score, shut = closures(FEELINGS[EMOTIONS.index("surprised")])
    times = np.arange(0, 2.6, 0.005)
    plain, gated = curves(score, closure_gate=False), curves(score)
    rig = rig_named("muscles")
    found = rig.sample(plain, times, ["digastric", "levator_labii_superioris_left", "zygomatic_major_left"])
    names = ["jaw_open", "mouth_open", "lip_round", "lip_tuck", "lip_spread", "emotion_surprised"]
    jaw, breath, rounded, tuck, spread, felt = plain.sample(times, names).T
    np.testing.assert_allclose(found[:, 0], np.clip(np.maximum(jaw, breath) + 0.35 * felt, 0, 1), atol=1e-12)
    np.testing.assert_allclose(found[:, 1], np.clip(0.2 * jaw * (1 - rounded) + 0.15 * tuck, 0, 1), atol=1e-12)
    np.testing.assert_allclose(found[:, 2], np.clip(0.6 * spread, 0, 1), atol=1e-12)
    open_ = rig_named("arkit").sample(plain, shut, ["jawOpen"]) - rig_named("arkit").sample(plain, shut, ["mouthClose"])
    assert np.max(open_) > 0.2  # which is why there is a gate
    assert curves(score).closure_gate and gated.closure_gate


@pytest.mark.parametrize("name", RIGS)
def test_outside_closures_the_sum_is_exact(name: str) -> None:
    score, _ = closures(*FEELINGS[:2])
    rig, times = rig_named(name), np.arange(0, 2.6, 0.002)
    gated, plain = curves(score), curves(score, closure_gate=False)
    channels = ["lip_close", "jaw_open", "lip_round", "lip_spread", "lip_tuck", "tongue_tip", "tongue_back"]
    same = np.all(gated.sample(times, channels) == plain.sample(times, channels), axis=1)
    same &= gated.sample(times, ["lip_close"])[:, 0] <= 0.5
    assert same.sum() > 400 and not same.all()
    assert np.array_equal(rig.sample(gated, times)[same], rig.sample(plain, times)[same])


def test_a_breath_opens_the_mouth_of_every_rig() -> None:
    score = only(breathe_in(duration=1.0, mouth_open=0.3))
    assert shown("arkit", score, 0.4)["jawOpen"] == pytest.approx(0.3)
    assert shown("livelink", score, 0.4)["JawOpen"] == pytest.approx(0.3)
    assert shown("muscles", score, 0.4)["digastric"] == pytest.approx(0.3)
    assert shown("fap", score, 0.4)["open_jaw"] == pytest.approx(0.3 * 25 / 20 * 1024)
    found = shown("oculus", score, 0.4)
    assert found["aa"] > 0.45 and found["aa"] + found["sil"] == pytest.approx(1.0, abs=0.02)
    assert shown("arkit", score, 0.4)["nostrilDilateLeft"] == pytest.approx(0.2)
    assert shown("livelink", score, 0.4)["NoseSneerLeft"] == pytest.approx(0.05)


@pytest.mark.parametrize(
    ("phone", "viseme"),
    [
        ("p", {"PP"}), ("b", {"PP"}), ("m", {"PP"}), ("f", {"FF"}), ("v", {"FF"}), ("θ", {"TH"}), ("t", {"DD", "nn"}),
        ("d", {"DD", "nn"}), ("n", {"DD", "nn"}), ("k", {"kk"}), ("ɡ", {"kk"}), ("ʃ", {"CH"}), ("s", {"SS"}),
        ("ɹ", {"RR"}),
        ("ɑ", {"aa"}), ("a", {"aa"}), ("ɛ", {"E"}), ("iː", {"ih"}), ("ɪ", {"ih"}), ("ɔ", {"oh"}), ("uː", {"ou"}),
        ("", {"sil"}),
    ],
)  # fmt: skip
def test_a_long_phone_shows_its_viseme(phone: str, viseme: set[str]) -> None:
    found = shown("oculus", only(said_in(1.5, "", phone, "")), 0.75)
    weights = {name: found[name] for name in KHRONOS}
    assert max(weights, key=weights.__getitem__) in viseme, weights
    assert sum(weights.values()) == pytest.approx(1.0)


def test_visemes_add_up_to_one_and_move_without_steps() -> None:
    score = only(said_in(3.0, "p", "a", "f", "uː", "θ", "iː", "k", "ɔ", "m", "ʃ", "s", "n"))
    times = np.arange(0, 3.2, 0.001)
    weights = rig_named("oculus").sample(curves(score), times, KHRONOS)
    np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-9)
    assert np.max(np.abs(np.diff(weights, axis=0))) < 0.2


def test_round_lips_are_a_funnel_or_a_pucker() -> None:
    """Physiology 7.3: ou is a pucker, oh and sh are funnels."""
    for phone, most in (("uː", "mouthPucker"), ("ɔ", "mouthFunnel"), ("ʃ", "mouthFunnel")):
        found = shown("arkit", only(said_in(1.5, "", phone, "")), 0.75)
        other = "mouthFunnel" if most == "mouthPucker" else "mouthPucker"
        assert found[most] > 0.25 and found[most] > found[other], phone
    assert shown("arkit", only(said_in(1.5, "", "f", "")), 0.75)["mouthRollLower"] > 0.3
    assert shown("arkit", only(said_in(1.5, "", "ɑ", "")), 0.75)["jawOpen"] > 0.45
    smile = shown("arkit", only(said_in(1.5, "", "iː", "")), 0.75)
    assert smile["mouthSmileLeft"] == smile["mouthSmileRight"] > 0.15


# -- rigs of one's own


def test_a_rig_like_another_changes_what_it_says() -> None:
    rig = read_rig("mine", """
        like = "arkit"
        order = ["jawOpen", "headYaw", "smile", "mood"]
        [units]
        percent = 100.0
        [columns]
        headYaw = { from = { head_yaw = -2.0 }, low = -90, high = 90, unit = "deg", negative = "allow" }
        smile = { from = { lip_spread = 0.5 }, unit = "percent" }
        mood = { from = { thorax = 1.0 }, negative = "offset" }
        [emotions.happy]
        smile = 0.4
    """)  # fmt: skip
    assert rig.columns == ("jawOpen", "headYaw", "smile", "mood")
    found = shown(rig, only(head(1.0, yaw=8.0), emotion("happy", 0.4)), 1.4)
    assert (found["headYaw"], found["smile"], found["jawOpen"]) == pytest.approx((-16.0, 40.0, 0.0))
    assert found["mood"] == 0.5
    assert rig.table[2].high == 100.0
    breath = shown(rig, only(breathe_in(duration=1.0)), 0.9)
    thorax = curves(only(breathe_in(duration=1.0))).sample([0.9], ["thorax"])[0, 0]
    assert breath["mood"] == pytest.approx(0.5 + 0.5 * thorax) != 0.5


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("columns", "rig mine: no TOML"),
        ("[colums]", "rig mine: section 'colums' is unknown; did you mean columns?"),
        ("", r"rig mine: \[columns\] is empty"),
        ('like = "bones"', "rig mine: like = 'bones'; expected one of arkit, livelink"),
        ("columns = 3", "rig mine: columns = 3; expected a table"),
        ("[columns]\na = 3", "rig mine: a = 3; expected a table"),
        ('[columns]\na = { form = {} }', "rig mine: a: key 'form' is unknown; did you mean from?"),
        ("[columns]\na = { from = { jaw = 1 } }", "rig mine: a: from 'jaw' is unknown; did you mean jaw_open"),
        ("[columns]\na = { from = 3 }", "rig mine: a: from = 3; expected a table"),
        ('[columns]\na = { from = { jaw_open = "1" } }', "rig mine: a: jaw_open = '1'; expected a number"),
        ('[columns]\na = { from = { "a * b * c" = 3 } }', "rig mine: a: from 'a' is unknown"),
        ('[columns]\na = { from = { "thorax * thorax * thorax" = 3 } }', "products of two at most"),
        ("[columns]\na = { low = 2 }", "rig mine: a: low = 2 must be below high = 1"),
        ("[columns]\na = { high = inf }", "rig mine: a: high = inf; expected a number"),
        ('[columns]\na = { negative = "flip" }', "rig mine: a: negative = 'flip'; expected clip, offset, allow"),
        ("[columns]\na = {}\n[emotions.hapy]\na = 1", "rig mine: emotions 'hapy' is unknown; did you mean happy?"),
        ("[columns]\na = {}\n[emotions.happy]\nb = 1", "rig mine: happy: no column is called 'b'"),
        ("[columns]\na = {}\n[closure]\nb = 1", "rig mine: closure: no column is called 'b'"),
        ("[columns]\na = {}\n[closure]\na = 2", r"rig mine: closure: a = 2 must be in \[0, 1\]"),
        ('[columns]\na = {}\n[closure]\na = "b"', "rig mine: closure: a 'b' is unknown"),
        ('[columns]\na = {}\n[yields]\na = "b"', "rig mine: yields: a 'b' is unknown"),
        ('order = ["b"]\n[columns]\na = {}', "rig mine: order 'b' is unknown"),
        ('names = "upper"\n[columns]\na = {}', "rig mine: names = 'upper'; expected pascal"),
        ("[columns]\na = {}\n[prototypes]\nchannels = ['jaw_open']\nwidths = [0]\n[prototypes.points]\nv = [1]",
         "rig mine: prototypes: expected 1 numbers a row, and widths above 0"),
    ],
)  # fmt: skip
def test_a_broken_rig_is_refused_where_it_is_broken(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_rig("mine", text)


def test_a_rig_is_found_by_name_or_path(tmp_path: Any) -> None:
    with pytest.raises(InputError, match="no rig is called 'arkti'; did you mean arkit"):
        rig_named("arkti")
    with pytest.raises(InputError, match="cannot be read"):
        rig_named(str(tmp_path / "none.toml"))
    path = tmp_path / "puppet.toml"
    path.write_text("[columns]\nmouth = { from = { mouth = 1.0 } }\n")
    assert dataclasses.replace(rig_named(str(path)), table=()).name == "puppet"
