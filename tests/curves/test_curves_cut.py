"""Laws of curves that are cut: nothing before a cut changes, nothing behind it jumps."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import cache
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.channels import CHANNELS
from scorebreath.curves.curve_set import curves
from scorebreath.curves.settling import MOVEMENTS, found, settled
from scorebreath.errors import ScoreError
from scorebreath.score.document import Score
from scorebreath.score.events import EVENTS, Cut, Event, Hold, Utterance
from scorebreath.units import snap
from tests.curves.cutting import PLAIN, compiled, cut_at, everything, followed, restarted, unended
from tests.curves.faces import whole_face
from tests.curves.scores import REST, Breath, build, on_grid
from tests.curves.test_curve_laws import CONTINUOUS

COUNTED = settings(max_examples=15, deadline=None)
MOVING = tuple(name for name in CONTINUOUS if name != "weight")
LIMITED = {channel.name: channel.speed for channel in CHANNELS if channel.speed is not None}


def roomy(score: Score, duration: float = 400.0) -> Score:
    """The Score with room behind it: what hosts are told of its end is no affair of cuts."""
    return dataclasses.replace(score, duration=duration, text=score.text.ljust(2000))


@cache
def piece(name: str) -> Score:
    """A Score by a name that a failing example can print."""
    known: dict[str, Callable[[], Score]] = {
        "one": compiled,
        "two": lambda: compiled(1),
        "face": whole_face,
        "wide": lambda: build([Breath(lead_mouth=0.4, lead_nostril=0.3), Breath(before=0.0, after=0.0, share=0.2)]),
    }
    return roomy(known[name]())


NAMES = st.sampled_from(["one", "two", "face", "wide"])
CUTS = st.lists(st.tuples(on_grid(0.0, 12.0), on_grid(0.0, 0.3), on_grid(0.2, 2.0), NAMES), min_size=1, max_size=4)


def moments(*points: float) -> np.ndarray:
    """Frames from before the beginning, and what lies close before and behind some times."""
    near = np.array([p + d for p in points for d in (-0.5, -0.1, -0.03, -1e-3, -2e-6, -1e-7, 1e-7, 0.01, 0.06, 0.3)])
    return np.sort(np.concatenate([np.arange(-1.0, 20.0, 0.0373), near]))


@COUNTED
@given(NAMES, CUTS)
def test_a_performance_that_is_cut_again_and_again_keeps_its_past(
    first: str, cuts: list[tuple[float, float, float, str]]
) -> None:
    """Cuts come one after the other, each followed by something else; and earlier than one that was told already."""
    score = piece(first)
    seen: list[float] = []
    for time, fade, back, other in cuts:
        if not unended(score, time):
            continue  # then there is nothing to cut, and what follows is seen coming
        grown = restarted(score, piece(other), time, fade=fade, back=back)
        times = moments(time, *seen)
        before = times < time
        was, is_ = curves(score), curves(grown)
        assert np.array_equal(everything(was, times[before]), everything(is_, times[before]))
        score, seen = grown, [*seen, time]


@COUNTED
@given(NAMES, CUTS, st.randoms(use_true_random=False))
def test_every_prefix_has_the_final_curves_up_to_its_horizon(
    first: str, cuts: list[tuple[float, float, float, str]], random: Random
) -> None:
    """Whatever is appended changes nothing before the earliest moment that it may change."""
    score = piece(first)
    for time, fade, back, other in sorted(cuts, key=lambda cut: cut[0]):
        score = restarted(score, piece(other), time, fade=fade, back=back)
    final = curves(score)
    ends = {0, len(score.events), *random.sample(range(len(score.events)), min(6, len(score.events)))}
    for count in sorted(ends):
        coming = score.events[count:]
        reached = [e.onset if isinstance(e, Cut) else e.onset - EVENTS[e.type][1].lead for e in coming]
        horizon = min(reached, default=60.0)
        times = np.arange(-1.0, horizon, 0.0373)
        prefix = dataclasses.replace(score, events=score.events[:count])
        assert np.array_equal(everything(curves(prefix), times), everything(final, times))


@COUNTED
@given(NAMES, on_grid(0.05, 12.0), on_grid(0.0, 0.3), NAMES)
def test_nothing_that_moves_jumps_at_a_cut(whose: str, time: float, fade: float, other: str) -> None:
    """Lungs, chest, lips, eyes: what is continuous shrinks with the step."""
    found = curves(restarted(piece(whose), piece(other), time, fade=fade))
    lips = [name for name in LIMITED if name not in MOVING]
    for h in (1e-6, 1e-7):
        values = found.sample([time - h, time + h], [*MOVING, *lips])
        assert np.all(np.abs(values[1] - values[0]) < 2e4 * h + 1e-6)  # a volume is on the grid
    shares = found.visemes([time - 1e-7, time + 1e-7])
    assert np.allclose(shares[0], shares[1], atol=1e-3)
    assert np.allclose(found.visemes(moments(time)).sum(axis=1), 1.0)
    around = found.contact([time - 1e-7, time + 1e-7])
    assert abs(around[1] - around[0]) < 1e-3


@COUNTED
@given(
    st.sampled_from(["one", "two"]),
    st.lists(on_grid(0.5, 14.0), min_size=1, max_size=3),
    on_grid(0.0, 0.2),
)
def test_no_channel_is_faster_across_a_cut_than_its_speed(whose: str, times: list[float], fade: float) -> None:
    """Of real speech and a real face, cut again and again and begun anew."""
    score = piece(whose)
    for time in sorted(times):
        score = restarted(score, piece("one"), time, fade=fade, back=0.3)
    found, names = curves(score), list(LIMITED)
    step = 1e-4
    for time in times:
        at = np.arange(time - 0.05, time + 1.2, step)
        speeds = np.abs(np.diff(found.sample(at, names), axis=0)).max(axis=0) / step
        for name, speed in zip(names, speeds, strict=True):
            assert speed <= LIMITED[name] * 1.01, name


@COUNTED
@given(NAMES, on_grid(0.3, 12.0), on_grid(0.0, 0.3))
def test_a_cut_closes_the_mouth_and_is_silent(whose: str, time: float, fade: float) -> None:
    """Within its fade and 0.3 s; the sound within the fade; and the face comes to rest."""
    found = curves(cut_at(piece(whose), time, fade=fade))
    late = np.arange(time + fade + 0.3, time + 6.0, 0.01)
    lips = ("jaw_open", "lip_close", "lip_round", "lip_spread", "lip_tuck", "tongue_tip", "tongue_back", "mouth_open")
    assert np.all(found.sample(late, lips) < 0.02)
    silent = np.arange(time + fade + 1e-5, time + 6.0, 0.01)
    assert np.all(found.sample(silent, ["speech_level", "breath_level"]) == -80.0)
    rest = found.sample([time + 2.0], [name for name in MOVING if not name.startswith("lung")])[0]
    assert np.all(np.abs(rest) < 1e-9)


@COUNTED
@given(NAMES, on_grid(0.3, 12.0), on_grid(0.01, 0.3))
def test_the_sound_fades_as_the_cut_says(whose: str, time: float, fade: float) -> None:
    """Up to the cut it is what it was; half way through the fade its amplitude is a half of what it would have been."""
    whole, found = curves(piece(whose)), curves(cut_at(piece(whose), time, fade=fade))
    half = time + fade / 2
    for name in ("speech_level", "breath_level"):
        was, now = whole.sample([half], [name])[0, 0], found.sample([half], [name])[0, 0]
        began = whole.sample([time], [name])[0, 0]  # what begins behind the cut never happens
        if was > -70 and began > -70:
            assert now == pytest.approx(was - 6.02, abs=0.01)


@COUNTED
@given(NAMES, st.lists(on_grid(0.0, 12.0), min_size=1, max_size=3))
def test_a_cut_that_ends_nothing_changes_nothing(whose: str, times: list[float]) -> None:
    """Of what had ended, of nothing, or of what another cut ended before."""
    cut = cut_at(piece(whose), snap(min(times)))
    first = next(cut.of(Cut))
    more: list[Event] = [
        dataclasses.replace(first, id=f"late{n}", onset=snap(max(time, first.onset))) for n, time in enumerate(times)
    ]
    more += [dataclasses.replace(first, id=f"empty{n}", onset=time, targets=()) for n, time in enumerate(times)]
    again = dataclasses.replace(cut, events=(*cut.events, *more))
    at = moments(*times)
    assert np.array_equal(everything(curves(cut), at), everything(curves(again), at))


@COUNTED
@given(NAMES, st.lists(on_grid(0.0, 12.0), min_size=1, max_size=3), st.randoms(use_true_random=False))
def test_a_sample_behind_cuts_depends_on_its_own_time_alone(whose: str, cuts: list[float], random: Random) -> None:
    """Any order, any window, any channel alone; a set that has been sampled elsewhere before, or not."""
    score = piece(whose)
    for time in sorted(cuts):
        score = cut_at(score, time)
    set_, times = curves(score), moments(*cuts)
    whole = everything(set_, times)
    chosen = np.array(random.sample(range(len(times)), 40))
    assert np.array_equal(everything(curves(score, since=1e9), times[chosen]), whole[chosen])
    for number in chosen[:5]:
        assert np.array_equal(everything(curves(score), times[number : number + 1]), whole[number : number + 1])
    name = random.choice(set_.channels)
    assert np.array_equal(curves(score).sample(times, [name])[:, 0], whole[:, set_.channels.index(name)])


def test_a_breath_that_nothing_follows_is_held_where_it_was_cut() -> None:
    """Until the next one begins, however many cuts come between."""
    score = piece("one")
    said = next(score.of(Utterance))
    time = snap(said.onset + 0.5)
    cut = cut_at(score, time)
    bare = dataclasses.replace(cut, events=tuple(e for e in cut.events if not e.id.startswith("cut0.")))
    twice = dataclasses.replace(
        bare, events=(*bare.events, Cut(
            id="more", body="body", onset=snap(time + 1.0), duration=0.1, fade=0.1, targets=(score.events[-1].id,)
        ))
    )  # fmt: skip
    for held in (bare, twice):
        volume = curves(held).sample(np.arange(time - 0.001, time + 20.0, 0.05), ["lung_volume", "airflow"])
        assert volume[:, 0] == pytest.approx(volume[0, 0], abs=1e-3)
        assert np.all(volume[1:, 1] == 0.0)
    later = followed(bare, compiled(), snap(time + 3.0))
    steps = np.diff(curves(later).sample(np.arange(time, time + 2.99, 0.05), ["lung_volume"])[:, 0])
    assert np.all(steps == 0.0)


def test_events_that_a_cut_leaves_go_on() -> None:
    """Only the targets end: the head's nod alone, and the speech is untouched."""
    score = roomy(whole_face())
    nod = next(e for e in score.events if e.type == "head")
    time = snap(nod.onset + 0.35)
    one = Cut(id="c", body="body", onset=time, duration=0.05, fade=0.05, targets=(nod.id,))
    cut = dataclasses.replace(score, events=(*score.events, one))
    times = moments(time)
    was, now = curves(score), curves(cut)
    same = [name for name in was.channels if not name.startswith(("head", "eye", "lid"))]
    assert np.array_equal(was.sample(times, same), now.sample(times, same))
    behind = np.arange(time + 0.001, nod.end, 0.01)
    assert not np.allclose(was.sample(behind, ["head_yaw"]), now.sample(behind, ["head_yaw"]))
    looked = now.sample(times, ["eye_yaw", "head_yaw"]) - was.sample(times, ["eye_yaw", "head_yaw"])
    assert np.allclose(looked.sum(axis=1), 0.0)  # the eyes make up for what the head does


