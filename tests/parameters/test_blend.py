"""How states come and go: ramps, moods that take each other's place, recovery, neutral."""

from __future__ import annotations

from math import exp

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import InputError
from scorebreath.parameters.states import STATES, Blend, Change

LEVELS = st.floats(0, 1)
RAMPS = st.floats(0, 20)


def set_states(*steps: tuple[float, str, float, float]) -> Blend:
    blend = Blend()
    for time, name, intensity, ramp in steps:
        blend, _ = blend.changed(time, name, intensity, ramp)
    return blend


@given(LEVELS, LEVELS, RAMPS, st.floats(-5, 60))
def test_a_change_stays_between_its_ends(start: float, target: float, ramp: float, time: float) -> None:
    change = Change(name="calm", time=10.0, start=start, target=target, ramp=ramp)
    level = change.at(time)
    assert min(start, target) - 1e-9 <= level <= max(start, target) + 1e-9
    if time < 10.0:
        assert level == start
    if time >= 10.0 + ramp + 1e-9:
        assert level == target


def test_a_ramp_is_a_straight_line() -> None:
    change = Change(name="calm", time=2.0, start=0.2, target=0.8, ramp=3.0)
    assert [round(change.at(2.0 + t), 6) for t in (0.0, 0.5, 1.5, 3.0)] == [0.2, 0.3, 0.5, 0.8]


def test_without_a_ramp_it_is_there_at_once() -> None:
    blend, _ = Blend().changed(4.0, "anxious", 0.8, 0.0)
    assert blend.at(4.0) == {"anxious": 0.8}
    assert blend.at(3.999) == {}


def test_moods_take_each_others_place_over_the_same_ramp() -> None:
    blend, began = set_states((0.0, "calm", 1.0, 0.0)).changed(10.0, "angry", 0.6, 2.0)
    assert [(c.name, c.start, c.target, c.ramp) for c in began] == [("calm", 1.0, 0.0, 2.0), ("angry", 0.0, 0.6, 2.0)]
    assert blend.at(10.5) == pytest.approx({"calm": 0.75, "angry": 0.15})
    assert blend.at(12.0) == {"angry": 0.6}


def test_a_mood_that_takes_over_in_the_midst_of_a_ramp_begins_where_the_others_are() -> None:
    blend = set_states((0.0, "calm", 1.0, 4.0), (2.0, "sad", 1.0, 4.0))
    blend, began = blend.changed(4.0, "calm", 0.5, 1.0)
    assert {c.name: c.start for c in began} == pytest.approx({"sad": 0.5, "calm": 0.25})
    assert blend.at(5.0) == {"calm": 0.5}


def test_states_of_the_body_add_up_with_moods_and_each_other() -> None:
    blend = set_states((0.0, "fatigue", 0.4, 0.0), (1.0, "exertion", 0.7, 0.0), (2.0, "happy", 1.0, 0.0))
    assert blend.at(2.0) == pytest.approx({"fatigue": 0.4, "exertion": 0.7 * exp(-1 / 45), "happy": 1.0})


def test_exertion_recovers_by_a_factor_of_e_in_its_time_constant() -> None:
    recovery = STATES["exertion"].recovery
    blend, began = Blend().changed(0.0, "exertion", 0.9, 3.0)
    assert [c.recovery for c in began] == [recovery]
    assert blend.at(3.0 + recovery)["exertion"] == pytest.approx(0.9 / exp(1))
    assert blend.at(3.0 + 3 * recovery)["exertion"] == pytest.approx(0.9 / exp(3))
    assert blend.at(3.0 + 20 * recovery) == {}


def test_exertion_that_is_held_stays() -> None:
    blend, began = Blend().changed(0.0, "exertion", 0.9, 0.0, held=True)
    assert [c.recovery for c in began] == [0.0]
    assert blend.at(3600.0) == {"exertion": 0.9}


def test_a_mood_stays_until_it_is_ended() -> None:
    assert set_states((0.0, "sad", 0.3, 1.0)).at(1e6) == {"sad": 0.3}


def test_neutral_ends_all_states() -> None:
    blend = set_states((0.0, "fatigue", 0.4, 0.0), (0.0, "exertion", 1.0, 0.0), (0.0, "happy", 1.0, 0.0))
    blend, began = blend.changed(1.0, "neutral", 1.0, 2.0)
    assert sorted((c.name, c.target, c.recovery) for c in began) == [
        ("exertion", 0.0, 0.0), ("fatigue", 0.0, 0.0), ("happy", 0.0, 0.0),
    ]  # fmt: skip
    assert blend.at(2.0)["happy"] == pytest.approx(0.5)
    assert blend.at(3.0) == {}
    assert blend.changed(4.0, "normal", 0.0, 0.0) == (Blend(), ())


def test_an_intensity_of_0_ends_one_state() -> None:
    blend = set_states((0.0, "fatigue", 0.4, 0.0), (0.0, "exertion", 1.0, 0.0), (1.0, "exertion", 0.0, 0.0))
    assert blend.at(1.0) == {"fatigue": 0.4}
    assert Blend().changed(0.0, "calm", 0.0, 1.0) == (Blend(), ())
    assert set_states((0.0, "calm", 0.7, 0.0), (1.0, "angry", 0.0, 0.0)).at(1.0) == {"calm": 0.7}


def test_other_words_are_kept_under_the_states_own_name() -> None:
    blend, began = Blend().changed(0.0, "Afraid", 1.0, 0.0)
    assert list(blend.changes) == [c.name for c in began] == ["anxious"]


@pytest.mark.parametrize(
    ("name", "intensity", "ramp", "said"),
    [
        ("anxios", 1.0, 0.0, "did you mean anxious"),
        ("calm", 1.1, 0.0, r"intensity=1.1 must be a number in \[0, 1\]"),
        ("calm", float("nan"), 0.0, "intensity=nan"),
        ("calm", 1.0, -1.0, "ramp=-1"),
        ("calm", 1.0, float("inf"), "ramp=inf"),
    ],
)
def test_what_cannot_be_is_refused(name: str, intensity: float, ramp: float, said: str) -> None:
    with pytest.raises(InputError, match=said):
        Blend().changed(0.0, name, intensity, ramp)


STEPS = st.lists(st.tuples(st.floats(0, 5), st.sampled_from(sorted(STATES)), LEVELS, st.floats(0.5, 5)), max_size=12)


@given(STEPS)
def test_nothing_jumps_moods_end_and_nothing_piles_up(steps: list[tuple[float, str, float, float]]) -> None:
    blend, time = Blend(), 0.0
    for wait, name, intensity, ramp in steps:
        time += wait
        before = blend.at(time)
        blend, began = blend.changed(time, name, intensity, ramp)
        after = blend.at(time)
        assert {n: after.get(n, 0.0) for n in before | after} == pytest.approx({n: before.get(n, 0.0) for n in before | after})  # fmt: skip  # noqa: E501
        assert len({c.name for c in began}) == len(began)
        assert len(blend.changes) < len(STATES)
        settled = blend.at(time + ramp)
        moods = [n for n in settled if STATES[n].kind == "mood"]
        if STATES[name].kind == "mood" and intensity:
            assert moods == ([] if name == "neutral" else [name])
        assert all(0.0 < level <= 1.0 for level in settled.values())
