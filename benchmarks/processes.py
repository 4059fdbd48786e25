"""Programs run and timed."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from statistics import median
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
ENVIRONMENT = {
    **{name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"},
    "PYTHONPATH": os.pathsep.join(str(ROOT / part) for part in (".", "cli", "synthdefs")),
    "COLUMNS": "100",
    "SCOREBREATH_CACHE": "off",
}
"""As users have it: with modules compiled once, not at every start. Nothing is known from the time before."""
PROGRAM = (sys.executable, "-c", "from scorebreath_cli.main import main; main()")


def run(*command: object) -> str:
    """What a program prints; one that fails ends the benchmark with its words."""
    said = subprocess.run(
        [str(part) for part in command], env=ENVIRONMENT, cwd=ROOT, capture_output=True, text=True, check=False
    )
    if said.returncode:
        raise SystemExit(f"{' '.join(map(str, command[:6]))}: status {said.returncode}\n{said.stderr}")
    return said.stdout


def module(name: str, *arguments: object) -> Any:
    """What a module of the benchmarks prints as JSON."""
    return json.loads(run(sys.executable, "-m", f"benchmarks.{name}", *arguments))


def seconds(*command: object) -> float:
    """How long a program takes, from its start to its end."""
    started = time.perf_counter()
    run(*command)
    return time.perf_counter() - started


def interleaved(rounds: int, *measure: Callable[[], float]) -> tuple[float, ...]:
    """Medians of several measurements that take turns, so that whatever else the machine does meets them all."""
    taken = [[one() for one in measure] for _ in range(rounds)]
    return tuple(median(column) for column in zip(*taken, strict=True))


def quiet(folder: Path) -> Sequence[str]:
    """Arguments that render into a folder again and again."""
    return ("-o", str(folder), "--force")
