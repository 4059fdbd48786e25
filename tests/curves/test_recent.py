"""The present of a long performance needs little of its past."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.curve_set import curves
from scorebreath.curves.recent import KEPT, recent
from scorebreath.curves.settling import MOVEMENTS
from scorebreath.score.document import Score
from scorebreath.score.events import Cut, Heard, Parameter, Utterance
from scorebreath.units import snap
from tests.curves.cutting import compiled, everything, restarted
from tests.curves.scores import on_grid


def roomy(score: Score) -> Score:
    """With room behind it."""
    return dataclasses.replace(score, duration=400.0, text=score.text.ljust(2000))


@settings(max_examples=15, deadline=None)
@given(st.lists(on_grid(0.5, 14.0), min_size=1, max_size=5), on_grid(0.0, 60.0))
def test_the_curves_from_then_on_are_the_same(steps: list[float], since: float) -> None:
    """Bit by bit, however often it was cut."""
    score, time = roomy(compiled()), 0.0
    move = Parameter(
        id="move", body="body", onset=0.3, duration=0.2, name="loudness", value=50.0, glide=0.2, heard=Heard(speech=0.5)
    )
    score = dataclasses.replace(score, events=(*score.events, move))
    for number, step in enumerate(steps):
        time = snap(time + step)
        score = restarted(score, roomy(compiled(number % 2)), time)
    times = np.arange(since, since + 30.0, 0.05)
    few = recent(score, since)
    assert np.array_equal(everything(curves(score), times), everything(curves(few), times))
    assert len(few.events) <= len(score.events)


def test_a_breath_that_was_cut_long_ago_and_is_held_still_stays() -> None:
    """With the cut that left it so."""
    score = roomy(compiled())
    time = snap(next(score.of(Utterance)).onset + 0.5)
    cut = Cut(
        id="c", body="body", onset=time, duration=0.1, fade=0.1, targets=tuple(event.id for event in score.events)
    )
    held = dataclasses.replace(score, events=(*score.events, cut))
    late = np.array([200.0, 300.0])
    volume = curves(held).sample(late, ["lung_volume"])
    assert volume[0, 0] != pytest.approx(0.38, abs=1e-3)
    assert np.array_equal(volume, curves(recent(held, 200.0)).sample(late, ["lung_volume"]))


def test_what_is_kept_is_longer_than_any_movement_takes() -> None:
    """And the past of a long Score is gone."""
    assert max(movement.reach for movement in MOVEMENTS.values()) < KEPT
    assert len(recent(roomy(compiled()), 300.0).events) <= 2
