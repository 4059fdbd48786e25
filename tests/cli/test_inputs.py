"""What an input is, and what its output is called."""

from __future__ import annotations

import io
from pathlib import Path
from types import SimpleNamespace

import pytest

from scorebreath.errors import InputError
from scorebreath.script.decode import LIMIT, decode
from scorebreath_cli.inputs import load_score, names_of, read_source


@pytest.mark.parametrize(
    ("name", "data", "kind"),
    [
        ("a.txt", b"Hello.", "script"),
        ("a.txt", b"", "script"),
        ("a.txt", b"{laughs} Hello.", "script"),
        ("a", b'{"schema":"scorebreath.score/1"}', "score"),
        ("a", b'\xef\xbb\xbf \n{\n"bodies":[', "score"),
        ("a.txt", b"{}", "score"),
        ("broken.json", b"not json", "score"),
    ],
)
def test_what_begins_as_json_is_a_score(tmp_path: Path, name: str, data: bytes, kind: str) -> None:
    (tmp_path / name).write_bytes(data)
    assert read_source(str(tmp_path / name)).kind == kind


def test_a_folder_is_a_take_or_the_score_in_it(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"without take\.jsonl and score\.json"):
        read_source(str(tmp_path))
    (tmp_path / "score.json").write_text("{}")
    inside = read_source(str(tmp_path))
    assert (inside.kind, inside.path) == ("score", tmp_path / "score.json")
    (tmp_path / "take.jsonl").write_text("")
    assert read_source(str(tmp_path)).kind == "take"
    assert read_source(str(tmp_path / "take.jsonl")).kind == "take"


@pytest.mark.parametrize("name", ["missing.txt", "file/inside.txt", "nul\0byte"])
def test_a_missing_file_is_the_users(tmp_path: Path, name: str) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match=r"no such file|null byte"):
        read_source(str(tmp_path / name))


def test_stdin_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", SimpleNamespace(buffer=io.BytesIO(b"Hello.")))
    source = read_source("-")
    assert (source.name, source.path, source.data, source.kind) == ("<stdin>", None, b"Hello.", "script")


def test_a_script_is_no_score(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("Hello.")
    with pytest.raises(InputError, match=r"is not a score.*compile"):
        load_score(read_source(str(tmp_path / "a.txt")))


def test_names_do_not_cover_each_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "takes" / "one.two").mkdir(parents=True)
    (tmp_path / "out").mkdir()
    monkeypatch.chdir(tmp_path / "out")
    given = ["a.txt", "b/c.d.md", "x/score.json", "score.json", "../takes/one.two", "-", "y/take.jsonl"]
    assert names_of(given) == ["a", "c.d", "x", "out", "one.two", "stdin", "y"]
    for pair in (["a/x.txt", "b/x.txt"], ["x.txt", "x.md"], ["x.txt", "X.txt"], ["-", "stdin.txt"], ["x", "x"]):
        with pytest.raises(InputError, match="rename one"):
            names_of(pair)


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="no endless device here")
def test_an_input_that_never_ends_is_read_no_further_than_its_limit() -> None:
    source = read_source("/dev/zero")
    assert len(source.data) == LIMIT + 1
    with pytest.raises(InputError, match="at most"):
        decode(source.data, source.name)
