"""Every command and every Python example in README.md and docs/ runs as it is written."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = sorted([ROOT / "README.md", *(ROOT / "docs").glob("*.md")])
FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NOT_RUN = {"sudo", "apt-get", "git", "make", "pip", "python3"}
"""Commands that install, or start all of this: checked by name."""
SOURCES = ("scorebreath", "cli", "synthdefs")


def blocks(document: Path, language: str) -> list[str]:
    return [body for name, body in FENCE.findall(document.read_text(encoding="utf-8")) if name == language]


def commands(document: Path) -> list[str]:
    """Shell commands, one each, continued lines joined, comments gone."""
    lines = "\n".join(blocks(document, "sh")).replace("\\\n", " ").split("\n")
    return [line for line in lines if line.strip() and not line.lstrip().startswith("#")]


def with_language(language: str) -> list[Path]:
    return [document for document in DOCUMENTS if blocks(document, language)]


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A folder with the examples, as a reader has them, to write into."""
    shutil.copytree(ROOT / "examples", tmp_path / "p" / "examples")
    return tmp_path / "p"


@pytest.fixture
def surroundings(tmp_path: Path) -> dict[str, str]:
    """An environment in which `scorebreath` is this checkout's command."""
    command = tmp_path / "bin" / "scorebreath"
    command.parent.mkdir()
    command.write_text(
        f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -m scorebreath_cli.main "$@"\n', encoding="utf-8"
    )
    command.chmod(0o755)
    path = os.pathsep.join(str(ROOT / folder) for folder in ("", "cli", "synthdefs"))
    kept = {name: value for name, value in os.environ.items() if not name.startswith("SCOREBREATH")}
    return {
        **kept, "PYTHONPATH": path, "PATH": f"{command.parent}{os.pathsep}{kept['PATH']}",
        "HOME": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path / "cache"), "MPLCONFIGDIR": str(tmp_path / "mpl"),
    }  # fmt: skip


def test_the_documents_have_commands_and_code() -> None:
    assert ROOT / "README.md" in with_language("sh")
    assert with_language("python")


@pytest.mark.parametrize("document", with_language("sh"), ids=lambda p: p.name)
def test_every_command_runs(document: Path, elsewhere: Path, surroundings: dict[str, str]) -> None:
    for command in commands(document):
        if command.split()[0] in NOT_RUN:
            continue
        run = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", command],
            cwd=elsewhere, env=surroundings, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
        )  # fmt: skip
        assert run.returncode == 0, f"{document.name}: {command}\n{run.stdout[-2000:]}\n{run.stderr[-2000:]}"


@pytest.mark.parametrize("document", with_language("sh"), ids=lambda p: p.name)
def test_every_command_that_is_not_run_names_something_real(document: Path) -> None:
    targets = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    extras = set(re.findall(r"^(\w+) = \[", (ROOT / "pyproject.toml").read_text(encoding="utf-8"), re.MULTILINE))
    for command in commands(document):
        words = shlex.split(command, comments=True)
        if words[0] == "make":
            assert {word for word in words[1:] if "=" not in word} <= targets, command
        if "pip" in words and (asked := re.search(r"\[([\w,]+)\]", command)):
            assert set(asked.group(1).split(",")) <= extras, command


@pytest.mark.parametrize("document", with_language("python"), ids=lambda p: p.name)
def test_every_python_example_runs(document: Path, elsewhere: Path, surroundings: dict[str, str]) -> None:
    """All blocks of a document are one program."""
    run = subprocess.run(
        [sys.executable, "-c", "\n".join(blocks(document, "python"))],
        cwd=elsewhere, env=surroundings, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
    )  # fmt: skip
    assert run.returncode == 0, f"{document.name}\n{run.stdout[-2000:]}\n{run.stderr[-2000:]}"


def tables(head: str) -> list[str]:
    """First cells of the README's table that begins with `head`."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    rows = text[text.index(head) :].split("\n\n")[0].split("\n")[2:]
    return [name for row in rows for name in re.findall(r"`([\w./]+)`", row.split("|")[1])]


def test_the_table_of_commands_is_the_program_s() -> None:
    from scorebreath_cli.app import app

    known = {command.name or getattr(command.callback, "__name__", "") for command in app.registered_commands}
    assert set(tables("| command |")) == {name.rstrip("_") for name in known}


def test_the_table_of_columns_names_channels() -> None:
    from scorebreath.curves.channels import CHANNELS

    assert set(tables("| column |")) == {channel.name for channel in CHANNELS} - {"neck_pitch"}  # part of head_pitch


def test_the_table_of_files_names_what_render_writes() -> None:
    from scorebreath_cli.outputs import SET_FILES

    assert set(tables("| file |")) == {*SET_FILES, "speech/"}
