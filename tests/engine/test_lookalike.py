"""The embedded engine answers to scsynth's flags."""

from __future__ import annotations

import ast
import inspect
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from scorebreath.engine import lookalike
from scorebreath.engine.engines import Embedded

OFFLINE = ["-N", "in.osc", "_", "out.raw", "44100", "RAW", "float"]


class Recorder:
    """Stands for the engine's module."""

    def __init__(self) -> None:
        self.calls: list[tuple[str, dict[str, Any]]] = []

    def set_print_func(self, _: object) -> None:
        pass

    def world_nrt_render(self, **settings: Any) -> None:
        self.calls.append(("render", settings))

    def world_new(self, **settings: Any) -> str:
        self.calls.append(("new", settings))
        return "world"

    def world_open_udp(self, world: str, address: str, port: int) -> bool:
        self.calls.append(("open", {"world": world, "address": address, "port": port}))
        return port != 1

    def world_wait_for_quit(self, world: str, unload: bool) -> None:
        self.calls.append(("wait", {"world": world, "unload": unload}))


@pytest.fixture
def engine(monkeypatch: pytest.MonkeyPatch) -> Recorder:
    recorder = Recorder()
    monkeypatch.setattr(lookalike, "load", lambda: recorder)
    return recorder


def test_it_renders_with_the_flags_of_scsynth(engine: Recorder) -> None:
    assert lookalike.run([*OFFLINE, "-o", "1", "-i", "0", "-b", "2048", "-D", "0", "-V", "-1"]) == 0
    ((what, settings),) = engine.calls
    assert what == "render"
    assert Path(settings.pop("ugen_plugins_path")).is_dir()
    assert settings == {
        "cmd_filename": "in.osc", "output_filename": "out.raw", "sample_rate": 44100, "header_format": "RAW",
        "sample_format": "float", "num_output_bus_channels": 1, "num_input_bus_channels": 0, "num_buffers": 2048,
        "verbosity": -1,
    }  # fmt: skip


def test_an_input_file_is_passed_on(engine: Recorder) -> None:
    lookalike.run(["-N", "in.osc", "in.wav", *OFFLINE[3:]])
    assert engine.calls[0][1]["input_filename"] == "in.wav"


def test_it_serves_until_it_is_told_to_quit(engine: Recorder, capsys: pytest.CaptureFixture[str]) -> None:
    assert lookalike.run(["-u", "57123", "-o", "2", "-l", "4", "-R", "0", "-S", "48000"]) == 0
    assert [what for what, _ in engine.calls] == ["new", "open", "wait"]
    assert engine.calls[0][1].items() >= {
        "num_output_bus_channels": 2, "max_logins": 4, "rendezvous": False, "preferred_sample_rate": 48000,
        "realtime": True,
    }.items()  # fmt: skip
    assert engine.calls[1][1] == {"world": "world", "address": "127.0.0.1", "port": 57123}
    assert lookalike.READY in capsys.readouterr().out


def test_a_port_in_use_is_an_error(engine: Recorder, capsys: pytest.CaptureFixture[str]) -> None:
    assert lookalike.run(["-u", "1"]) == 1
    assert "ERROR: port 1" in capsys.readouterr().out
    assert lookalike.READY not in capsys.readouterr().out


@pytest.mark.parametrize("flags", [["-x", "1"], ["-o"], ["-o", "many"], OFFLINE[:4]])
def test_wrong_flags_are_refused(flags: list[str], engine: Recorder, capsys: pytest.CaptureFixture[str]) -> None:
    assert lookalike.run(flags) == 2
    assert "ERROR" in capsys.readouterr().out
    assert engine.calls == []


@pytest.mark.parametrize("start", [Embedded().command(), (sys.executable, "-m", "scorebreath.engine.lookalike")])
def test_it_runs_as_a_program(start: tuple[str, ...], root: Path) -> None:
    done = subprocess.run([*start, "-v"], capture_output=True, text=True, check=False, cwd=root)
    assert (done.returncode, done.stdout.startswith("scsynth")) == (0, True)


def test_a_failure_ends_the_process_at_once(tmp_path: Path) -> None:
    command = [*Embedded().command(), *OFFLINE]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path, timeout=30)
    assert done.returncode == 1
    assert "ERROR" in done.stdout


def test_it_imports_nothing_of_this_package() -> None:
    """It runs as a bare file, where the package need not be."""
    tree = ast.parse(inspect.getsource(lookalike))
    names = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    names |= {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    assert {name.partition(".")[0] for name in names if name} <= {*sys.stdlib_module_names, "nanosynth"}
