"""Mapping files: TOML, one table `[[control]]` a control."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping as Table
from pathlib import Path
from types import MappingProxyType
from typing import Any

from scorebreath.errors import EnvironmentFailure, InputError, did_you_mean, shortened
from scorebreath.live.controls.mapping import SOURCES, Control, Mapping, Source
from scorebreath.units import plain

LARGEST_FILE = 1_000_000
"""bytes"""
LARGEST_NUMBER = 2**31
KEYS: Table[str, tuple[type, ...]] = MappingProxyType(
    {
        "channel": (int,), "cc": (int,), "cc14": (int,), "note": (int,), "pressure": (bool,), "bend": (bool,),
        "parameter": (str,), "command": (str,), "say": (str,), "low": (int, float), "high": (int, float),
        "curve": (str,), "takeover": (bool,), "body": (str,),
    }
)  # fmt: skip
"""Key of a control: the kinds of value that it takes."""
_KINDS = {int: "a whole number", float: "a number", bool: "true or false", str: "a text"}


def read_mapping(path: Path) -> Mapping:
    """The mapping in a file.

    Raises:
        InputError: It cannot be read, is no TOML, or has a key or value that is not understood; names file and place.
    """
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if len(data) > LARGEST_FILE:
        raise InputError(f"{path}: larger than any mapping ({LARGEST_FILE} bytes)")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start}: not UTF-8") from None
    return loads_mapping(text, str(path))


def loads_mapping(text: str, file: str = "mapping") -> Mapping:
    """The mapping in a text of TOML.

    Raises:
        InputError: As `read_mapping`.
    """
    try:
        document = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # a number with thousands of digits is a ValueError only
        raise InputError(f"{file}: {error}") from None
    if unknown := sorted(set(document) - {"control"}):
        raise InputError(f"{file}: {shortened(unknown[0], 40)!r} is not understood; expected tables [[control]]")
    rows = document.get("control", [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise InputError(f"{file}: expected tables [[control]]")
    controls: list[Control] = []
    for number, row in enumerate(rows, 1):
        try:
            controls.append(_control(row))
        except InputError as error:
            raise InputError(f"{file}: control {number}: {error}") from None
    try:
        return Mapping(tuple(controls))
    except InputError as error:
        raise InputError(f"{file}: {error}") from None


def dumps_mapping(mapping: Mapping) -> str:
    """The mapping as TOML, which `loads_mapping` reads back equal."""
    return "\n".join("".join(f"{line}\n" for line in _lines(control)) for control in mapping.controls)


def write_mapping(mapping: Mapping, path: Path) -> None:
    """Write the mapping; the file is there as a whole or stays as it was.

    Raises:
        EnvironmentFailure: The disk refuses.
    """
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        part.write_text(dumps_mapping(mapping), encoding="utf-8", newline="\n")
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise EnvironmentFailure(f"{path}: cannot be written: {error.strerror}") from None


def _control(row: Table[str, Any]) -> Control:
    for key, value in row.items():
        if key not in KEYS:
            raise InputError(f"{shortened(key, 40)!r} is not understood{did_you_mean(key[:40], KEYS)}")
        right = isinstance(value, KEYS[key]) and (not isinstance(value, bool) or bool in KEYS[key])
        if not right or (isinstance(value, int) and abs(value) > LARGEST_NUMBER):
            raise InputError(f"{key}={shortened(str(value), 40)}, expected {_KINDS[KEYS[key][-1]]}")
    named: list[Source] = [source for source in SOURCES if source in row]
    if len(named) != 1:
        raise InputError(f"expected exactly one of {', '.join(SOURCES)}")
    (source,) = named
    if SOURCES[source] is None and not row[source]:
        raise InputError(f"{source}=false, expected true")
    if row.get("channel") == 0:
        raise InputError("channel=0 must be a number in [1, 16]; without one, any channel")
    others = {key: value for key, value in row.items() if key not in SOURCES}
    return Control(source=source, number=0 if SOURCES[source] is None else row[source], **others)


def _lines(control: Control) -> list[str]:
    lines = ["[[control]]"]
    if control.channel:
        lines.append(f"channel = {control.channel}")
    lines.append(f"{control.source} = {'true' if SOURCES[control.source] is None else control.number}")
    lines += [f"{key} = {_quoted(text)}" for key in ("parameter", "command", "say") if (text := getattr(control, key))]
    if control.low is not None:
        lines.append(f"low = {_number(control.low)}")
    if control.high is not None:
        lines.append(f"high = {_number(control.high)}")
    if control.curve != "linear":
        lines.append(f"curve = {_quoted(control.curve)}")
    if not control.takeover:
        lines.append("takeover = false")
    if control.body:
        lines.append(f"body = {_quoted(control.body)}")
    return lines


def _number(value: float) -> str:
    return plain(value) if float(plain(value)) == value else repr(float(value))


def _quoted(text: str) -> str:
    """A basic string of TOML: quotes, backslashes and what is no character escaped."""
    named = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    escaped = (named.get(c) or (f"\\u{ord(c):04X}" if ord(c) < 32 or ord(c) == 127 else c) for c in text)
    return f'"{"".join(escaped)}"'
