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
from scorebreath.curves.strokes import peak_flow
from scorebreath.score.acting import EMOTIONS
from scorebreath.score.breathing import PUFF_SHARE
from scorebreath.score.document import Score
from scorebreath.score.events import EVENTS, Event, Expiration, Hold, Inspiration
from scorebreath.units import snap
from tests.curves.acts import performances
from tests.curves.faces import FACE, whole_face
from tests.curves.scores import Breath, breaths, build, scores, shifted, without

CONTINUOUS = (
    "lung_volume", "thorax_volume", "abdomen_volume", "thorax", "abdomen", "shoulder", "nostril_flare", "mouth_open",
    "neck_pitch", "head_pitch", "head_yaw", "head_roll", "eye_pitch", "eye_yaw", "lid_left", "lid_right", "brow_left",
    "brow_right", "brow_frown", "wrinkle_forehead", "wrinkle_glabella", "weight",
    *(f"emotion_{name}" for name in EMOTIONS),
)  # fmt: skip
"""Everything that moves; levels and airflow begin and end with sounds and breaths."""
COUNTED = settings(max_examples=40, deadline=None)
ANY = scores() | performances()
TREMOR_PERIODS = 400_000
"""Microseconds in which a trembling chest is where it was: three times 1 / 7.5 Hz."""


def frames(score: Score, rate: float = 97.0) -> np.ndarray:
    return np.arange(-1.0, score.duration + 1.0, 1 / rate)


def borders(score: Score) -> np.ndarray:
    """Where flow may jump: the edges of events, gasps and puffs."""
    found: list[float] = []
    for event in score.events:
        found += [event.onset, event.end]
        if isinstance(event, Inspiration):
            found += [event.onset + event.duration * k / event.saccades for k in range(event.saccades)]
        if isinstance(event, Expiration):
            for puff, following in zip(event.puffs, (*event.puffs[1:], event.duration), strict=False):
                found += [event.onset + puff, event.onset + puff + PUFF_SHARE * (following - puff)]
    return np.array(found)


@COUNTED
@given(ANY, st.randoms(use_true_random=False))
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
@given(ANY)
def test_one_channel_alone_is_the_column_of_all(score: Score) -> None:
    set_, times = curves(score), frames(score, 31.0)
    whole = set_.sample(times)
    for column, name in enumerate(set_.channels):
        assert np.array_equal(set_.sample(times, [name])[:, 0], whole[:, column]), name


@COUNTED
@given(ANY, st.data())
def test_an_event_changes_nothing_beyond_its_reach(score: Score, data: st.DataObject) -> None:
    event: Event = data.draw(st.sampled_from(score.events))
    reach = EVENTS[event.type][1]
    times = frames(score, 199.0)
    far = (times < event.onset - reach.lead - 3e-6) | (times > event.end + reach.lag + 3e-6)
    before, after = curves(score).sample(times), curves(without(score, event.id)).sample(times)
    assert np.array_equal(before[far], after[far])
    assert not np.array_equal(before[~far], after[~far]) or event.type in ("hold", *FACE)  # another may hide it


@COUNTED
@given(
    st.tuples(scores(), st.integers(0, 5_000_000))
    | st.tuples(performances(), st.integers(0, 12).map(lambda n: n * TREMOR_PERIODS))
)
def test_later_events_give_later_curves(moving: tuple[Score, int]) -> None:
    score, shift = moving[0], moving[1] / 1e6
    moved = dataclasses.replace(shifted(score, shift), duration=score.duration)
    names = [name for name in curves(score).channels if name != "weight"]  # weight belongs to the Score, not to events
    times = frames(score)
    clear = np.min(np.abs(times[:, None] - borders(score)[None, :]), axis=1) > 1e-5
    here = curves(score).sample(times[clear], names)
    there = curves(moved).sample(times[clear] + shift, names)
    np.testing.assert_allclose(there, here, atol=1e-9, rtol=0)


@COUNTED
@given(ANY)
def test_chest_and_belly_share_the_volume(score: Score) -> None:
    volume, chest, belly = curves(score).sample(frames(score), ["lung_volume", "thorax_volume", "abdomen_volume"]).T
    np.testing.assert_allclose(chest + belly, volume - score.bodies[0].person.resting_volume, atol=1e-12)


