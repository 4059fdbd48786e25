"""The engines: each an executable with scsynth's flags, and how to get it where it is missing."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Protocol

from scorebreath.errors import EngineError, InputError

DEFAULT = "embedded"
VARIABLE = "SCOREBREATH_SCSYNTH"
"""Environment variable that names an external scsynth."""
_ANSWER = 20.0  # s to say its version
_USUAL_PLACES = (
    "/Applications/SuperCollider.app/Contents/Resources/scsynth",
    r"C:\Program Files\SuperCollider\scsynth.exe",
)


class Engine(Protocol):
    """Something that plays SuperCollider's instruments."""

    @property
    def name(self) -> str:
        """What it is asked for by."""

    @property
    def about(self) -> str:
        """What it is, in one line."""

    @property
    def remedy(self) -> str:
        """How to get it."""

    def command(self) -> tuple[str, ...]:
        """The executable and its first arguments; scsynth's flags follow.

        Raises:
            EngineError: It is not installed; the message says how to get it.
        """

    def version(self) -> str:
        """What it says it is.

        Raises:
            EngineError: It is not installed, or does not answer.
        """


@dataclass(frozen=True, slots=True, kw_only=True)
class Embedded:
    """SuperCollider's engine inside a Python wheel, in a process of its own."""

    name: str = DEFAULT
    about: str = "SuperCollider's engine from the nanosynth wheel"
    remedy: str = (
        "pip install nanosynth==0.5.0 (Linux x86_64, macOS arm64, Windows x64); elsewhere install SuperCollider"
        " and use --engine scsynth"
    )

    def command(self) -> tuple[str, ...]:
        """This Python on the look-alike's file: nothing of this package is loaded there."""
        if importlib.util.find_spec("nanosynth") is None:
            raise EngineError(f"the embedded engine is not installed: {self.remedy}")
        return (sys.executable, "-P", str(Path(__file__).with_name("lookalike.py")))

    def version(self) -> str:
        """Version of the wheel."""
        self.command()
        return f"nanosynth {importlib.metadata.version('nanosynth')}"


@dataclass(frozen=True, slots=True, kw_only=True)
class External:
    """An installed scsynth."""

    path: str | None = None
    """the executable; None: the variable SCOREBREATH_SCSYNTH, then PATH"""
    name: str = "scsynth"
    about: str = "an installed SuperCollider"
    remedy: str = (
        f"apt install supercollider-server, or https://supercollider.github.io; then PATH, {VARIABLE}=FILE or"
        " --engine scsynth:FILE name the executable"
    )

    def command(self) -> tuple[str, ...]:
        """Where it is."""
        asked = self.path or os.environ.get(VARIABLE)
        if asked:
            found = shutil.which(asked)
            if found is None:
                raise EngineError(f"{asked!r} is not an executable file: {self.remedy}")
            return (found,)
        for place in ("scsynth", *_USUAL_PLACES):
            if found := shutil.which(place):
                return (found,)
        raise EngineError(f"scsynth is not installed: {self.remedy}")

    def version(self) -> str:
        """First line of `scsynth -v`."""
        command = [*self.command(), "-v"]
        try:
            said = subprocess.run(
                command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=_ANSWER,
                encoding="utf-8", errors="replace", check=False,
            ).stdout.strip()  # fmt: skip
        except (OSError, subprocess.TimeoutExpired) as error:
            raise EngineError(f"{command[0]!r} does not answer: {error}") from None
        if not said.startswith(("scsynth", "supernova")):
            raise EngineError(f"{command[0]!r} is not a SuperCollider server", said.splitlines()[:5])
        return said.splitlines()[0]


ENGINES: Mapping[str, Callable[[str | None], Engine]] = MappingProxyType(
    {"embedded": lambda _: Embedded(), "scsynth": lambda path: External(path=path)}
)
"""Engines by name; `NAME:FILE` gives the executable."""


def engine_named(name: str) -> Engine:
    """The engine of that name, installed or not.

    Args:
        name: `embedded`, `scsynth`, or `scsynth:FILE`.

    Raises:
        InputError: There is no such engine.
    """
    kind, _, path = name.partition(":")
    if kind not in ENGINES or (path and kind == "embedded"):
        raise InputError(f"engine={name!r} must be one of {', '.join(ENGINES)}, or scsynth:FILE")
    return ENGINES[kind](path or None)
