"""Finding engines, naming them, and saying what is wrong with them."""

from __future__ import annotations

import importlib.util
import shutil
from importlib.machinery import ModuleSpec
from pathlib import Path

import pytest

from scorebreath.engine.check import check_engine, check_engines
from scorebreath.engine.engines import ENGINES, VARIABLE, External, engine_named
from scorebreath.errors import EngineError, InputError

needs_scsynth = [
    pytest.mark.scsynth,
    pytest.mark.skipif(shutil.which("scsynth") is None, reason="no scsynth on PATH"),
]


@pytest.mark.parametrize("name", ENGINES)
def test_every_engine_says_what_it_is_and_how_to_get_it(name: str) -> None:
    engine = engine_named(name)
    assert engine.name == name
    assert engine.about
    assert "install" in engine.remedy


@pytest.mark.parametrize("name", ["", "supernova", "embedded:/usr/bin/scsynth", "Scsynth"])
def test_an_unknown_engine_is_refused(name: str) -> None:
    with pytest.raises(InputError, match="must be one of embedded, scsynth, or scsynth:FILE"):
        engine_named(name)


def test_the_executable_can_be_named(tmp_path: Path) -> None:
    (tmp_path / "my-scsynth").write_text("#!/bin/sh\necho scsynth 9.9.9\necho more\n")
    (tmp_path / "my-scsynth").chmod(0o755)
    engine = engine_named(f"scsynth:{tmp_path / 'my-scsynth'}")
    assert engine.command() == (str(tmp_path / "my-scsynth"),)
    assert engine.version() == "scsynth 9.9.9"


def test_option_then_variable_then_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("one", "two", "scsynth"):
        (tmp_path / name).write_text("#!/bin/sh\n")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert External().command() == (str(tmp_path / "scsynth"),)
    monkeypatch.setenv(VARIABLE, str(tmp_path / "two"))
    assert External().command() == (str(tmp_path / "two"),)
    assert External(path=str(tmp_path / "one")).command() == (str(tmp_path / "one"),)


def test_without_scsynth_the_error_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setattr("scorebreath.engine.engines._USUAL_PLACES", ())
    with pytest.raises(EngineError, match="apt install supercollider-server"):
        External().command()
    report = check_engine("scsynth")
    assert (report.works, report.version) == (False, "")
    assert "not installed" in report.problem


def test_without_the_wheel_the_error_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    real = importlib.util.find_spec

    def hidden(name: str, package: str | None = None) -> ModuleSpec | None:
        return None if name == "nanosynth" else real(name, package)

    monkeypatch.setattr(importlib.util, "find_spec", hidden)
    report = check_engine("embedded")
    assert not report.works
    assert "pip install nanosynth" in report.problem


def test_a_server_that_does_not_answer_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "slow").write_text("#!/bin/sh\nsleep 5\n")
    (tmp_path / "slow").chmod(0o755)
    monkeypatch.setattr("scorebreath.engine.engines._ANSWER", 0.1)
    with pytest.raises(EngineError, match="does not answer"):
        External(path=str(tmp_path / "slow")).version()


@pytest.mark.parametrize("name", ["embedded", pytest.param("scsynth", marks=needs_scsynth)])
def test_an_installed_engine_is_heard(name: str) -> None:
    report = check_engine(name)
    assert (report.works, report.problem) == (True, "")
    assert report.version


def test_all_engines_are_checked() -> None:
    assert [report.name for report in check_engines()] == list(ENGINES)
