"""Presets: named sets of parameters in TOML files, ours or the user's.

description = "what it is for"
source = "why these values"
[parameters]
nose_share = 0.5
"""

from __future__ import annotations

import difflib
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

from scorebreath.errors import ParameterError
from scorebreath.parameters.table import Parameters

LARGEST_FILE = 1 << 20


@dataclass(frozen=True, slots=True, kw_only=True)
class Preset:
    """A named set of parameters."""

    name: str
    description: str
    source: str
    """why these values"""
    values: Mapping[str, Any]


def names() -> tuple[str, ...]:
    """Presets that come with the package, sorted."""
    files = resources.files("scorebreath.parameters").joinpath("library").iterdir()
    return tuple(sorted(file.name.removesuffix(".toml") for file in files if file.name.endswith(".toml")))


def load_preset(name: str) -> Preset:
    """A preset by its name, or from a file of the user's by its path (`.toml`).

    Raises:
        ParameterError: There is none, the file is broken, or a value is wrong.
    """
    if name.endswith(".toml"):
        path = Path(name)
        try:
            with path.open("rb") as stream:
                data = stream.read(LARGEST_FILE + 1)
        except OSError as error:
            raise ParameterError(f"{name}: cannot be read: {error.strerror}") from None
        if len(data) > LARGEST_FILE:
            raise ParameterError(f"{name}: larger than any preset ({LARGEST_FILE} bytes)")
        return _read(data, path.stem, name)
    if name not in names():
        close = difflib.get_close_matches(name, names(), 1)
        hint = f"; did you mean {close[0]!r}?" if close else ""
        raise ParameterError(
            f"no preset is called {name!r}{hint} (there are {', '.join(names())}, or a path to a .toml)"
        )
    file = resources.files("scorebreath.parameters").joinpath("library").joinpath(f"{name}.toml")
    return _read(file.read_bytes(), name, name)


def _read(data: bytes, name: str, file: str) -> Preset:
    try:
        table = tomllib.loads(data.decode("utf-8"))
    except UnicodeDecodeError as error:
        raise ParameterError(f"{file}: byte {error.start}: not UTF-8") from None
    except tomllib.TOMLDecodeError as error:
        raise ParameterError(f"{file}: {error}") from None
    for key, value in table.items():
        kind = dict if key == "parameters" else str
        if key not in ("description", "source", "parameters") or not isinstance(value, kind):
            raise ParameterError(f"{file}: {key}: expected description and source (texts) and a table [parameters]")
    values = table.get("parameters", {})
    try:
        Parameters(**values)
    except ParameterError as error:
        raise ParameterError(f"{file}: {error}") from None
    return Preset(name=name, description=table.get("description", ""), source=table.get("source", ""), values=values)
