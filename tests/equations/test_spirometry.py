"""Vital capacity: the test vectors of physiology 2.1, and what must hold for every body."""

from __future__ import annotations

from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.equations.spirometry import fvc_ecsc_1993, fvc_gli_2022
from scorebreath.errors import ParameterError

Sex = Literal["male", "female"]
SEXES: st.SearchStrategy[Sex] = st.sampled_from(("male", "female"))
AGES = st.floats(5, 95)
ADULTS = st.floats(18, 95)
HEIGHTS = st.floats(80, 229)
GROWN = st.floats(150, 200)

VECTORS: list[tuple[Sex, float, float, float, float | None]] = [
    ("male", 30, 178, 5.10, 5.13),
    ("female", 30, 165, 3.68, 3.64),
    ("male", 75, 178, 3.93, 3.96),
    ("female", 60, 165, 3.10, 2.86),
    ("male", 10, 138, 2.18, None),
]


@pytest.mark.parametrize(("sex", "age", "height", "gli", "ecsc"), VECTORS)
def test_the_vectors_of_physiology_2_1(sex: Sex, age: float, height: float, gli: float, ecsc: float | None) -> None:
    assert fvc_gli_2022(sex, age, height) == pytest.approx(gli, abs=0.01)
    if ecsc is not None:
        assert fvc_ecsc_1993(sex, age, height) == pytest.approx(ecsc, abs=0.01)


@given(SEXES, AGES, HEIGHTS)
def test_taller_people_have_larger_lungs(sex: Sex, age: float, height: float) -> None:
    assert 0.2 < fvc_gli_2022(sex, age, height) < fvc_gli_2022(sex, age, height + 1.0) < 12.0


@given(SEXES, ADULTS, GROWN)
def test_so_they_have_by_ecsc(sex: Sex, age: float, height: float) -> None:
    assert fvc_ecsc_1993(sex, age, height) < fvc_ecsc_1993(sex, age, height + 1.0)


@given(AGES, HEIGHTS)
def test_men_have_more_than_women_of_their_size(age: float, height: float) -> None:
    # but for children below 10 years, whose capacities the equation puts within a tenth of each other
    male, female = fvc_gli_2022("male", age, height), fvc_gli_2022("female", age, height)
    assert male > female if age >= 10 and height >= 120 else male > 0.9 * female


@given(SEXES, st.floats(31, 94), GROWN)
def test_lungs_shrink_with_age_from_30_on(sex: Sex, age: float, height: float) -> None:
    assert fvc_gli_2022(sex, age, height) > fvc_gli_2022(sex, age + 1.0, height)
    assert fvc_ecsc_1993(sex, age, height) > fvc_ecsc_1993(sex, age + 1.0, height)


@given(SEXES, AGES, HEIGHTS)
def test_no_birthday_is_a_step(sex: Sex, age: float, height: float) -> None:
    before, after = fvc_gli_2022(sex, age, height), fvc_gli_2022(sex, age + 0.01, height)
    assert after == pytest.approx(before, rel=0.001)


@given(st.floats(40, 80), st.floats(160, 190))
def test_the_two_equations_are_about_the_same_people(age: float, height: float) -> None:
    assert fvc_gli_2022("male", age, height) == pytest.approx(fvc_ecsc_1993("male", age, height), rel=0.15)


@pytest.mark.parametrize("age", [5.0, 10.0, 17.9])
def test_the_adults_equation_refuses_children(age: float) -> None:
    with pytest.raises(ParameterError, match=f"age={age:g} is below 18: set capacity_equation='gli-2022'"):
        fvc_ecsc_1993("male", age, 150)


def test_the_adults_equation_is_flat_below_25() -> None:
    assert fvc_ecsc_1993("female", 18, 165) == fvc_ecsc_1993("female", 25, 165) > fvc_ecsc_1993("female", 26, 165)
