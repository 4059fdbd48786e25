"""`render --rig`: the curves as characters' own shapes, of this Score or not there at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from scorebreath.curves.rigs.table import RIGS
from scorebreath_cli.outputs import BODY_FILES, SET_FILES, old_rigs
from tests.cli.running import run

TWO = "<speak>One, two. <voice name='tone'>Three, four.</voice></speak>"


@pytest.fixture(scope="module")
def score(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("score")
    (folder / "a.txt").write_text("Poppy may bake a pie.")
    assert run("compile", folder / "a.txt", "-o", folder / "a.json", "--voice", "tone").exit_code == 0
    return folder / "a.json"


def columns(path: Path) -> list[str]:
    with path.open(encoding="utf-8") as stream:
        return stream.readline().strip().split(",")


def test_nothing_is_written_for_rigs_nobody_asked_for(score: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert run("render", score, "-o", out).exit_code == 0
    assert not {f"{rig}.csv" for rig in RIGS} & {path.name for path in out.iterdir()}


def test_each_rig_is_what_curves_writes(score: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    made = run("render", score, "-o", out, "--fps", "30", *(word for rig in RIGS for word in ("--rig", rig)))
    assert made.exit_code == 0
    assert made.stdout.split() == [str(out / name) for name in sorted((*SET_FILES, *(f"{rig}.csv" for rig in RIGS)))]
    for rig in RIGS:
        alone = tmp_path / f"{rig}.csv"
        assert run("curves", score, "-o", alone, "--fps", "30", "--rig", rig).exit_code == 0
        assert (out / f"{rig}.csv").read_bytes() == alone.read_bytes()
    assert len([name for name in columns(out / "arkit.csv") if name.startswith("mouth")]) == 23


def test_a_rig_of_ones_own_is_called_as_its_file(score: Path, tmp_path: Path) -> None:
    (tmp_path / "robot.toml").write_text('like = "arkit"\n')
    assert run("render", score, "-o", tmp_path / "out", "--rig", tmp_path / "robot.toml").exit_code == 0
    assert columns(tmp_path / "out" / "robot.csv")[0] == "time"
    (tmp_path / "curves.toml").write_text('like = "arkit"\n')
    wrong = run("render", score, "-o", tmp_path / "out2", "--rig", tmp_path / "curves.toml")
    assert wrong.exit_code == 2
    assert "curves.csv is another file of the output" in wrong.stderr
    assert not (tmp_path / "out2").exists()


def test_what_is_no_rig_is_refused_before_anything_is_made(score: Path, tmp_path: Path) -> None:
    wrong = run("render", score, "-o", tmp_path / "out", "--rig", "arkitt")
    assert wrong.exit_code == 2
    assert "did you mean arkit?" in wrong.stderr
    assert not (tmp_path / "out").exists()
    stdout = run("render", score, "-o", "-", "--rig", "arkit")
    assert (stdout.exit_code, stdout.stdout) == (2, "")


def test_old_curves_of_rigs_vanish_with_their_score(score: Path, tmp_path: Path) -> None:
    """They would move a character to other words than are heard; what is not ours stays."""
    out = tmp_path / "out"
    assert run("render", score, "-o", out, "--rig", "arkit", "--rig", "oculus").exit_code == 0
    (out / "mine.csv").write_text("kept")
    refused = run("render", score, "-o", out, "--rig", "oculus")
    assert refused.exit_code == 2
    assert run("render", score, "-o", out, "--rig", "oculus", "--force").exit_code == 0
    assert {path.name for path in out.glob("*.csv")} == {"curves.csv", "groups.csv", "oculus.csv", "mine.csv"}
    assert run("render", score, "-o", out, "--force").exit_code == 0
    assert {path.name for path in out.glob("*.csv")} == {"curves.csv", "groups.csv", "mine.csv"}


def test_a_folder_without_a_score_holds_nothing_of_ours(tmp_path: Path) -> None:
    (tmp_path / "arkit.csv").write_text("time\n")
    assert old_rigs(tmp_path) == set()


def test_an_existing_file_of_that_name_is_not_replaced_unasked(score: Path, tmp_path: Path) -> None:
    (tmp_path / "arkit.csv").write_text("mine")
    refused = run("render", score, "-o", tmp_path, "--rig", "arkit")
    assert refused.exit_code == 2
    assert "arkit.csv exists already" in refused.stderr
    assert (tmp_path / "arkit.csv").read_text() == "mine"


def test_every_body_has_its_own(tmp_path: Path) -> None:
    (tmp_path / "two.ssml").write_text(TWO)
    out = tmp_path / "out"
    made = run("render", tmp_path / "two.ssml", "-o", out, "--voice", "espeak", "--rig", "oculus")
    assert made.exit_code == 0, made.stderr
    assert {path.name for path in (out / "body2").iterdir()} == {*BODY_FILES, "oculus.csv"}
    assert (out / "oculus.csv").read_bytes() != (out / "body2" / "oculus.csv").read_bytes()
    assert run("render", tmp_path / "two.ssml", "-o", out, "--voice", "espeak", "--force").exit_code == 0
    assert {path.name for path in (out / "body2").iterdir()} == set(BODY_FILES)
