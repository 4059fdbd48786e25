"""Faces: each is complete, within the table's ranges, and gives way to what is set by hand."""

from __future__ import annotations

from dataclasses import fields

import pytest

from scorebreath.parameters.columns import read_table
from scorebreath.parameters.face_table import FACES
from scorebreath.parameters.faces import Face, face
from scorebreath.parameters.table import Parameters, bounds

NAMES = [field.name for field in fields(Face)]


def test_the_file_has_the_faces_that_can_be_chosen() -> None:
    assert tuple(read_table("faces.toml")) == FACES


@pytest.mark.parametrize("name", FACES)
def test_a_face_gives_every_rate_within_its_range(name: str) -> None:
    given = read_table("faces.toml")[name]
    assert sorted(given) == sorted(NAMES)
    for rate, value in given.items():
        low, high = bounds(rate) or (0.0, 0.0)
        assert low <= value <= high, rate


def test_rates_left_open_are_those_of_a_face() -> None:
    open_ = {
        name
        for name, row in Parameters.model_fields.items()
        if row.default is None and isinstance(row.json_schema_extra, dict) and row.json_schema_extra["level"] == "face"
    }
    assert open_ == set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_what_is_set_by_hand_stays(name: str) -> None:
    value = (bounds(name) or (0.0, 0.0))[1]
    chosen = face(Parameters(face="albrecht-2002", **{name: value}))
    assert getattr(chosen, name) == value
    usual = face(Parameters(face="albrecht-2002"))
    assert all(getattr(chosen, other) == getattr(usual, other) for other in NAMES if other != name)


def test_the_papers_face_has_the_papers_rates() -> None:
    paper = face(Parameters(face="albrecht-2002"))
    assert (paper.blink_interval, paper.brow_at_maximum, paper.roll_at_raise, paper.glance_at_accent) == (
        4.8,  # A21
        0.71,  # A28
        0.75,  # A27
        0.75,  # A31
    )
