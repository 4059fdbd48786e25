"""`--face` and `--without`: how the face behaves, and what it leaves out."""

from __future__ import annotations

import json
from itertools import combinations
from pathlib import Path

import pytest

from scorebreath.errors import InputError
from scorebreath.parameters.face_table import FACES
from scorebreath.parameters.table import Parameters
from scorebreath_cli import options as o
from scorebreath_cli.settings import FACE_PARTS, CompileOptions
from tests.cli.running import run


@pytest.mark.parametrize("face", FACES)
def test_a_face_is_the_parameter_of_that_name(face: str) -> None:
    assert CompileOptions(face=face).parameters().face == face


def test_every_part_is_a_parameter_of_its_own() -> None:
    """A60: each can be left out by itself, and nothing else changes."""
    assert {f"face_{part}" for part in FACE_PARTS} == {
        name for name, field in Parameters.model_fields.items() if name.startswith("face_") and field.default is True
    }
    for part in FACE_PARTS:
        assert CompileOptions(without=(part,)).values() == {f"face_{part}": False}


def test_parts_are_separated_by_commas_or_given_again() -> None:
    for one, two in combinations(FACE_PARTS, 2):
        expected = {f"face_{one}": False, f"face_{two}": False}
        assert CompileOptions(without=(f"{one},{two}",)).values() == expected
        assert CompileOptions(without=(one, f" {two} ", one)).values() == expected


def test_options_win_over_assignments() -> None:
    options = CompileOptions(assignments=("face=restrained", "face_head=true"), face="albrecht-2002", without=("head",))
    assert options.values() == {"face": "albrecht-2002", "face_head": False}


def test_who_speaks_with_another_voice_has_the_same_face() -> None:
    (own,) = CompileOptions(face="albrecht-2002", without=("gaze",), cast=("tone=woman",)).casting().values()
    assert (own.face, own.face_gaze, own.sex) == ("albrecht-2002", False, "female")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (CompileOptions(face="albrecht"), r"^--face albrecht: expected restrained, albrecht-2002; did you mean albr"),
        (CompileOptions(face=""), r"^--face \(nothing\): expected restrained, albrecht-2002$"),
        (CompileOptions(without=("blink",)), r"^--without blink: expected .*; did you mean blinks\?$"),
        (CompileOptions(without=("head,,gaze",)), r"^--without \(nothing\): expected blinks, brows"),
        (CompileOptions(without=("Head",)), r"^--without Head: .*did you mean head"),
    ],
)
def test_what_there_is_not_is_refused_by_name(options: CompileOptions, said: str) -> None:
    with pytest.raises(InputError, match=said):
        options.parameters()


def test_they_complete() -> None:
    assert o.complete_faces("al") == ["albrecht-2002"]
    assert o.complete_parts("") == list(FACE_PARTS)
    assert o.complete_parts("b") == ["blinks", "brows"]
    assert o.complete_parts("head,b") == ["head,blinks", "head,brows"]
    assert o.complete_parts("blinks,b") == ["blinks,brows"]


@pytest.mark.parametrize("command", ["compile", "render"])
def test_help_tells_of_them(command: str) -> None:
    said = run(command, "--help").stdout
    assert "--face" in said
    assert "albrecht-2002" in said
    assert "--without" in said


def test_a_score_remembers_what_was_left_out(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("One two three. Four five six?")
    made = run(
        "compile", tmp_path / "a.txt", "--voice", "tone", "--face", "albrecht-2002", "--without", "gaze,brows",
        "--without", "head,blinks,emotion",
    )  # fmt: skip
    assert made.exit_code == 0
    score = json.loads(made.stdout)
    assert score["bodies"][0]["parameters"] == {
        "face": "albrecht-2002", **{f"face_{part}": False for part in FACE_PARTS},
    }  # fmt: skip
    seen = {event["type"] for event in score["events"]}
    assert seen.isdisjoint({"blink", "brow", "head", "gaze", "emotion"})
    again = run("render", "-", "-o", tmp_path / "out", "--without", "head", text=made.stdout)
    assert again.exit_code == 2
    assert again.stderr == "scorebreath: <stdin>: is a score; --without belongs to compiling a script\n"
