"""What holds for every parameter."""

from __future__ import annotations

import pytest

from scorebreath.parameters.derive import derive
from scorebreath.parameters.faces import face
from scorebreath.parameters.in_force import in_force
from scorebreath.parameters.physique import physique
from scorebreath.parameters.table import Parameters, bounds


@pytest.mark.parametrize("name", Parameters.model_fields)
def test_every_parameter_has_a_value_and_it_can_be_set(name: str) -> None:
    value = in_force(Parameters())[name]
    again = in_force(Parameters(**{name: value}))
    assert again[name] == value
    if isinstance(value, float):
        low, high = bounds(name) or (0.0, 0.0)
        assert low <= value <= high


def test_what_is_not_set_is_derived() -> None:
    p = Parameters(sex="female", height=165.0, look_at_listener=0.2)
    values = in_force(p)
    assert values["vocal_tract_length"] == physique(p).vocal_tract_length
    assert values["length_inspiration"] == derive(p).length_inspiration
    assert values["blink_interval"] == face(p).blink_interval
    assert (values["look_at_listener"], values["sex"]) == (0.2, "female")
