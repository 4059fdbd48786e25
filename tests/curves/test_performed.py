"""A Score with its cuts carried out: as long as it lasted, and still a Score."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings

from scorebreath.curves.curve_set import curves
from scorebreath.curves.performed import performed
from scorebreath.score.codec import dumps, loads
from scorebreath.score.cutting import end_of, endings
from scorebreath.score.document import Score
from scorebreath.score.events import Cut, Utterance
from scorebreath.units import snap
from tests.curves.acts import performances
from tests.curves.cutting import compiled, cut_at, restarted
from tests.curves.scores import on_grid


def test_a_score_without_cuts_is_itself() -> None:
    """Not a copy."""
    score = compiled()
    assert performed(score) is score


@settings(max_examples=40, deadline=None)
@given(performances(), on_grid(0.0, 6.0))
def test_every_kind_of_breath_and_face_is_shortened_where_it_is_cut(score: Score, time: float) -> None:
    """The volumes are those of the curves until then; what never happened is gone; events say when they end."""
    cut = cut_at(dataclasses.replace(score, duration=60.0), time)
    done, ends = performed(cut), endings(cut.events)
    assert loads(dumps(done), "it") == done
    left = {event.id: event for event in done.events}
    for event in cut.events:
        if isinstance(event, Cut) or (event.id in ends and ends[event.id].prevents(event)):
            assert event.id not in left
        else:
            assert snap(left[event.id].end) == pytest.approx(end_of(event, ends), abs=2e-6)
    curves(done).sample([time])  # faces and noises fit
    last = [e for e in done.events if e.type in ("inspiration", "expiration") and abs(e.end - time) < 1e-6]
    volume = curves(cut).sample([time], ["lung_volume"])[0, 0]
    for breath in last:
        if getattr(breath, "saccades", 1) == 1:
            assert getattr(breath, "to_volume") == pytest.approx(volume, abs=3e-6)  # noqa: B009


def test_what_was_said_was_said_until_the_cut() -> None:
    """No word and no phone after it."""
    said = next(compiled().of(Utterance))
    time = snap(said.onset + 1.0)
    done = performed(restarted(compiled(), compiled(1), time))
    for one in done.of(Utterance):
        assert all(word.onset + word.duration <= one.duration + 1e-6 for word in one.words)
        assert all(phone.onset + phone.duration <= one.duration + 1e-6 for phone in one.phones)
    first = next(done.of(Utterance))
    assert (first.id, snap(first.end)) == (said.id, time)
    assert 0 < len(first.words) < len(said.words)
    assert not list(done.of(Cut))
    assert np.isfinite(curves(done).sample(np.arange(0, 30, 0.1))).all()
