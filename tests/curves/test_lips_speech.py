"""Lips of real speech: known phones, contact in every p b m, and a mouth that a breath hands over."""

from __future__ import annotations

import dataclasses
from fractions import Fraction

import numpy as np
import pytest

from scorebreath.curves.channels import CHANNELS
from scorebreath.curves.curve_set import curves
from scorebreath.curves.lips.handover import LEAD
from scorebreath.curves.lips.lips import LIP_CHANNELS
from scorebreath.curves.lips.targets import CLOSE, JAW, TUCK
from scorebreath.equations.phones import letters_of, makings
from scorebreath.score.document import Score
from scorebreath.score.events import Inspiration, Utterance
from tests.curves.scores import Breath, build
from tests.curves.talk import SENTENCES, fine, spoken

LANGUAGES = tuple(SENTENCES)
CLOSE_AT_MOST = 0.02


@pytest.fixture(scope="module", params=LANGUAGES)
def score(request: pytest.FixtureRequest) -> Score:
    return spoken(request.param)


def said(score: Score) -> list[tuple[str, float, float]]:
    return [
        (phone.ipa, utterance.onset + phone.onset, utterance.onset + phone.onset + phone.duration)
        for utterance in score.of(Utterance)
        for phone in utterance.phones
        if phone.ipa
    ]


def test_every_phone_is_known(score: Score) -> None:
    for ipa, _, _ in said(score):
        assert letters_of(ipa), ipa
        assert set(letters_of(ipa)) <= set(makings()), ipa


def test_speed_limits_hold(score: Score) -> None:
    names = [channel.name for channel in CHANNELS if channel.name in LIP_CHANNELS]
    speeds = np.array([channel.speed for channel in CHANNELS if channel.name in LIP_CHANNELS], dtype=np.float64)
    values = curves(score).sample(fine(-1.0, score.duration + 1.0), names)
    assert np.all(np.abs(np.diff(values, axis=0)).max(axis=0) <= speeds * 0.001)
    assert np.all(np.ptp(values, axis=0) > 0.3)


@pytest.mark.parametrize("rate", [Fraction(24), Fraction(24000, 1001), Fraction(25), Fraction(30), Fraction(60)])
def test_every_rate_has_a_closed_frame_in_every_p_b_m(score: Score, rate: Fraction) -> None:
    frames = np.arange(int(score.duration * rate)) / float(rate)
    jaw, mouth, close = curves(score).sample(frames, ["jaw_open", "mouth_open", "lip_close"]).T
    aperture = np.maximum(jaw, mouth) * (1.0 - close)
    closed = [(start, end) for ipa, start, end in said(score) if letters_of(ipa)[0] in "pbm"]
    assert len(closed) > 2
    for start, end in closed:
        near = (frames >= start - 0.05) & (frames <= end + 0.05)
        assert aperture[near].min() <= CLOSE_AT_MOST, (start, end)


def test_vowels_open_and_shape_the_mouth(score: Score) -> None:
    """At the middle of a long vowel the jaw is open, and lips are rounded where they should be."""
    set_ = curves(score)
    for ipa, start, end in said(score):
        if end - start < 0.09 or len(letters_of(ipa)) > 1 or makings()[letters_of(ipa)[0]] != "vowel":
            continue
        jaw, round_, spread = set_.sample([(start + end) / 2], ["jaw_open", "lip_round", "lip_spread"])[0]
        assert jaw > (0.35 if letters_of(ipa)[0] in "aɑæ" else 0.12), ipa
        if letters_of(ipa)[0] in "uoʊ":
            assert round_ > 0.4 > spread, ipa
        if letters_of(ipa)[0] in "ie":
            assert spread > 0.25 > round_, ipa


def test_the_breaths_mouth_does_not_snap_shut_before_speech(score: Score) -> None:
    """Between breath and first phone the opening never falls below where it goes, nor below both its ends."""
    set_ = curves(score)
    found = 0
    for breath in score.of(Inspiration):
        following = next((u for u in score.of(Utterance) if u.onset >= breath.end - 1e-6), None)
        if following is None or following.onset - breath.end > LEAD / 2:
            continue  # breathing on, at rest
        held = breath.onset + (breath.face.attack if breath.face else 0.0)
        opened = set_.sample(fine(held, following.onset), ["jaw_open", "mouth_open"]).max(axis=1)
        at_onset = set_.sample([following.onset], ["jaw_open"])[0, 0]
        assert opened.min() >= min(breath.mouth_open, at_onset) - 1e-9
        assert np.abs(np.diff(opened)).max() <= 0.008
        found += breath.mouth_open > 0
    assert found


@pytest.mark.parametrize("after", [0.0, 0.06, 0.3, 0.6])
def test_a_handover_keeps_to_the_utterances_reach_and_to_its_silence(after: float) -> None:
    score = build([Breath(after=after, mouth=1.0, opening=0.4)])
    onset = next(score.of(Utterance)).onset
    lips = curves(score).sources.lips
    alone = curves(dataclasses.replace(score, events=tuple(score.of(Utterance)))).sources.lips
    times = fine(0.0, score.duration)
    one, other = (each.sample(times, np.zeros(len(times))) for each in (lips, alone))
    changed = times[(one != other).any(axis=1)]
    assert len(changed) == 0 or (changed.min() >= onset - LEAD and changed.max() <= onset)
    assert (len(changed) > 0) == (after < 0.5)
    assert np.array_equal(np.delete(one, JAW, axis=1), np.delete(other, JAW, axis=1))


def test_lips_touch_teeth_in_f_and_v() -> None:
    score = spoken("en-us")
    set_ = curves(score)
    touching = [(start, end) for ipa, start, end in said(score) if ipa in "fv"]
    assert touching
    for start, end in touching:
        middle = set_.sample([(start + end) / 2], LIP_CHANNELS)[0]
        assert middle[TUCK] == 1.0
        assert middle[CLOSE] < 1.0 or any(abs(at - end) < 0.1 or abs(to - start) < 0.1 for _, at, to in said(score))
