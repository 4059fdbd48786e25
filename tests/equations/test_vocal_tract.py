"""Length of the vocal tract: three people who were measured, and what must hold between them."""

from __future__ import annotations

from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.equations.vocal_tract import vocal_tract_length

Sex = Literal["male", "female"]
MEASURED: list[tuple[Sex, float, float, float]] = [
    ("male", 30, 178, 17.0),
    ("male", 17, 178, 17.0),
    ("female", 30, 165, 14.5),
    ("male", 8, 128, 12.0),
    ("female", 8, 128, 12.0),
]


@pytest.mark.parametrize(("sex", "age", "height", "length"), MEASURED)
def test_the_people_of_physiology_3_4(sex: Sex, age: float, height: float, length: float) -> None:
    assert vocal_tract_length(sex, age, height) == pytest.approx(length, abs=0.005)


@given(st.sampled_from(("male", "female")), st.floats(5, 95), st.floats(80, 229))
def test_it_grows_with_height_and_never_jumps_with_age(sex: Sex, age: float, height: float) -> None:
    length = vocal_tract_length(sex, age, height)
    assert 8.0 < length < vocal_tract_length(sex, age, height + 1.0) < 22.0
    assert vocal_tract_length(sex, age + 0.01, height) == pytest.approx(length, abs=0.01)


@given(st.floats(5, 95), st.floats(80, 230))
def test_only_puberty_parts_boys_from_girls(age: float, height: float) -> None:
    boy, girl = vocal_tract_length("male", age, height), vocal_tract_length("female", age, height)
    assert (boy == girl) if age <= 10 else boy >= girl
    if age >= 17:
        assert boy / girl == pytest.approx(1.108, abs=0.001)
