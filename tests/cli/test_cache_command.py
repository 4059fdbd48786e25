"""`scorebreath cache`, and what commands that speak do with what was said before."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scorebreath.speech.cache.shelf import FOLDER, LIMIT
from tests.cli.running import events, run

TEXT = "The rain came in from the west, and stayed until the evening. Nobody had asked it to.\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(FOLDER, str(tmp_path / "kept"))
    return tmp_path / "kept"


def spoken(*arguments: object) -> list[tuple[int, int]]:
    """How much was spoken and how much was known, each time the program told."""
    done = run("compile", "-", "--json", *arguments, text=TEXT)
    assert done.exit_code == 0, done.output
    return [(event["spoken"], event["kept"]) for event in events(done.stdout) if event["event"] == "cache"]


def test_a_second_compilation_speaks_nothing(folder: Path, tmp_path: Path) -> None:
    out = ("-o", tmp_path / "score.json", "--force")
    ((first, _),) = spoken(*out)
    assert first > 1
    one = json.loads((tmp_path / "score.json").read_text())
    assert spoken(*out, "--set", "nose_share=0.2", "--seed", 5) == [(0, first)]
    two = json.loads((tmp_path / "score.json").read_text())
    assert one["media"] == two["media"]
    assert one["events"] != two["events"]
    assert spoken(*out, "--set", "prosody_rate=1.1") == [(first, 0)]


def test_without_a_cache_nothing_is_kept(folder: Path, tmp_path: Path) -> None:
    assert spoken("-o", tmp_path / "score.json", "--no-cache") == []
    assert not folder.exists()


def test_it_is_shown_checked_pruned_and_cleared(folder: Path, tmp_path: Path) -> None:
    spoken("-o", tmp_path / "score.json")
    shown = {event["event"]: event for event in events(run("cache", "--json").stdout)}
    assert shown["cache"]["folder"] == str(folder)
    assert shown["cache"]["utterances"] == shown["voice"]["utterances"] > 1
    assert shown["voice"]["voice"] == "espeak:en-us"
    held = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    assert shown["cache"]["bytes"] == held
    broken = next((folder / "utterances").glob("*/*.json"))
    broken.write_bytes(b"{")
    whole = shown["cache"]["utterances"] - 1
    assert f"{whole} utterances are whole; 2 broken or unused files removed" in run("cache", "--check").output
    assert run("cache", "--prune", "1k").exit_code == 0
    assert sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) <= 1000
    spoken("-o", tmp_path / "other.json")
    assert "0 utterances removed" in run("cache", "--clear", "--voice", "joe").output
    assert "0 utterances removed" not in run("cache", "--clear").output
    assert not [path for path in folder.rglob("*") if path.is_file()]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--clear", "--check"), "--check beside --clear"),
        (("--voice", "joe"), "--voice: belongs to --clear"),
        (("--prune", "much"), "expected a size such as 500MB"),
    ],
)
def test_what_cannot_be_meant_is_refused(folder: Path, arguments: tuple[str, ...], said: str) -> None:
    done = run("cache", *arguments)
    assert done.exit_code == 2
    assert said in done.output


def test_a_limit_that_is_no_size_is_said_before_anything_is_spoken(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(LIMIT, "much")
    done = run("compile", "-", "-o", tmp_path / "score.json", text=TEXT)
    assert done.exit_code == 2
    assert f"{LIMIT}='much'" in done.output
    assert not (tmp_path / "score.json").exists()


def test_off_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(FOLDER, "off")
    assert "off" in run("cache").output


def test_a_folder_that_cannot_be_written_is_said_and_the_work_is_done(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(FOLDER, str(tmp_path / "file" / "kept"))
    done = run("compile", "-", "-o", tmp_path / "score.json", text=TEXT)
    assert done.exit_code == 0
    assert "nothing more is kept there" in done.output
    assert (tmp_path / "score.json").exists()
