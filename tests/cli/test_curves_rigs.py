"""`curves --rig`, `--keys`, `--no-closure-gate`, and `rigs`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scorebreath.curves.rigs.table import RIGS, rig_named
from scorebreath.score.codec import dumps
from tests.cli.running import events, run
from tests.curves.faces import whole_face


@pytest.fixture(scope="module")
def score(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("faces") / "score.json"
    path.write_bytes(dumps(whole_face()))
    return path


def lines(path: Path) -> list[str]:
    return path.read_text("ascii").splitlines()


@pytest.mark.parametrize("name", RIGS)
def test_every_rig_is_written(name: str, score: Path, tmp_path: Path) -> None:
    table, document = tmp_path / "face.csv", tmp_path / "face.json"
    for path in (table, document):
        done = run("curves", score, "-o", path, "--rig", name, "--fps", "24")
        assert (done.exit_code, done.stdout) == (0, f"{path}\n"), done.stderr
    assert lines(table)[0].endswith(",".join(rig_named(name).columns))
    assert json.loads(document.read_bytes())["rig"] == name
    piped = run("curves", score, "--rig", name, "--fps", "24")
    assert piped.stdout_bytes == table.read_bytes()


def test_a_fap_file_is_asked_for_by_its_name_or_format(score: Path, tmp_path: Path) -> None:
    assert run("curves", score, "--rig", "fap", "-o", tmp_path / "a.fap", "--fps", "25").exit_code == 0
    assert lines(tmp_path / "a.fap")[0].startswith("2.1 body 25 ")
    same = run("curves", score, "--rig", "fap", "--format", "fap", "--fps", "25")
    assert same.stdout_bytes == (tmp_path / "a.fap").read_bytes()


def test_the_gate_the_keys_and_degrees_are_options(score: Path) -> None:
    def got(*more: str) -> bytes:
        result = run("curves", score, "--fps", "12", *more)
        assert result.exit_code == 0, result.stderr
        return result.stdout_bytes

    assert got("--rig", "arkit") != got("--rig", "arkit", "--no-closure-gate")
    assert got("--no-closure-gate") != got()
    assert len(got("--rig", "arkit", "--keys").splitlines()) > len(got("--rig", "arkit").splitlines())
    assert set(got().splitlines()) < set(got("--keys").splitlines())
    assert got("--rig", "livelink") != got("--rig", "livelink", "--degrees")


def test_without_a_rig_all_is_as_before(score: Path) -> None:
    from scorebreath.curves.channels import CHANNELS

    header = run("curves", score).stdout.partition("\n")[0]
    assert header == ",".join(["time", *(channel.name for channel in CHANNELS)])


def test_a_rig_of_one_s_own(score: Path, tmp_path: Path) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text('like = "arkit"\norder = ["jawOpen", "thorax"]\n')
    assert run("curves", score, "--rig", mine).stdout.startswith("time,jawOpen,thorax\n")
    rows = events(run("curves", "--describe", "--rig", mine, "--json").stdout)
    assert [row["name"] for row in rows if row["event"] == "column"] == ["jawOpen", "thorax"]
    assert [row["driver"] for row in rows if row["event"] == "driver"] == ["mouth"]
    mine.write_text("[columns]\na = { from = { jaw = 1 } }")
    wrong = run("curves", score, "--rig", mine)
    assert (wrong.exit_code, wrong.stdout) == (2, "")
    assert wrong.stderr.startswith("scorebreath: rig mine: a: from 'jaw' is unknown")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--rig", "arkti"], "no rig is called 'arkti' (there are arkit, livelink, "),
        (["--rig", "arkit", "--rig", "fap"], "--rig arkit --rig fap: one file holds one rig; `render` writes several"),
        (["-o", "face.xlsx"], "face.xlsx: expected a name that ends with .csv or .json, or --format with any name"),
        (["--rig", "none.toml"], "the rig 'none.toml' cannot be read: "),
        (["--rig", "arkit", "--format", "fap"], "--format fap of --rig arkit: must be csv or json"),
        (["--rig", "fap", "--format", "xml"], "--format xml of --rig fap: must be csv or json or fap"),
        (["--format", "fap"], "--format fap: must be csv or json"),
        (["-o", "face.fap"], "face.fap: a .fap file holds --rig fap"),
        (["--rig", "fap", "--format", "fap", "--fps", "29.97"], "--fps 29.97: must be a whole number in a .fap file"),
        (["--rig", "livelink", "--keys"], "--keys: a .csv of --rig livelink has no column of times"),
        (["--rig", "arkit", "--keys", "--format", "json"], "--keys: a .json of --rig arkit has no column of times"),
        (["--rig", "arkit", "--degrees"], "--degrees is for the .csv of --rig livelink"),
        (["--degrees"], "--degrees is for the .csv of --rig livelink"),
    ],
)
def test_what_does_not_fit_is_told_in_one_line(
    options: list[str], said: str, score: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = run("curves", score, *options)
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith(f"scorebreath: {said}") and result.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_describe_takes_nothing_that_it_would_not_use(tmp_path: Path) -> None:
    wrong = run("curves", "--describe", "-o", tmp_path / "face.csv")
    assert (wrong.exit_code, wrong.stdout) == (2, "") and "--describe explains columns" in wrong.stderr
    assert run("curves", tmp_path / "none.json", "--describe").exit_code == 2
    assert not list(tmp_path.iterdir())


def test_a_rig_like_livelink_is_written_as_its_files_are(score: Path, tmp_path: Path) -> None:
    """Another factor leaves it importable; another column does not."""
    mine = tmp_path / "mine.toml"
    mine.write_text('like = "livelink"\n[columns]\nmouthRollUpper = { from = { lip_tuck = 0.5 } }\n')
    theirs = [line.split(",") for line in run("curves", score, "--rig", "livelink", "--degrees").stdout.splitlines()]
    ours = [line.split(",") for line in run("curves", score, "--rig", mine, "--degrees").stdout.splitlines()]
    column = theirs[0].index("MouthRollUpper")
    assert max(float(row[column]) for row in ours[1:]) > 0.2 > 0.0 == max(float(row[column]) for row in theirs[1:])
    for row in (*ours[1:], *theirs[1:]):
        row[column] = ""
    assert ours == theirs
    mine.write_text('like = "livelink"\norder = ["jawOpen", "mouthClose"]\n')
    assert run("curves", score, "--rig", mine).stdout.startswith("time,JawOpen,MouthClose\n")
    mine.write_text('like = "fap"\n')
    assert run("curves", score, "--rig", mine, "-o", tmp_path / "mine.fap", "--fps", "25").exit_code == 0


def test_a_rig_s_own_file_is_never_replaced(score: Path, tmp_path: Path) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text('like = "arkit"\n')
    wrong = run("curves", score, "--rig", mine, "-o", mine, "--force", "--format", "csv")
    assert wrong.exit_code == 2 and "would replace its own input" in wrong.stderr
    assert mine.read_text() == 'like = "arkit"\n'


@pytest.mark.parametrize("name", RIGS)
def test_describe_tells_what_a_rig_s_columns_are_made_of(name: str) -> None:
    found = events(run("curves", "--describe", "--rig", name, "--json").stdout)
    rows = [row for row in found if row["event"] == "column"]
    assert [row["name"] for row in rows] == list(rig_named(name).columns)
    assert all(row["made_of"] and row["low"] < row["high"] for row in rows)
    drivers = [row for row in found if row["event"] == "driver"]
    assert drivers and all(row["meaning"] for row in drivers)
    words = " ".join(row["made_of"] for row in rows).replace(";", "").replace(":", "").split()
    assert all(row["driver"] in words for row in drivers)
    told = run("curves", "--describe", "--rig", name).stdout.splitlines()
    assert told[0].split() == ["name", "unit", "low", "high", "made", "of"] and len(told) == len(found) + 2


def test_rigs_lists_them() -> None:
    rows = events(run("rigs", "--json").stdout)
    assert [row["name"] for row in rows] == list(RIGS)
    assert next(row["files"] for row in rows if row["name"] == "fap") == ".csv .json .fap"
    told = run("rigs").stdout
    for row in rows:
        assert row["columns"] == len(rig_named(row["name"]).columns)
        assert row["about"] in told and row["signs"] in told
