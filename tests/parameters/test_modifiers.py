"""What persons and states do to breathing: the rows of physiology 1.5, and what must hold for all combinations."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.parameters.columns import COLUMNS, read_table
from scorebreath.parameters.modifiers import Modifiers, modifiers
from scorebreath.parameters.person import BY_HAND, loudness_weights, person_weights
from scorebreath.parameters.presets import load_preset
from scorebreath.parameters.states import STATES
from scorebreath.parameters.table import Parameters

PEOPLE = st.builds(
    Parameters,
    sex=st.sampled_from(("male", "female")),
    age=st.floats(5, 95),
    posture=st.sampled_from(("upright", "reclined", "supine")),
    condition=st.sampled_from(("none", "parkinson", "copd")),
    speaking_loudness=st.floats(10, 400),
    prosody_rate=st.floats(0.5, 2),
    breath_variability=st.floats(0, 0.6),
)
STATE_LEVELS = st.dictionaries(st.sampled_from(sorted(STATES)), st.floats(0, 1), max_size=len(STATES))

TABLE_1_5: list[tuple[str, dict[str, Any], dict[str, float]]] = [
    ("loud", {"speaking_loudness": 100 * 10**0.4},
     {"syllables": 0.9, "inspiration": 1.05, "volume": 1.25, "start": 0.08}),
    ("soft", {"speaking_loudness": 100 * 10**-0.3}, {"syllables": 1, "inspiration": 1, "volume": 0.9, "start": -0.04}),
    ("age 70+", {"age": 75.0}, {"syllables": 0.8, "inspiration": 1.05, "volume": 1.3, "depth": 1.15}),
    ("child 7-10", {"age": 10.0}, {"syllables": 0.65, "inspiration": 1.0, "said": 1.2, "delay": 1.8}),
    ("sex", {"sex": "female"}, {"syllables": 1, "inspiration": 1, "said": 1, "rate": 1, "thorax_share": 0.70}),
    ("Parkinson's", {"condition": "parkinson"},
     {"syllables": 0.7, "inspiration": 1.0, "said": 0.9, "thorax_share": 0.50, "rate": 1.1}),
    ("COPD", {"condition": "copd"},
     {"syllables": 0.6, "inspiration": 1.5, "said": 0.7, "breath_db": 6.0, "fraction": 0.50}),
    ("supine", {"posture": "supine"},
     {"start": 0.0, "syllables": 0.95, "inspiration": 1.0, "volume": 1.0, "thorax_share": 0.30}),
    ("slim", {"abdomen_share": 0.20}, {"thorax_share": 0.80, "syllables": 1.0}),
    ("stout", {"abdomen_share": 0.50}, {"thorax_share": 0.50, "syllables": 1.0}),
]  # fmt: skip


def figures(m: Modifiers) -> dict[str, float]:
    """The columns, and `said`: how deep a speech breath is, as 1.5 counts it."""
    return asdict(m) | {"said": m.syllables * m.volume}


@pytest.mark.parametrize(("row", "values", "expected"), TABLE_1_5, ids=[row[0] for row in TABLE_1_5])
def test_the_figures_of_physiology_1_5(row: str, values: dict[str, Any], expected: dict[str, float]) -> None:
    found = figures(modifiers(Parameters(**values), {}))
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, abs=0.005), f"{row}: {name}"


def test_copd_breathes_as_deep_of_a_smaller_capacity() -> None:
    p = Parameters(**load_preset("copd").values)
    assert figures(modifiers(p, {}))["said"] * 100.0 / p.capacity_lung == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(("rate", "syllables", "inspiration", "depth"), [(1.3, 1.2, 0.85, 1.0), (0.75, 0.8, 1.1, 1.05)])
def test_fast_and_slow_speech(rate: float, syllables: float, inspiration: float, depth: float) -> None:
    # the planner stretches the groups themselves, by rate^0.7
    m = modifiers(Parameters(prosody_rate=rate), {})
    assert m.syllables == 1.0
    assert m.inspiration == pytest.approx(inspiration, abs=0.06)
    assert rate**0.7 == pytest.approx(syllables, abs=0.02)
    assert rate**0.7 * m.volume == pytest.approx(depth, abs=0.03)


@pytest.mark.parametrize(("level", "syllables", "inspiration"), [(0.5, 0.6, 0.8), (0.9, 0.35, 0.7)])
def test_exercise_at_half_and_three_quarters_of_what_somebody_can_do(
    level: float, syllables: float, inspiration: float
) -> None:
    m = modifiers(Parameters(), {"exertion": level})
    assert m.syllables == pytest.approx(syllables, abs=0.03)
    assert m.inspiration == pytest.approx(inspiration, abs=0.03)
    assert 1.2 < m.syllables * m.volume + m.exhale_chance * 0.12 / 0.162 < 2.2


def test_the_default_speaker_is_exactly_neutral() -> None:
    assert modifiers(Parameters(), {}) == Modifiers()
    assert modifiers(Parameters(), {"neutral": 1.0}) == Modifiers()
    assert modifiers(Parameters(), dict.fromkeys(STATES, 0.0)) == Modifiers()


@given(PEOPLE, STATE_LEVELS)
def test_whatever_comes_together_stays_within_bounds(p: Parameters, states: dict[str, float]) -> None:
    m = modifiers(p, states)
    for name, value in asdict(m).items():
        column = COLUMNS[name]
        assert math.isfinite(value)
        assert column.low <= value <= column.high or value == column.neutral, name
    assert isinstance(m.saccades, int)
    assert m.syllables > 0
    assert m.inspiration > 0


@given(PEOPLE, STATE_LEVELS, st.sampled_from(sorted(STATES)), st.floats(0, 0.999))
def test_a_small_change_makes_a_small_change(p: Parameters, states: dict[str, float], name: str, level: float) -> None:
    one = asdict(modifiers(p, states | {name: level}))
    other = asdict(modifiers(p, states | {name: level + 0.001}))
    for column, value in one.items():
        if column == "saccades":
            assert abs(value - other[column]) <= 1
        elif column == "sigh_interval":  # how often
            assert (1 / other[column] if other[column] else 0) == pytest.approx(1 / value if value else 0, abs=2e-4)
        else:
            largest = 20.0 if column == "breath_db" else 8.0
            assert abs(value - other[column]) <= 0.001 * 3 * largest, column


@given(st.floats(5, 94), st.floats(20, 390), st.floats(0.5, 1.99))
def test_no_birthday_and_no_knob_is_a_step(age: float, loudness: float, rate: float) -> None:
    one = asdict(modifiers(Parameters(age=age, speaking_loudness=loudness, prosody_rate=rate), {}))
    other = asdict(
        modifiers(Parameters(age=age + 0.01, speaking_loudness=loudness + 0.1, prosody_rate=rate + 0.001), {})
    )
    assert other == pytest.approx(one, abs=0.02)


@given(STATE_LEVELS)
def test_states_add_up_in_any_order(states: dict[str, float]) -> None:
    assert modifiers(Parameters(), states) == modifiers(Parameters(), dict(reversed(states.items())))


def test_two_states_add_up() -> None:
    m = modifiers(Parameters(), {"anxious": 0.5, "fatigue": 1.0})
    assert m.syllables == pytest.approx(1 + 0.5 * (0.7 - 1) + (0.8 - 1))
    assert m.thorax_share == pytest.approx(0.65 + 0.5 * 0.20 - 0.10)
    assert m.variation == pytest.approx(0.15 + 0.5 * 0.20 + 0.10)
    assert m.sigh_interval == 60.0


def test_sighs_of_two_states_come_as_often_as_both() -> None:
    both = modifiers(Parameters(), {"sad": 1.0, "fatigue": 1.0}).sigh_interval
    assert 1 / both == pytest.approx(1 / 45 + 1 / 60)
    assert modifiers(Parameters(), {"sad": 0.5}).sigh_interval == pytest.approx(90.0)


def test_person_and_state_multiply() -> None:
    old_and_afraid = modifiers(Parameters(age=75.0), {"anxious": 1.0})
    assert old_and_afraid.syllables == pytest.approx(0.8 * 0.7)
    assert old_and_afraid.inspiration == pytest.approx(1.05 * 0.75)


def test_shares_set_by_hand_are_what_states_start_from() -> None:
    p = Parameters(nose_share=0.60, abdomen_share=0.20, posture="supine")
    m = modifiers(p, {"calm": 0.5})
    assert m.nose_share == pytest.approx(0.60 + 0.5 * (0.70 - 0.35))
    assert m.thorax_share == pytest.approx(0.80 + 0.5 * (0.50 - 0.65))
    assert modifiers(Parameters(nose_share=0.05), {"surprised": 1.0}).nose_share == 0.0
    assert modifiers(Parameters(abdomen_share=0.05), {"anxious": 1.0}).thorax_share == 1.0


def test_a_default_set_by_hand_is_not_the_same_as_a_default() -> None:
    # equal parameters: only what was set by hand tells them apart
    assert modifiers(Parameters(posture="supine"), {}).thorax_share == 0.30
    assert modifiers(Parameters(posture="supine", abdomen_share=0.35), {}).thorax_share == 0.65


@pytest.mark.parametrize(("column", "name"), BY_HAND.items())
def test_what_is_said_of_this_person_by_hand_is_not_changed_by_age_or_condition(column: str, name: str) -> None:
    for who in ({"age": 90.0, "condition": "parkinson"}, {"age": 8.0, "condition": "copd", "posture": "supine"}):
        by_hand = Parameters(**who, **{name: getattr(Parameters(), name)})
        assert getattr(modifiers(by_hand, {}), column) == COLUMNS[column].neutral
        moved = getattr(modifiers(by_hand, {"exertion": 1.0}), column)
        assert moved == getattr(modifiers(Parameters(), {"exertion": 1.0}), column)
    changed = any(
        getattr(modifiers(Parameters(**who), {}), column) != COLUMNS[column].neutral
        for who in ({"age": 90.0}, {"age": 8.0}, {"condition": "copd"})
    )
    assert changed


def test_a_persons_own_spread_scales_with_the_state() -> None:
    assert modifiers(Parameters(breath_variability=0.3), {}).variation == pytest.approx(0.3)
    assert modifiers(Parameters(breath_variability=0.3), {"anxious": 0.5}).variation == pytest.approx(0.3 * 0.25 / 0.15)
    assert modifiers(Parameters(breath_variability=0.0), {"crying": 1.0}).variation == 0.0


@pytest.mark.parametrize(
    ("age", "weights"),
    [
        (8, {"child": 1}),
        (10, {"child": 1}),
        (13, {"child": 0.5}),
        (16, {}),
        (60, {}),
        (67.5, {"aged": 0.5}),
        (95, {"aged": 1}),
    ],
)
def test_age_fades_in_and_out(age: float, weights: dict[str, float]) -> None:
    assert person_weights(Parameters(age=float(age))) == pytest.approx(weights)


@given(st.floats(10, 400), st.floats(10, 400))
def test_louder_speech_begins_higher(one: float, other: float) -> None:
    low, high = sorted((one, other))
    soft, loud = (modifiers(Parameters(speaking_loudness=value), {}) for value in (low, high))
    assert soft.start <= loud.start
    assert soft.volume <= loud.volume
    assert soft.syllables >= loud.syllables
    assert sum(loudness_weights(Parameters(speaking_loudness=low)).values()) <= 2.0


@pytest.mark.parametrize("name", read_table("persons.toml"))
def test_every_row_of_persons_is_used_and_says_why(name: str) -> None:
    row = read_table("persons.toml")[name]
    assert row["source"].startswith("e")
    users = [
        Parameters(**values)
        for values in (
            {"age": 80.0}, {"age": 8.0}, {"posture": "supine"}, {"posture": "reclined"}, {"condition": "parkinson"},
            {"condition": "copd"}, {"speaking_loudness": 200.0}, {"speaking_loudness": 50.0},
        )
    ]  # fmt: skip
    assert any(name in person_weights(p) | loudness_weights(p) for p in users)


@pytest.mark.parametrize("preset", ["old-man", "old-woman", "child", "teenager", "parkinson", "copd", "supine", "reclined", "loud", "soft", "fast", "slow", "chest", "belly"])  # fmt: skip  # noqa: E501
def test_every_preset_of_a_person_breathes_in_its_own_way(preset: str) -> None:
    assert modifiers(Parameters(**load_preset(preset).values), {}) != Modifiers()
