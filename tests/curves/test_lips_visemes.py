"""Visemes: every sound shows its own, shares add up to 1, nothing steps."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.curves.curve_set import curves
from scorebreath.curves.lips.visemes import SILENCE, VISEMES, WINDOW, shown
from scorebreath.equations.phones import makings
from scorebreath.units import snap
from tests.curves.faces import only, said_in

MAKINGS = {
    "PP": {"bilabial", "bilabial_open"}, "FF": {"labiodental", "labiodental_open"}, "TH": {"dental"},
    "DD": {"alveolar", "retroflex"}, "kk": {"velar", "uvular", "palatal"}, "CH": {"hushing", "sibilant", "retroflex"},
    "SS": {"sibilant"}, "nn": {"alveolar", "retroflex", "palatal"}, "RR": {"alveolar", "retroflex", "vowel", "hushing"},
    "aa": {"vowel"}, "E": {"vowel"}, "ih": {"vowel", "palatal"}, "oh": {"vowel"}, "ou": {"vowel", "rounded"},
}  # fmt: skip


def test_every_letter_shows_one_viseme_but_those_made_below_the_mouth() -> None:
    assert {letter for letter, making in makings().items() if making != "throat"} == set(shown())
    assert set(shown().values()) == set(VISEMES) - {SILENCE}
    assert set(MAKINGS) == set(shown().values())


@pytest.mark.parametrize("letter", shown())
def test_a_viseme_fits_what_makes_the_sound(letter: str) -> None:
    assert makings()[letter] in MAKINGS[shown()[letter]]


@given(
    st.lists(st.sampled_from(["p", "a", "h", "", "t", "ʃ", "aɪ", "ʔ", "θ"]), min_size=1, max_size=12),
    st.floats(0.05, 3),
)
def test_shares_add_up_to_one_and_change_no_faster_than_the_window(said: list[str], seconds: float) -> None:
    seconds = snap(seconds)
    score = only(said_in(seconds, *said))
    times = np.arange(-0.2, seconds + 1.4, 0.001)
    shares = curves(score).visemes(times)
    np.testing.assert_allclose(shares.sum(axis=1), 1.0, atol=1e-12)
    assert shares.min() >= 0.0
    assert np.abs(np.diff(shares, axis=0)).max() <= 1.5 / WINDOW * 0.001 + 1e-9
    assert np.array_equal(curves(score).visemes(times[::7]), shares[::7])


def test_a_short_phone_in_fluent_speech_still_shows_its_own() -> None:
    """12 phones a second, each 80 ms: l between round vowels is no ch, th is no d."""
    said = ["uː", "l", "uː", "ð", "uː", "n", "ɔ", "θ", "ɪ", "t"]
    score = only(said_in(0.8, *said))
    onset = next(iter(score.events)).onset
    middles = onset + 0.04 + 0.08 * np.arange(len(said))
    best = [VISEMES[place] for place in curves(score).visemes(middles).argmax(axis=1)]
    assert best == ["ou", "nn", "ou", "TH", "ou", "nn", "oh", "TH", "ih", "DD"]
    assert curves(score).visemes(middles).max(axis=1).min() > 0.85


def test_what_is_made_below_the_mouth_shows_what_follows() -> None:
    def at(moment: float, *said: str) -> str:
        score = only(said_in(snap(0.2 * len(said)), *said))
        time = next(iter(score.events)).onset + moment
        return VISEMES[int(curves(score).visemes([time])[0].argmax())]

    assert at(0.1, "h", "uː") == "ou"
    assert at(0.3, "a", "ʔ") == "aa"
    assert at(0.1, "h") == "E"
    assert at(0.1, "h", "", "uː") == "E"  # a pause between them
