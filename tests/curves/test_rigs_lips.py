"""Rigs while speaking: what closes is closed, visemes, the plain sum of the paper."""

from __future__ import annotations

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.curves.rigs.table import RIGS, rig_named
from scorebreath.score.acting import EMOTIONS
from scorebreath.score.document import Score
from scorebreath.score.events import Event
from tests.curves.acts import breathe_in
from tests.curves.faces import blink, emotion, only, said_in, shown

KHRONOS = ["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"]


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
    same &= gated.contact(times) == 0.0
    assert same.sum() > 400 and not same.all()
    assert np.array_equal(rig.sample(gated, times)[same], rig.sample(plain, times)[same])


def test_shapes_give_way_to_a_closure_no_faster_than_lips_shut() -> None:
    """A funnel beside p, b or m fades over the whole ramp, and a smile stays one."""
    score = only(said_in(2.4, "ɔ", "b", "ɔ", "p", "ɔ", "m", "ɔ", "a"), emotion("happy", 0.0, duration=2.6, apex=1.3))
    times = np.arange(0, 2.6, 1 / 1000)
    found = rig_named("arkit").sample(curves(score), times, ["mouthFunnel", "mouthPressLeft", "mouthUpperUpLeft"])
    assert found[:, 0].max() > 0.3
    assert np.all(np.abs(np.diff(found, axis=0)).max(axis=0) * 1000 < [25 * 0.66, 25 * 0.36, 25 * 0.3])
    contact = curves(score).contact(times)
    shut = contact == 1.0
    smile = rig_named("arkit").sample(curves(score), times, ["mouthSmileLeft"])[:, 0]
    without = rig_named("arkit").sample(curves(score, closure_gate=False), times, ["mouthSmileLeft"])[:, 0]
    assert shut.sum() > 150 and np.all(smile[shut] >= 0.84 * without[shut])


def test_nothing_yields_in_the_plain_sum() -> None:
    """A43: a lid that shuts takes the wide eyes of surprise away, but not from the paper's sum."""
    score = only(blink(1.0), emotion("surprised", 0.0, duration=2.6, apex=1.3))
    at = curves(score).sample(times := np.arange(1.0, 1.3, 0.01), ["lid_left"])[:, 0].argmax()
    rig, lid = rig_named("muscles"), ["levator_palpebrae_left"]
    assert rig.sample(curves(score), [times[at]], lid)[0, 0] < 0.1
    assert rig.sample(curves(score, closure_gate=False), [times[at]], lid)[0, 0] > 0.5


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
        ("p", {"PP"}), ("b", {"PP"}), ("m", {"PP"}), ("f", {"FF"}), ("v", {"FF"}), ("θ", {"TH"}), ("t", {"DD"}),
        ("d", {"DD"}), ("n", {"nn"}), ("k", {"kk"}), ("ɡ", {"kk"}), ("ʃ", {"CH"}), ("s", {"SS"}),
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
