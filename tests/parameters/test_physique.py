"""The body of a person: predicted unless set by hand."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import ParameterError
from scorebreath.parameters.physique import Physique, physique
from scorebreath.parameters.presets import load_preset
from scorebreath.parameters.table import Parameters, bounds

WHO: dict[str, Any] = {
    "sex": st.sampled_from(("male", "female")),
    "age": st.floats(5, 95),
    "height": st.floats(80, 230),
    "posture": st.sampled_from(("upright", "reclined", "supine")),
    "condition": st.sampled_from(("none", "parkinson", "copd")),
}
PEOPLE = st.builds(Parameters, **WHO)


def test_the_default_man_is_as_he_was() -> None:
    expected = Physique(vital_capacity=5.10, resting_volume=0.38, thorax_share=0.65, vocal_tract_length=17.0)
    assert physique(Parameters()) == expected


@given(PEOPLE)
def test_every_body_is_within_what_may_be_set(p: Parameters) -> None:
    body = physique(p)
    for name, value in (
        ("vital_capacity", body.vital_capacity),
        ("resting_volume", body.resting_volume),
        ("vocal_tract_length", body.vocal_tract_length),
    ):
        low, high = bounds(name) or (0.0, 0.0)
        assert low <= value <= high
        again = physique(p.with_values({name: value}))
        assert again == body, "what was predicted can be set by hand"
    assert 0.0 < body.thorax_share < 1.0
    assert round(body.vital_capacity * 100) / 100 == body.vital_capacity


@pytest.mark.parametrize(
    ("values", "resting", "thorax"),
    [
        ({}, 0.38, 0.65),
        ({"posture": "supine"}, 0.22, 0.30),
        ({"posture": "reclined"}, 0.30, 0.475),
        ({"sex": "female"}, 0.38, 0.70),
        ({"condition": "parkinson"}, 0.38, 0.50),
        ({"condition": "copd"}, 0.38, 0.65),
        ({"sex": "female", "posture": "supine", "condition": "parkinson"}, 0.22, 0.20),
    ],
)
def test_posture_sex_and_condition(values: dict[str, Any], resting: float, thorax: float) -> None:
    body = physique(Parameters(**values))
    assert body.resting_volume == resting
    assert body.thorax_share == pytest.approx(thorax)


def test_what_is_set_by_hand_wins() -> None:
    values = {"vital_capacity": 2.345, "resting_volume": 0.41, "abdomen_share": 0.35, "vocal_tract_length": 15.5}
    p = Parameters(posture="supine", sex="female", age=80.0, **values)
    expected = Physique(vital_capacity=2.345, resting_volume=0.41, thorax_share=0.65, vocal_tract_length=15.5)
    assert physique(p) == expected


def test_ecsc_for_a_child_says_what_to_do() -> None:
    p = Parameters(age=12.0, height=150.0, capacity_equation="ecsc-1993")
    with pytest.raises(ParameterError, match="set capacity_equation='gli-2022', or vital_capacity by hand"):
        physique(p)
    assert physique(p.with_values({"vital_capacity": 2.8})).vital_capacity == 2.8


def test_ecsc_of_an_adult() -> None:
    assert physique(Parameters(capacity_equation="ecsc-1993")).vital_capacity == pytest.approx(5.13, abs=0.005)


@pytest.mark.parametrize(
    ("preset", "capacity", "tract"),
    [("woman", 3.68, 14.5), ("child", 1.78, 12.0), ("old-man", 3.70, 16.71), ("old-woman", 2.54, 14.17)],
)
def test_the_presets_are_people(preset: str, capacity: float, tract: float) -> None:
    body = physique(Parameters(**load_preset(preset).values))
    assert body.vital_capacity == pytest.approx(capacity, abs=0.02)
    assert body.vocal_tract_length == pytest.approx(tract, abs=0.01)
