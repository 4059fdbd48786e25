"""Laws every curve obeys, whatever the Score (design: Curves, Finite reach)."""

from __future__ import annotations

import dataclasses
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.channels import CHANNELS
from scorebreath.curves.curve_set import CurveSet, curves
from scorebreath.score.document import Score
from scorebreath.score.events import EVENTS, Event
from tests.curves.scores import Breath, breaths, build, scores, shifted, without

CONTINUOUS = (
    "lung_volume", "thorax_volume", "abdomen_volume", "thorax", "abdomen", "shoulder", "nostril_flare", "mouth_open",
    "neck_pitch", "head_pitch", "weight",
)  # fmt: skip
"""Everything that moves; levels and airflow begin and end with sounds and breaths."""
COUNTED = settings(max_examples=40, deadline=None)


def frames(score: Score, rate: float = 97.0) -> np.ndarray:
    return np.arange(-1.0, score.duration + 1.0, 1 / rate)


@COUNTED
@given(scores(), st.randoms(use_true_random=False))
def test_a_sample_depends_on_its_own_time_alone(score: Score, random: Random) -> None:
    set_, times = curves(score), frames(score)
    whole = set_.sample(times)
    chosen = np.array(sorted(random.sample(range(len(times)), 50)))
    assert np.array_equal(set_.sample(times[chosen]), whole[chosen])
    assert np.array_equal(set_.sample(times[chosen[::-1]]), whole[chosen[::-1]])
    one = int(chosen[7])
    assert np.array_equal(set_.sample(times[one]), whole[one : one + 1])
    window = slice(one, one + 33)
    assert np.array_equal(set_.sample(times[window]), whole[window])


@COUNTED
@given(scores())
def test_one_channel_alone_is_the_column_of_all(score: Score) -> None:
    set_, times = curves(score), frames(score, 31.0)
    whole = set_.sample(times)
    for column, name in enumerate(set_.channels):
        assert np.array_equal(set_.sample(times, [name])[:, 0], whole[:, column]), name


@COUNTED
@given(scores(), st.data())
def test_an_event_changes_nothing_beyond_its_reach(score: Score, data: st.DataObject) -> None:
    event: Event = data.draw(st.sampled_from(score.events))
    reach = EVENTS[event.type][1]
    times = frames(score, 199.0)
    far = (times < event.onset - reach.lead - 3e-6) | (times > event.end + reach.lag + 3e-6)
    before, after = curves(score).sample(times), curves(without(score, event.id)).sample(times)
    assert np.array_equal(before[far], after[far])
    assert not np.array_equal(before[~far], after[~far]) or event.type == "hold"


@COUNTED
@given(scores(), st.integers(0, 5_000_000))
def test_later_events_give_later_curves(score: Score, micros: int) -> None:
    shift = micros / 1e6
    moved = dataclasses.replace(shifted(score, shift), duration=score.duration)
    names = [name for name in curves(score).channels if name != "weight"]  # weight belongs to the Score, not to events
    borders = np.array([edge for event in score.events for edge in (event.onset, event.end)])
    times = frames(score)
    clear = np.min(np.abs(times[:, None] - borders[None, :]), axis=1) > 1e-5
    here = curves(score).sample(times[clear], names)
    there = curves(moved).sample(times[clear] + shift, names)
    np.testing.assert_allclose(there, here, atol=1e-9, rtol=0)


@COUNTED
@given(scores())
def test_chest_and_belly_share_the_volume(score: Score) -> None:
    volume, chest, belly = curves(score).sample(frames(score), ["lung_volume", "thorax_volume", "abdomen_volume"]).T
    np.testing.assert_allclose(chest + belly, volume - score.bodies[0].person.resting_volume, atol=1e-12)


@COUNTED
@given(scores())
def test_airflow_is_the_derivative_of_the_volume_in_litres(score: Score) -> None:
    set_, h = curves(score), 1e-5
    borders = np.array([edge for event in score.events for edge in (event.onset, event.end)])
    times = frames(score)
    smooth = times[np.min(np.abs(times[:, None] - borders[None, :]), axis=1) > 2 * h]
    slope = (set_.sample(smooth + h, ["lung_volume"]) - set_.sample(smooth - h, ["lung_volume"])) / (2 * h)
    flow = set_.sample(smooth, ["airflow"])
    np.testing.assert_allclose(slope * score.bodies[0].person.vital_capacity, flow, atol=1e-4)


@COUNTED
@given(scores(lead_mouth=0.0))
def test_everything_that_moves_moves_without_steps(score: Score) -> None:
    set_ = curves(score)
    edges = [edge for e in score.events for edge in (e.onset, e.end, e.onset - 0.5, e.onset - 0.25)]
    for h in (1e-6, 1e-7):  # half a step of the grid, and less: what is continuous shrinks with it
        around = np.concatenate([np.array(edges) - h, np.array(edges) + h])
        values = set_.sample(around, CONTINUOUS)
        jump = np.abs(values[len(edges) :] - values[: len(edges)])
        assert np.all(jump < 2e4 * h), CONTINUOUS[int(np.argmax(jump.max(axis=0)))]


@COUNTED
@given(scores())
def test_values_stay_within_the_table(score: Score) -> None:
    set_ = curves(score)
    values = set_.sample(frames(score))
    assert np.all(np.isfinite(values))
    for column, channel in enumerate(set_.table):
        if channel.clamped:
            assert values[:, column].min() >= channel.low, channel.name
            assert values[:, column].max() <= channel.high, channel.name


@COUNTED
@given(scores(lead_mouth=0.0, lead_nostril=0.0))
def test_mouth_and_nostrils_are_shut_outside_inspirations(score: Score) -> None:
    times = frames(score, 499.0)
    inside = np.zeros(len(times), dtype=bool)
    for event in score.events:
        if event.type == "inspiration":
            inside |= (times >= event.onset) & (times <= event.end)
    face = curves(score).sample(times, ["mouth_open", "nostril_flare"])
    assert np.all(face[~inside] == 0.0)


@COUNTED
@given(breaths(mouth=1.0, lead_mouth=0.5, before=1.0))
def test_a_lead_opens_the_mouth_earlier_and_closes_it_no_later(breath: Breath) -> None:
    score = build([breath])
    set_ = curves(score)
    early = set_.sample([1.0 - 0.5 - 1e-4, 1.0 - 0.25, 1.0], ["mouth_open"])[:, 0]
    assert early[0] == 0.0 < early[1] < early[2]
    plain = curves(build([dataclasses.replace(breath, lead_mouth=0.0)]))
    late = 1.0 + breath.inspiration * np.array([0.3, 0.5, 0.9, 1.0])
    np.testing.assert_allclose(set_.sample(late, ["mouth_open"]), plain.sample(late, ["mouth_open"]), atol=1e-9)


def test_the_table_is_whole() -> None:
    assert len({channel.name for channel in CHANNELS}) == len(CHANNELS)
    for channel in CHANNELS:
        assert channel.name.isidentifier(), channel.name
        assert channel.low < channel.high, channel.name
        assert channel.unit in ("", "L/s", "deg", "dB"), channel.name
        assert channel.meaning and channel.meaning[0].islower() | channel.meaning[0].isdigit(), channel.name


@pytest.mark.parametrize("name", [channel.name for channel in CHANNELS])
def test_every_channel_moves(name: str) -> None:
    score = build([Breath()] * 2)
    set_: CurveSet = curves(score)
    values = set_.sample(np.arange(0, score.duration, 0.01), [name])
    assert np.ptp(values) > 1e-3
