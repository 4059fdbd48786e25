"""What is in the repository's files: nothing of one machine, nothing left undone, no file that grew too long."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BINARY = {".wav", ".png", ".scsyndef", ".bin"}
LONGEST = {"tests": 500, "": 350}
"""Lines of a Python file, in tests and elsewhere."""

UNDONE = re.compile(r"\b(?:TODO|FIXME|HACK|NotImplementedError)\b|\bXXX\b(?!\")")
MACHINE = re.compile(r"(?<![\w.])/(?:work|root|farm|tmp|opt|mnt|Users|home)/(?!user\b)[\w.]")
"""A path that only one machine has."""


def files() -> list[Path]:
    listed = subprocess.run(
        ["git", "ls-files", "-z"],
        cwd=ROOT, capture_output=True, text=True, check=True,
    )  # fmt: skip
    return sorted(ROOT / name for name in listed.stdout.split("\0") if name and (ROOT / name).is_file())


FILES = files()
TEXTS = [path for path in FILES if path.suffix not in BINARY and path != Path(__file__).resolve()]


def places(pattern: re.Pattern[str], path: Path) -> list[str]:
    lines = path.read_text(encoding="utf-8").split("\n")
    return [
        f"{path.relative_to(ROOT)}:{n}: {line.strip()[:90]}" for n, line in enumerate(lines, 1) if pattern.search(line)
    ]


def test_the_patterns_find_what_they_are_for() -> None:
    assert MACHINE.search("open('/home/ann/x.txt')") and MACHINE.search("see /tmp/x")
    assert not any(MACHINE.search(path) for path in ("/home/user/x", "a/tmp/x", "/dev/null", "/usr/bin/env"))
    assert UNDONE.search("# TODO: later")


@pytest.mark.parametrize("pattern", [UNDONE, MACHINE], ids=["undone", "machine"])
def test_no_file_holds(pattern: re.Pattern[str]) -> None:
    assert [place for path in TEXTS for place in places(pattern, path)] == []


def test_every_text_is_utf8_with_unix_line_ends() -> None:
    wrong = [path.name for path in TEXTS if b"\r" in path.read_bytes() and path.parent.name != "golden"]
    assert wrong == []


def test_python_files_have_one_idea() -> None:
    long = {}
    for path in (p for p in FILES if p.suffix == ".py"):
        lines = path.read_text(encoding="utf-8").count("\n")
        name = path.relative_to(ROOT).as_posix()
        if lines > LONGEST.get(name.partition("/")[0], LONGEST[""]):
            long[name] = lines
    assert long == {}, "split them: one idea a file"


def test_test_files_have_names_of_their_own() -> None:
    names = [path.name for path in FILES if path.name.startswith("test_")]
    assert sorted(name for name in set(names) if names.count(name) > 1) == []


def test_nothing_big_is_stored() -> None:
    assert {path.name: path.stat().st_size for path in FILES if path.stat().st_size > 2_000_000} == {}
