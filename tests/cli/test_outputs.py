"""Outputs: whole or not at all, and nothing of others is touched."""

from __future__ import annotations

import errno
import json
import os
import signal
import stat
from pathlib import Path

import pytest

from scorebreath.errors import EnvironmentFailure, InputError
from scorebreath_cli import outputs
from scorebreath_cli.outputs import (
    old_media,
    refuse_existing,
    refuse_own_input,
    staged,
    staged_file,
    uninterrupted,
)
from tests.cli.running import run, spawn

SOUND = "speech/" + "ab" * 32 + ".wav"
OTHER = "speech/" + "cd" * 32 + ".wav"


def tree(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def fill(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def test_a_new_folder_appears_whole(tmp_path: Path) -> None:
    target = tmp_path / "a" / "b"
    with staged(target) as part:
        fill(part, {"mix.wav": "1", SOUND: "2"})
        assert not target.exists()
        assert part.parent == target.parent
    assert tree(tmp_path) == {"a/b/mix.wav": b"1", f"a/b/{SOUND}": b"2"}


def test_a_new_folder_may_be_read_like_any_other(tmp_path: Path) -> None:
    with staged(tmp_path / "out") as part:
        fill(part, {"mix.wav": "1"})
    (tmp_path / "plain").mkdir()
    assert stat.S_IMODE((tmp_path / "out").stat().st_mode) == stat.S_IMODE((tmp_path / "plain").stat().st_mode)


@pytest.mark.parametrize("exists", [False, True])
def test_a_failure_leaves_nothing(tmp_path: Path, exists: bool) -> None:
    target = tmp_path / "a" / "b"
    if exists:
        fill(target, {"mine.txt": "mine", "mix.wav": "old"})
    before = tree(tmp_path)
    with pytest.raises(ZeroDivisionError), staged(target) as part:
        fill(part, {"mix.wav": "half"})
        raise ZeroDivisionError
    assert tree(tmp_path) == before
    assert (tmp_path / "a").exists() == exists


def test_what_is_not_ours_stays(tmp_path: Path) -> None:
    fill(tmp_path, {"notes.txt": "mine", "speech/take.wav": "mine", "mix.wav": "old", OTHER: "old"})
    with staged(tmp_path, own=lambda _: {OTHER, "notes.txt", "speech/take.wav"}) as part:
        fill(part, {"mix.wav": "new", SOUND: "new"})
    assert tree(tmp_path) == {"notes.txt": b"mine", "speech/take.wav": b"mine", "mix.wav": b"new", SOUND: b"new"}


@pytest.mark.parametrize("fail_at", range(1, 6))
def test_a_failure_while_moving_puts_everything_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fail_at: int
) -> None:
    fill(tmp_path, {"mix.wav": "old", "score.json": "old", "curves.csv": "old", OTHER: "old", "mine": "mine"})
    before = tree(tmp_path)
    moves = 0
    rename = Path.rename

    def full(self: Path, target: Path) -> Path:
        nonlocal moves
        moves += 1
        if moves == fail_at:
            raise OSError(errno.ENOSPC, "No space left on device")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", full)
    with pytest.raises(EnvironmentFailure, match="No space left"), staged(tmp_path, own=lambda _: {OTHER}) as part:
        fill(part, {"mix.wav": "new", "score.json": "new", "curves.csv": "new", SOUND: "new"})
    assert moves >= fail_at
    assert tree(tmp_path) == before


def test_old_media_are_those_the_old_score_names(tmp_path: Path) -> None:
    assert old_media(tmp_path) == set()
    fill(tmp_path, {"score.json": f'{{"media":{{"x":{{"path":"{SOUND}"}},"y":{{"path":"../../etc/passwd"}}}}}}'})
    assert old_media(tmp_path) == {SOUND}
    fill(tmp_path, {"another.json": "{}"})
    assert old_media(tmp_path) == set()


def test_existing_output_needs_force(tmp_path: Path) -> None:
    refuse_existing(tmp_path / "new", ("mix.wav",), force=False)
    fill(tmp_path, {"notes.txt": ""})
    refuse_existing(tmp_path, ("mix.wav",), force=False)
    fill(tmp_path, {"mix.wav": ""})
    with pytest.raises(InputError, match=r"mix\.wav exists already; --force"):
        refuse_existing(tmp_path, ("mix.wav",), force=False)
    refuse_existing(tmp_path, ("mix.wav",), force=False, besides=tmp_path / "mix.wav")
    refuse_existing(tmp_path, ("mix.wav",), force=True)
    with pytest.raises(InputError, match="is a file"):
        refuse_existing(tmp_path / "notes.txt", ("mix.wav",), force=True)
    (tmp_path / "curves.csv").mkdir()
    with pytest.raises(InputError, match="is a folder"):
        refuse_existing(tmp_path, ("curves.csv",), force=True)


def test_a_folder_that_may_not_be_written_is_the_environments(tmp_path: Path) -> None:
    fill(tmp_path, {"file": ""})
    with pytest.raises(EnvironmentFailure, match="cannot be written"), staged(tmp_path / "file" / "out"):
        pass


def test_one_file_is_replaced_whole(tmp_path: Path) -> None:
    path = tmp_path / "curves.csv"
    path.write_text("old")
    with pytest.raises(ZeroDivisionError), staged_file(path) as part:
        part.write_text("half")
        raise ZeroDivisionError
    assert tree(tmp_path) == {"curves.csv": b"old"}
    with staged_file(path) as part:
        part.write_text("new")
        assert path.read_text() == "old"
    assert tree(tmp_path) == {"curves.csv": b"new"}
    with pytest.raises(ZeroDivisionError), staged_file(tmp_path / "new" / "folder" / "x.csv"):
        raise ZeroDivisionError
    with pytest.raises(EnvironmentFailure), staged_file(path / "x.csv"):
        pass
    assert [p.name for p in tmp_path.iterdir()] == ["curves.csv"]


def test_an_interrupt_waits_for_the_move_to_end() -> None:
    ended = False
    with pytest.raises(KeyboardInterrupt), uninterrupted():
        os.kill(os.getpid(), signal.SIGINT)
        ended = True
    assert ended
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_the_score_moves_last_and_names_are_known() -> None:
    assert outputs.SET_FILES[-1] == "score.json"
    assert len(set(outputs.SET_FILES)) == len(outputs.SET_FILES)


def test_an_output_never_replaces_its_own_input(tmp_path: Path) -> None:
    script = tmp_path / "s.txt"
    script.write_text("Hello there.")
    (tmp_path / "link.txt").symlink_to(script)
    for place in (script, tmp_path / "link.txt", tmp_path / "." / "s.txt"):
        result = run("compile", script, "-o", place, "--force", "--voice", "tone")
        assert (result.exit_code, "would replace its own input" in result.stderr) == (2, True)
    assert tree(tmp_path) == {"link.txt": b"Hello there.", "s.txt": b"Hello there."}

    assert run("compile", script, "-o", tmp_path / "score.json", "--voice", "tone").exit_code == 0
    before = tree(tmp_path)
    result = run("curves", tmp_path / "score.json", "-o", tmp_path / "score.json", "--force")
    assert (result.exit_code, "would replace its own input" in result.stderr) == (2, True)
    (tmp_path / "curves.json").write_bytes(before["score.json"])
    result = run("render", tmp_path / "curves.json", "-o", tmp_path, "--force")
    assert (result.exit_code, "would replace its own input" in result.stderr) == (2, True)
    assert tree(tmp_path) == {**before, "curves.json": before["score.json"]}


def test_an_output_never_replaces_the_file_that_is_stdin(tmp_path: Path) -> None:
    script = tmp_path / "s.txt"
    script.write_text("Hello there.")
    (tmp_path / "mix.wav").hardlink_to(script)
    for command, output in (("compile", script), ("compile", tmp_path / "mix.wav"), ("render", tmp_path)):
        with script.open("rb") as stream:
            result = spawn(command, "-", "-o", output, "--force", "--voice", "tone", stdin=stream)
        assert (result.returncode, b"would replace its own input" in result.stderr) == (2, True), result.stderr
    assert tree(tmp_path) == {"s.txt": b"Hello there.", "mix.wav": b"Hello there."}
    with script.open("rb") as stream:
        assert spawn("compile", "-", "-o", tmp_path / "s.json", "--voice", "tone", stdin=stream).returncode == 0


def test_a_take_is_not_replaced_by_its_curves(tmp_path: Path) -> None:
    (tmp_path / "take.jsonl").write_text("{}")
    with pytest.raises(InputError, match="its own input"):
        refuse_own_input(str(tmp_path), [tmp_path / "take.jsonl"])
    refuse_own_input(str(tmp_path), [tmp_path / "curves.csv"])
    refuse_own_input("-", [tmp_path / "take.jsonl"])


def test_a_score_may_be_rendered_where_it_lies(tmp_path: Path) -> None:
    (tmp_path / "s.txt").write_text("Hello there.")
    score = tmp_path / "out" / "score.json"
    assert run("compile", tmp_path / "s.txt", "-o", score, "--voice", "tone").exit_code == 0
    before = tree(tmp_path / "out")
    for force in ([], ["--force"]):
        for name in outputs.SET_FILES[:-1]:
            (tmp_path / "out" / name).unlink(missing_ok=True)
        assert run("render", score, "-o", score.parent, *force).exit_code == 0
        after = tree(tmp_path / "out")
        assert {name: after[name] for name in before} == before


def test_the_later_of_two_runs_into_a_new_folder_says_so(tmp_path: Path) -> None:
    target = tmp_path / "out"
    with pytest.raises(InputError, match=r"mix\.wav exists already.*--force"), staged(target) as part:
        fill(part, {"mix.wav": "late", SOUND: "1"})
        fill(target, {"mix.wav": "early"})
    assert tree(tmp_path) == {"out/mix.wav": b"early"}
    with staged(tmp_path / "scores") as part:
        fill(part, {"b.json": "b", SOUND: "1"})
        fill(tmp_path / "scores", {"a.json": "a", SOUND: "1"})
    assert tree(tmp_path / "scores") == {"a.json": b"a", "b.json": b"b", SOUND: b"1"}
    assert sorted(p.name for p in tmp_path.iterdir()) == ["out", "scores"]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes here")
@pytest.mark.parametrize("command", ["compile", "curves"])
@pytest.mark.parametrize("force", [(), ("--force",)])
def test_a_pipe_or_device_is_never_replaced(tmp_path: Path, command: str, force: tuple[str, ...]) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    assert run("compile", tmp_path / "in.txt", "-o", tmp_path / "in.json", "--voice", "tone").exit_code == 0
    pipe, link = tmp_path / "pipe", tmp_path / "link"
    os.mkfifo(pipe)
    link.symlink_to(pipe)
    given = tmp_path / ("in.txt" if command == "compile" else "in.json")
    for place in (pipe, link):
        result = run(command, given, "-o", place, *force)
        assert result.exit_code == 2
        assert "a device or a pipe" in result.stderr
        assert "--force" not in result.stderr
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert link.is_symlink()


def test_behind_a_link_the_file_is_replaced_and_the_link_stays(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    (tmp_path / "elsewhere").mkdir()
    target, link = tmp_path / "elsewhere" / "score.json", tmp_path / "link.json"
    target.write_text("old")
    link.symlink_to(target)
    assert run("compile", tmp_path / "in.txt", "-o", link, "--voice", "tone").exit_code == 2
    assert target.read_text() == "old"
    assert run("compile", tmp_path / "in.txt", "-o", link, "--voice", "tone", "--force").exit_code == 0
    assert link.is_symlink()
    assert target.read_text().startswith("{")


def test_a_sound_the_disk_cannot_hold_is_not_begun(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    assert run("compile", tmp_path / "in.txt", "-o", tmp_path / "in.json", "--voice", "tone").exit_code == 0
    score = json.loads((tmp_path / "in.json").read_text())
    (tmp_path / "in.json").write_text(json.dumps({**score, "duration": 1e9}))
    result = run("render", tmp_path / "in.json", "-o", tmp_path / "out")
    assert result.exit_code == 3
    assert "GB are free" in result.stderr
    assert not (tmp_path / "out").exists()


def test_a_full_disk_names_what_could_not_be_written(tmp_path: Path) -> None:
    """A write that fails does not say of which file."""
    said = r"face\.csv: cannot be written: No space left"
    with pytest.raises(EnvironmentFailure, match=said), staged_file(tmp_path / "face.csv"):
        raise OSError(errno.ENOSPC, "No space left on device")
    assert not list(tmp_path.iterdir())
