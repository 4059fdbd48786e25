"""Outputs: whole or not at all, and nothing of others is touched."""

from __future__ import annotations

import errno
import os
import signal
import stat
from pathlib import Path

import pytest

from scorebreath.errors import EnvironmentFailure, InputError
from scorebreath_cli import outputs
from scorebreath_cli.outputs import old_media, refuse_existing, staged, staged_file, uninterrupted

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