@COUNTED
@given(ANY)
def test_airflow_is_the_derivative_of_the_volume_in_litres(score: Score) -> None:
    set_, h = curves(score), 1e-5
    times = frames(score)
    smooth = times[np.min(np.abs(times[:, None] - borders(score)[None, :]), axis=1) > 2 * h]
    slope = (set_.sample(smooth + h, ["lung_volume"]) - set_.sample(smooth - h, ["lung_volume"])) / (2 * h)
    flow = set_.sample(smooth, ["airflow"])
    np.testing.assert_allclose(slope * score.bodies[0].person.vital_capacity, flow, atol=1e-4)


@COUNTED
@given(scores(lead_mouth=0.0) | performances())
def test_everything_that_moves_moves_without_steps(score: Score) -> None:
    set_ = curves(score)
    edges = [*borders(score).tolist(), *(e.onset - lead for e in score.events for lead in (0.5, 0.25))]
    for h in (1e-6, 1e-7):  # half a step of the grid, and less: what is continuous shrinks with it
        around = np.concatenate([np.array(edges) - h, np.array(edges) + h])
        values = set_.sample(around, CONTINUOUS)
        jump = np.abs(values[len(edges) :] - values[: len(edges)])
        assert np.all(jump < 2e4 * h), CONTINUOUS[int(np.argmax(jump.max(axis=0)))]


@COUNTED
@given(ANY)
def test_values_stay_within_the_table(score: Score) -> None:
    set_ = curves(score)
    values = set_.sample(frames(score))
    assert np.all(np.isfinite(values))
    for column, channel in enumerate(set_.table):
        if channel.clamped:
            assert values[:, column].min() >= channel.low, channel.name
            assert values[:, column].max() <= channel.high, channel.name


@COUNTED
@given(ANY)
def test_air_never_moves_faster_than_its_profile_and_half_a_frame_is_half_a_step(score: Score) -> None:
    """Physiology 10; frames so short that a stroke has many."""
    person, h = score.bodies[0].person, 1 / 8000
    fastest = max(abs(peak_flow(e, person)) for e in score.events if isinstance(e, Inspiration | Expiration | Hold))
    volume = curves(score).sample(np.arange(0, score.duration, h / 2), ["lung_volume"])[:, 0] * person.vital_capacity
    whole, half = (float(np.max(np.abs(np.diff(volume[::step])))) for step in (2, 1))
    assert whole <= fastest * h * (1 + 1e-9)
    assert half <= fastest * h / 2 * (1 + 1e-9)
    assert 0.499 * whole <= half <= 0.53 * whole


@COUNTED
@given(ANY)
def test_the_highest_flow_is_that_of_the_steepest_event(score: Score) -> None:
    person, set_ = score.bodies[0].person, curves(score)
    for event in score.events:
        if isinstance(event, Inspiration | Expiration):
            times = np.linspace(event.onset, event.end, 4001)[:-1]
            flow = set_.sample(times, ["airflow"])[:, 0]
            highest = peak_flow(event, person)
            assert np.all(flow * np.sign(highest) >= 0), event
            assert float(np.max(np.abs(flow))) == pytest.approx(abs(highest), rel=0.02), event
            assert np.max(np.abs(flow)) <= abs(highest) * (1 + 1e-9)


@COUNTED
@given(performances(), st.floats(0.01, 0.3))
def test_tremor_moves_the_shape_of_the_chest_alone(score: Score, tremor: float) -> None:
    def trembling(by: float) -> np.ndarray:
        events = tuple(
            dataclasses.replace(e, motion=dataclasses.replace(e.motion, tremor=snap(by)))
            if isinstance(e, Inspiration | Expiration | Hold)
            else e
            for e in score.events
        )
        return curves(dataclasses.replace(score, events=events)).sample(frames(score))

    names = [channel.name for channel in CHANNELS]
    calm, shaken = trembling(0.0), trembling(tremor)
    column = names.index("thorax")
    unclipped = np.abs(calm[:, column]) < 0.7
    expected = calm[:, column] * (1 + snap(tremor) * np.sin(2 * np.pi * 7.5 * frames(score)))
    np.testing.assert_allclose(shaken[unclipped, column], expected[unclipped], atol=1e-12)
    assert np.array_equal(np.delete(calm, column, axis=1), np.delete(shaken, column, axis=1))


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
    score = whole_face()
    set_: CurveSet = curves(score)
    values = set_.sample(np.arange(0, score.duration, 0.01), [name])
    assert np.ptp(values) > 1e-3