def test_breaths_that_overlap_in_one_epoch_are_refused() -> None:
    """What takes the place of a cut breath may begin with the cut; two that are not cut may not."""
    score = piece("one")
    said = next(score.of(Utterance))
    cut = cut_at(score, snap(said.onset + 0.5))
    curves(cut)
    more = Hold(
        id="x", body="body", onset=snap(said.onset + 0.6), duration=3.0, volume=REST, thorax_share=0.5, motion=PLAIN
    )
    with pytest.raises(ScoreError, match="overlap"):
        curves(dataclasses.replace(cut, events=(*cut.events, more)))


@pytest.mark.parametrize("name", sorted(MOVEMENTS))
def test_every_movement_settles_within_its_reach_and_its_speed(name: str) -> None:
    """From anywhere to rest, without a jerk: the tables say when nothing is left, and how fast at most."""
    movement = MOVEMENTS[name]
    columns = max(1, len(movement.speed))
    span = 90.0 if name in ("head", "gaze") else 1.0
    for old in (span, span / 10, span / 1000):
        start = np.full((1, columns), old)
        times = np.linspace(5.0, 5.0 + movement.reach + 0.1, 4001)
        at = found(5.0, start, np.zeros((1, columns)))
        moved = settled(movement, at, times, np.zeros((len(times), columns)))
        assert np.allclose(moved[0], old)
        assert np.all(np.diff(moved, axis=0) <= 1e-12)
        assert np.all(moved[times - 5.0 >= movement.reach] == 0.0)
        assert np.all(np.abs(moved[-80:]) < 1e-9)
        if movement.speed:
            speed = np.abs(np.diff(moved, axis=0)).max(axis=0) / (times[1] - times[0])
            assert np.all(speed <= 1.001 * np.array(movement.speed))


def test_a_movement_that_a_cut_left_alone_is_left_alone() -> None:
    """Bit by bit."""
    values = np.sin(np.arange(300.0)).reshape(100, 3)
    at = found(0.0, values[:1], values[:1])
    assert settled(MOVEMENTS["head"], at, np.linspace(0, 1, 100), values) is values
