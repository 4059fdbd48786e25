"""Key frames: the uniform ones, and what they would miss (A15, A16, A17)."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.curve_set import curves
from scorebreath.curves.lips.keys import key_times
from scorebreath.units import snap
from tests.curves.scores import score_of
from tests.curves.talk import Said, strings, utterance_of

RATES = (Fraction(24000, 1001), Fraction(25), Fraction(60))


@settings(max_examples=60, deadline=None)
@given(strings(), st.sampled_from(RATES))
def test_no_closure_and_no_phone_is_missed(said: Said, rate: Fraction) -> None:
    spoken = utterance_of(said, 1.0)
    score = score_of([spoken], duration=snap(spoken.end + 1.0))
    set_ = curves(score)
    times = key_times(set_, score.duration, rate)
    assert np.all(np.diff(times) > 0)
    assert len(np.unique(np.round(times * 1e6))) == len(times)
    frames = np.arange(int(score.duration * rate) + 1) / float(rate)
    assert np.isin(np.round(frames * 1e6), np.round(times * 1e6)).all()
    lips = set_.sources.lips
    for gate in (lips.closures, lips.tucks):
        for edge in (*gate.begin, *gate.end):
            assert np.abs(times - edge).min() < 1e-6
    for phone in spoken.phones:
        start = spoken.onset + phone.onset
        if phone.ipa:
            assert np.any((times >= start - 1e-6) & (times <= start + phone.duration + 1e-6))
    most = 4 * len(said) + len(said)
    assert len(times) <= len(frames) + most


def test_without_speech_they_are_the_frames() -> None:
    score = score_of([], duration=2.0)
    times = key_times(curves(score), 2.0, Fraction(30000, 1001))
    assert np.array_equal(times, np.arange(60) * 1001 / 30000)


@pytest.mark.parametrize("duration", [0.0, 1.05])
def test_none_is_past_the_end(duration: float) -> None:
    score = score_of([utterance_of([("m", 0.2), ("a", 0.2)], 1.0)], duration=3.0)
    times = key_times(curves(score), duration, Fraction(25))
    assert times[0] == 0.0
    assert times[-1] <= duration
    assert (1.0 in times) == (duration >= 1.0)
