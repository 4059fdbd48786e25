"""Options become values; what cannot be is refused by name."""

from __future__ import annotations

from dataclasses import fields
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import InputError, ParameterError
from scorebreath_cli.settings import CompileOptions, RecordingOptions, frame_rate, seconds, seed

GIVEN: dict[str, tuple[Any, str]] = {
    "voice": ("tone", "--voice"),
    "model": ("natural", "--model"),
    "presets": (("nose",), "--preset"),
    "assignments": (("nose_share=1",), "--set"),
    "states": (("anxious",), "--state"),
    "cast": (("tone=woman",), "--cast"),
    "markup": ("none", "--markup"),
    "breaths": ("breaths", "--breaths"),
    "seed": (0, "--seed"),
    "language": ("en", "--language"),
    "poem": (False, "--prose"),
    "lead": (0.0, "--lead"),
    "tail": (0.0, "--tail"),
    "breath_sound": (False, "--no-breath-sound"),
    "breath_motion": (True, "--breath-motion"),
    "face": ("restrained", "--face"),
    "without": (("head",), "--without"),
}


def test_every_option_of_compiling_is_refused_on_a_score() -> None:
    assert {field.name for field in fields(CompileOptions)} - {"recording"} == set(GIVEN)
    CompileOptions().refuse("x.json")
    for name, (value, flag) in GIVEN.items():
        with pytest.raises(InputError, match=rf"^x\.json: is a score; {flag} belongs"):
            CompileOptions(**{name: value}).refuse("x.json")
    for field in fields(RecordingOptions):
        flag = "--" + field.name.replace("_", "-")
        with pytest.raises(InputError, match=rf"^x\.json: is a score; {flag} belongs"):
            CompileOptions(recording=RecordingOptions(**{field.name: "x"})).refuse("x.json")


@given(st.integers(1, 999), st.integers(1, 10_000))
def test_a_ratio_of_frames_is_exact(number: int, below: int) -> None:
    assert frame_rate(f"{number}/{below}") == Fraction(number, below)


@given(st.integers(1, 999), st.integers(0, 999))
def test_a_decimal_of_frames_is_exact(whole: int, thousandths: int) -> None:
    assert frame_rate(f"{whole}.{thousandths:03}") == whole + Fraction(thousandths, 1000)


@pytest.mark.parametrize(
    "text", ["", "0", "-5", "abc", "1/0", "nan", "inf", "1e3", "1e999999999", "60 fps", "100001", "0.0", "9" * 80, "²"]
)
def test_other_frame_rates_are_refused(text: str) -> None:
    with pytest.raises(InputError, match="fps"):
        frame_rate(text)


@pytest.mark.parametrize("value", [-0.1, 60.1, float("nan"), float("inf")])
def test_silences_have_limits(value: float) -> None:
    assert seconds("lead", None, 0.5) == 0.5
    assert seconds("lead", 0.0, 0.5) == 0.0
    with pytest.raises(InputError, match="--tail"):
        seconds("tail", value, 1.0)


def test_seeds_have_limits() -> None:
    assert (seed(None), seed(0), seed(2**53 - 1)) == (0, 0, 2**53 - 1)
    for value in (-1, 2**53):
        with pytest.raises(InputError, match="--seed"):
            seed(value)


def test_what_comes_later_wins(tmp_path: Path) -> None:
    preset = tmp_path / "mine.toml"
    preset.write_text("[parameters]\nnose_share = 0.1\nbreath_level = -30.0\nbreath_sound = true\n")
    options = CompileOptions(
        presets=(str(preset),),
        assignments=("nose_share=0.2", "nose_share=0.3", "breath_sound=true"),
        breath_sound=False,
    )
    assert options.values() == {"nose_share": 0.3, "breath_level": -30.0, "breath_sound": False}
    assert options.parameters().set_by_hand() == options.values()


@pytest.mark.parametrize("text", ["nose_share", "nosey=1", "nose_share=2", "nose_share=", "=1", "nose_share=nan"])
def test_wrong_assignments_are_refused(text: str) -> None:
    with pytest.raises(ParameterError):
        CompileOptions(assignments=(text,)).parameters()


def test_states_are_names_and_intensities() -> None:
    assert CompileOptions(states=("anxious=0.8", "fatigue")).begin() == {"anxious": 0.8, "fatigue": 1.0}
    for wrong in ("anxious=2", "anxious=", "anxious=nan", "anxous=0.5", "=1", "anxious=-0.1"):
        with pytest.raises(InputError):
            CompileOptions(states=(wrong,)).begin()


def test_who_speaks_with_another_voice_is_cast() -> None:
    options = CompileOptions(assignments=("motion_gain=2",), cast=("espeak:en-us+f3=woman", "tone=child"))
    cast = options.casting()
    assert (cast["espeak:en-us+f3"].sex, cast["espeak:en-us+f3"].motion_gain) == ("female", 2.0)
    assert cast["tone"].age < 18
    for wrong in ("woman", "=woman", "tone=", "tone=nobody"):
        with pytest.raises(InputError):
            CompileOptions(cast=(wrong,)).casting()


def test_kinds_of_markup_are_known() -> None:
    assert CompileOptions().kind_of_markup() == "auto"
    with pytest.raises(InputError, match="tags, ssml, "):
        CompileOptions(markup="xml").kind_of_markup()
