"""Running the program, inside this process or outside it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from typer.testing import CliRunner, Result

from scorebreath_cli.app import app

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = (sys.executable, "-c", "from scorebreath_cli.main import main; main()")
ENVIRONMENT = {
    **os.environ,
    "PYTHONPATH": os.pathsep.join(str(ROOT / part) for part in (".", "cli", "synthdefs")),
    "COLUMNS": "100",
    "TERM": "dumb",
}


def run(*arguments: object, text: str | bytes | None = None) -> Result:
    """The program in this process."""
    return CliRunner().invoke(app, [str(a) for a in arguments], input=text, prog_name="scorebreath")


def spawn(*arguments: object, **options: Any) -> subprocess.CompletedProcess[bytes]:
    """The program as its users start it."""
    options.setdefault("capture_output", True)
    return subprocess.run(
        [*PROGRAM, *(str(a) for a in arguments)], env=ENVIRONMENT, timeout=120, check=False, **options
    )


def events(lines: str | bytes) -> list[dict[str, Any]]:
    """What `--json` told."""
    found: list[dict[str, Any]] = [json.loads(line) for line in lines.splitlines()]
    assert all(event["schema"] == "scorebreath.event/1" and event["event"] for event in found)
    return found
