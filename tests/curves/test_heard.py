"""Levels follow moves of parameters, as far as they are heard at once."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.score.document import Score
from scorebreath.score.events import Cut, Event, Heard, Inspiration, Parameter, Utterance
from tests.curves.cutting import compiled
from tests.curves.scores import Breath, build

HALF = Heard(speech=0.5, mouth=0.5, nose=0.5)


def move(onset: float, heard: Heard | None, *, glide: float = 0.0, name: str = "") -> Parameter:
    """A knob is turned."""
    return Parameter(
        id=name or f"move{onset}", body="body", onset=onset, duration=glide, name="loudness", value=50.0, glide=glide,
        heard=heard,
    )  # fmt: skip


def moved(score: Score, *events: Event) -> Score:
    """The Score with moves in it."""
    return dataclasses.replace(score, events=(*score.events, *events))


def changes(before: Score, after: Score, name: str, times: np.ndarray) -> np.ndarray:
    """How many dB louder a level is, where there is any."""
    was, now = (curves(score).sample(times, [name])[:, 0] for score in (before, after))
    heard = (was > -60) & (now > -79)
    return np.where(heard, now - was, np.nan)


def test_a_move_is_heard_from_its_onset_on_until_another_one() -> None:
    """Half the amplitude is 6 dB less; None says nothing; what is silent stays silent."""
    score = build([Breath(), Breath()])
    later = moved(score, move(2.0, HALF), move(3.0, None), move(4.5, Heard()))
    times = np.arange(0.0, score.duration, 0.01)
    change = changes(score, later, "speech_level", times)
    inside = (times >= 2.0) & (times < 4.5)
    assert np.nanmax(np.abs(change[~inside])) == 0.0
    assert change[inside & ~np.isnan(change)] == pytest.approx(-6.0206, abs=1e-3)
    assert (~np.isnan(change[inside])).sum() > 50
    silent = curves(score).sample(times, ["speech_level"])[:, 0] == -80.0
    assert np.all(curves(later).sample(times, ["speech_level"])[silent, 0] == -80.0)


def test_a_glide_is_a_straight_line_of_gains_and_the_next_one_goes_on_from_it() -> None:
    """From 1 towards 0.5, and half way back to 1."""
    score = build([Breath(speech=6.0)])
    later = moved(score, move(2.0, HALF, glide=1.0), move(2.5, Heard(), glide=1.0))
    times = np.array([2.25, 2.5, 3.0, 3.5, 4.0])
    gains = 10 ** (changes(score, later, "speech_level", times) / 20)
    assert gains == pytest.approx([0.875, 0.75, 0.875, 1.0, 1.0], abs=1e-6)


def test_mouth_and_nose_have_gains_of_their_own() -> None:
    """A breath through the nose alone does not hear the mouth; both together are mixed as they sound."""
    times = np.arange(0.0, 1.0, 0.01)
    for nose, mouth, gains, expected in (
        (1.0, 0.0, Heard(mouth=0.1), 0.0),
        (1.0, 0.0, Heard(nose=0.5), -6.0206),
        (0.0, 1.0, Heard(mouth=2.0), 6.0206),
        (1.0, 1.0, Heard(nose=0.0), 20 * np.log10(1 / np.hypot(1.0, 10 ** (-6 / 20)))),
    ):
        score = build([Breath(nose=nose, mouth=mouth)])
        change = changes(score, moved(score, move(0.0, gains)), "breath_level", times)
        assert change[~np.isnan(change)] == pytest.approx(expected, abs=1e-3)
        assert (~np.isnan(change)).sum() > 20


def test_recorded_breaths_follow_the_mouth() -> None:
    """Whichever way they went."""
    score = build([Breath(nose=1.0, mouth=0.0)])
    events = tuple(
        dataclasses.replace(e, noise=dataclasses.replace(e.noise, source="0" * 64))
        if isinstance(e, Inspiration) and e.noise is not None
        else e
        for e in score.events
    )
    score = dataclasses.replace(score, events=events)
    change = changes(score, moved(score, move(0.0, Heard(mouth=0.5))), "breath_level", np.arange(0.0, 1.0, 0.01))
    assert change[~np.isnan(change)] == pytest.approx(-6.0206, abs=1e-3)


def test_a_move_that_is_cut_before_it_comes_never_happens() -> None:
    """And of several at once the last one counts."""
    score = build([Breath()])
    times = np.arange(0.0, score.duration, 0.01)
    never = moved(score, move(2.0, HALF, name="m"), Cut(
        id="c", body="body", onset=1.9, duration=0.0, targets=("m",), fade=0.0
    ))  # fmt: skip
    assert np.nanmax(np.abs(changes(score, never, "speech_level", times))) == 0.0
    twice = moved(score, move(2.0, HALF, name="one"), move(2.0, Heard(), name="two"))
    assert np.nanmax(np.abs(changes(score, twice, "speech_level", times))) == 0.0


def test_moves_change_nothing_but_levels() -> None:
    """The plan follows them, not what is under way."""
    score = compiled()
    said = next(score.of(Utterance))
    found, plain = curves(moved(score, move(said.onset, HALF, glide=0.3))), curves(score)
    rest = [name for name in plain.channels if not name.endswith("_level")]
    times = np.arange(0.0, 20.0, 0.05)
    assert np.array_equal(found.sample(times, rest), plain.sample(times, rest))
    assert not np.array_equal(found.sample(times), plain.sample(times))
