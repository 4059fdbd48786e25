"""Lids, eyes, brows, head and emotions: what the events of a face come to."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.channels import CHANNELS
from scorebreath.curves.curve_set import curves
from scorebreath.curves.looks.layers import layers
from scorebreath.curves.looks.mixing import EMOTION_BROW, EMOTION_HEAD
from scorebreath.equations.shapes import FASTEST
from scorebreath.errors import ScoreError
from scorebreath.score.acting import EMOTIONS
from scorebreath.score.document import Score
from scorebreath.score.events import Event, Head
from scorebreath.units import snap
from tests.curves.acts import breathe_in
from tests.curves.faces import FACE, blink, brow, emotion, face_events, gaze, head
from tests.curves.scores import on_grid, score_of, value, without

COUNTED = settings(max_examples=40, deadline=None)
NAMES = (
    "head_pitch", "head_yaw", "head_roll", "eye_pitch", "eye_yaw", "lid_left", "lid_right", "brow_left", "brow_right",
    "brow_frown", "wrinkle_forehead", "wrinkle_glabella", *(f"emotion_{name}" for name in EMOTIONS),
)  # fmt: skip


def only(*events: Event) -> Score:
    return score_of(events, duration=10.0)


def test_a_blink_closes_stays_and_opens() -> None:
    score = only(blink(1.0))
    got = value(score, "lid_left", 0.999, 1.0, 1.0375, 1.075, 1.085, 1.165, 1.245, 1.3)
    assert got == pytest.approx([0, 0, 0.5, 1, 1, 0.5, 0, 0])
    assert value(score, "lid_right", 1.0375) == pytest.approx([0.5])


def test_a_wink_closes_one_eye_and_a_partial_blink_not_the_whole_way() -> None:
    score = only(blink(1.0, left=0.0, right=0.8))
    assert value(score, "lid_left", 1.08) == [0.0]
    assert value(score, "lid_right", 1.08) == pytest.approx([0.8])


def test_of_two_blinks_the_further_counts_on_each_side() -> None:
    score = only(blink(1.0, left=1.0, right=0.3, id="a"), blink(1.0, left=0.2, right=0.7, id="b"))
    assert value(score, "lid_left", 1.08) == pytest.approx([1.0])
    assert value(score, "lid_right", 1.08) == pytest.approx([0.7])


def test_of_two_brows_the_higher_counts_in_each_column() -> None:
    score = only(brow(1.0, left=0.6, right=0.1, id="a"), brow(1.0, left=0.2, right=0.4, frown=0.5, id="b"))
    at = 1.2
    assert [value(score, f"brow_{name}", at)[0] for name in ("left", "right", "frown")] == pytest.approx(
        [0.6, 0.4, 0.5]
    )
    assert value(score, "wrinkle_forehead", at) == pytest.approx([0.6])  # A50
    assert value(score, "wrinkle_glabella", at) == pytest.approx([0.5])


def test_heads_add() -> None:
    score = only(head(1.0, pitch=3.0, roll=1.5, id="a"), head(1.2, pitch=2.0, yaw=-4.0, id="b"))
    assert value(score, "head_pitch", 1.4, 1.9) == pytest.approx([3.0 + 2.0 * smooth(2 / 3), 2.0 * smooth(1.0 / 3)])
    assert value(score, "head_yaw", 1.6) == pytest.approx([-4.0])
    assert value(score, "head_roll", 1.4) == pytest.approx([1.5])


def smooth(x: float) -> float:
    return x**3 * (10 + x * (6 * x - 15))


def test_the_head_holds_the_breath_and_the_emotion() -> None:
    breath = breathe_in(onset=0.0, duration=2.0)
    alone = value(score_of([breath], duration=5.0), "head_pitch", 1.0)[0]
    assert alone == value(score_of([breath], duration=5.0), "neck_pitch", 1.0)[0] > 0.1
    together = score_of([breath, head(0.6), emotion("sad", 0.0)], duration=5.0)
    assert value(together, "head_pitch", 1.0) == pytest.approx([alone + 3.0 + EMOTION_HEAD["sad"][0]])


def test_the_eyes_go_from_target_to_target_and_look_ahead_outside() -> None:
    score = only(
        gaze(1.0, yaw=10.0, pitch=-4.0, move=0.1), gaze(2.0, yaw=0.0, from_yaw=10.0, from_pitch=-4.0, move=0.1)
    )
    assert value(score, "eye_yaw", 0.9, 1.0, 1.05, 1.1, 2.0, 2.05, 2.1, 3.5) == pytest.approx(
        [0, 0, 5, 10, 10, 5, 0, 0]
    )
    assert value(score, "eye_pitch", 1.5) == pytest.approx([-4.0])


def test_the_eyes_make_up_for_the_head() -> None:
    """Looking at the listener while the head turns: eye + head stays at the target."""
    score = only(gaze(1.0, duration=3.0, yaw=0.0, target="listener"), head(1.5, pitch=5.0, yaw=12.0, id="h"))
    times = list(np.arange(1.0, 4.0, 0.01))
    for angle in ("pitch", "yaw"):
        sum_ = np.array(value(score, f"eye_{angle}", *times)) + np.array(value(score, f"head_{angle}", *times))
        np.testing.assert_allclose(sum_, 0.0, atol=1e-12)


def test_lids_follow_the_eyes() -> None:
    """A36: up opens, down closes; physiology 7.5."""
    score = only(gaze(1.0, yaw=0.0, pitch=10.0), gaze(2.0, yaw=0.0, pitch=-10.0, from_pitch=10.0))
    assert value(score, "lid_left", 1.5, 2.5) == pytest.approx([-0.12, 0.18])


def test_lids_open_wider_when_the_head_tilts_down() -> None:
    """A37: with the gaze at the listener the eye is then up in the head, and the reverse with the head up."""
    down = only(gaze(1.0, yaw=0.0, duration=2.0), head(1.0, pitch=-10.0))
    up = only(gaze(1.0, yaw=0.0, duration=2.0), head(1.0, pitch=10.0))
    assert value(down, "eye_pitch", 1.4) == pytest.approx([10.0])
    assert value(down, "lid_right", 1.4) == pytest.approx([-0.12])
    assert value(up, "lid_right", 1.4) == pytest.approx([0.18])


def test_a_blink_closes_the_rest_of_the_way() -> None:
    for pitch in (12.0, -12.0):
        score = only(gaze(1.0, yaw=0.0, pitch=pitch), blink(1.3), blink(1.6, left=0.5, id="half"))
        assert value(score, "lid_left", 1.38) == pytest.approx([1.0])
        open_ = value(score, "lid_left", 1.25)[0]
        assert value(score, "lid_left", 1.68) == pytest.approx([open_ + 0.5 * (1 - open_)])


def test_eyes_turn_no_further_than_eyes_do_and_still_look_ahead() -> None:
    score = only(gaze(1.0, yaw=80.0), head(1.0, yaw=-45.0))
    assert value(score, "eye_yaw", 1.4) == [45.0]
    ahead = only(head(1.0, yaw=-80.0))
    assert value(ahead, "head_yaw", 1.4) == [-45.0]
    assert value(ahead, "eye_yaw", 1.4) == [45.0]


def test_emotions_rise_and_fall_in_straight_lines() -> None:
    """A40, A41: full at the emoticon, linear to the borders of its phrase; climaxes at an edge are steps (Y5)."""
    score = only(emotion("happy", 1.0, apex=0.5, intensity=0.8))
    assert value(score, "emotion_happy", 1.0, 1.25, 1.5, 2.25, 3.0) == pytest.approx([0, 0.4, 0.8, 0.4, 0])
    first = only(emotion("sad", 1.0, apex=0.0))
    assert value(first, "emotion_sad", 0.999, 1.0, 2.0, 3.0) == pytest.approx([0, 1, 0.5, 0])
    last = only(emotion("sad", 1.0, apex=2.0))
    assert value(last, "emotion_sad", 1.0, 2.0, 3.0, 3.001) == pytest.approx([0, 0.5, 1, 0])


def test_equal_emotions_take_the_higher_and_different_ones_stand_beside_each_other() -> None:
    score = only(emotion("happy", 1.0, id="a"), emotion("happy", 1.5, intensity=0.9, id="b"), emotion("sad", 1.0))
    assert value(score, "emotion_happy", 2.0, 2.5) == pytest.approx([1.0, 0.9])  # Y5
    assert value(score, "emotion_sad", 2.0) == pytest.approx([1.0])


def test_an_emotion_nobody_knows_moves_nothing() -> None:
    score = only(emotion("puzzled", 1.0))
    assert np.all(curves(score).sample(np.arange(0, 5, 0.1), NAMES) == 0.0)


@pytest.mark.parametrize("name", EMOTIONS)
def test_emotions_fold_the_skin(name: str) -> None:
    """A50."""
    score, moves = only(emotion(name, 1.0)), EMOTION_BROW.get(name, {})
    assert value(score, "wrinkle_forehead", 2.0) == pytest.approx([moves.get("raise", 0.0)])
    assert value(score, "wrinkle_glabella", 2.0) == pytest.approx([moves.get("frown", 0.0)])


def test_gaze_that_overlaps_is_refused() -> None:
    with pytest.raises(
        ScoreError, match=r"gaze events of 'body' overlap: event 'one' ends at 2\.0.*'two' begins at 1\.5"
    ):
        curves(only(gaze(1.0, id="one"), gaze(1.5, id="two")))


def test_events_without_duration_and_of_others_do_nothing() -> None:
    nothing = Head(id="h", body="body", onset=1.0, duration=0.0, pitch=9.0, yaw=0.0, roll=0.0, apex=0.0)
    score = only(nothing)
    two = dataclasses.replace(score, bodies=(*score.bodies, dataclasses.replace(score.bodies[0], id="other")))
    both = dataclasses.replace(two, events=(*two.events, head(1.0, body="other")))
    assert np.all(curves(both, "body").sample([1.0, 1.4], ["head_pitch"]) == 0.0)
    assert np.all(curves(both, "other").sample([1.4], ["head_pitch"]) == 3.0)


@COUNTED
@given(face_events(5.0, most=6), st.data())
def test_the_rest_stays_exactly_as_it_was_without_an_event(events: list[Event], data: st.DataObject) -> None:
    """Reach 0, to the last bit, however many overlap."""
    if not events:
        return
    score, gone = only(*events), data.draw(st.sampled_from(events))
    times = np.arange(0, 10, 0.0101)
    far = (times < gone.onset - 3e-6) | (times > gone.end + 3e-6)
    before, after = (curves(each).sample(times, NAMES) for each in (score, without(score, gone.id)))
    assert np.array_equal(before[far], after[far])


@COUNTED
@given(face_events(5.0, most=6))
def test_the_order_of_the_events_does_not_matter(events: list[Event]) -> None:
    times = np.arange(0, 10, 0.0303)
    one, two = (curves(only(*each)).sample(times, NAMES) for each in (events, events[::-1]))
    assert np.array_equal(one, two)


@COUNTED
@given(st.lists(st.tuples(on_grid(0, 5), on_grid(0, 2)), max_size=12))
def test_layers_hold_every_event_once_in_as_few_as_there_can_be(spans: list[tuple[float, float]]) -> None:
    events = [head(onset, id=f"h{n}", duration=length, apex=0.0, hold=0.0) for n, (onset, length) in enumerate(spans)]
    found = layers(events, lambda event: (event.duration,)).layers
    lasting = sorted((e.onset, snap(e.end)) for e in events if e.duration > 0)
    assert sorted((a, b) for layer in found for a, b in zip(layer.start, layer.end, strict=True)) == lasting
    for layer in found:
        assert np.all(layer.end[:-1] <= layer.start[1:])
    at_once = max((sum(a <= onset < b for a, b in lasting) for onset, _ in lasting), default=0)
    assert len(found) == at_once


@pytest.mark.parametrize(
    ("event", "names"),
    [
        (blink(1.0), ("lid_left", "lid_right")),
        (brow(1.0, left=0.9, right=0.9, frown=0.9), ("brow_left", "brow_right", "brow_frown")),
        (head(1.0, pitch=5.0, yaw=5.0, roll=5.0), ("head_pitch", "head_yaw", "head_roll")),
        (gaze(1.0, yaw=10.0, pitch=5.0, move=snap(0.021 + 0.0022 * 10)), ("eye_yaw", "eye_pitch", "lid_left")),
    ],
)
def test_nothing_moves_faster_than_its_channel_s_limit(event: Event, names: tuple[str, ...]) -> None:
    """Usual movements, planned at the defaults; a step's highest speed is `FASTEST` times its mean."""
    step = 1e-4
    times = np.arange(0.9, 1.9, step)
    for name in names:
        moved = np.abs(np.diff(curves(only(dataclasses.replace(event))).sample(times, [name])[:, 0])) / step
        limit = next(channel.speed for channel in CHANNELS if channel.name == name)
        assert limit is not None
        assert 0 < moved.max() <= limit, name
    assert FASTEST > 1.5
    assert event.type in FACE


def test_a_sudden_emotion_turns_the_head_no_faster_than_it_goes() -> None:
    """Its face is there at once, its pose within 0.45 s; both are gone when it is."""
    quick = emotion("sad", 1.0, duration=1.5, apex=0.15)
    score = score_of([quick], duration=5.0)
    times = np.arange(0, 4, 0.001)
    pitch, felt = curves(score).sample(times, ["head_pitch", "emotion_sad"]).T
    assert np.max(np.abs(np.diff(pitch))) * 1000 <= 4.0 / 0.45 + 1e-6
    assert np.all(np.abs(pitch) <= 4.0 * felt + 1e-9) and pitch.min() < -2.8
    slow = emotion("kidding", 1.0, duration=2.0, apex=1.0)
    roll, felt = curves(score_of([slow], duration=5.0)).sample(times, ["head_roll", "emotion_kidding"]).T
    assert np.allclose(roll, 4.0 * felt)
