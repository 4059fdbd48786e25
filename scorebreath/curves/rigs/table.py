"""Rigs from TOML: the tables beside this file, and anybody's own.

    about = "..."            like = "arkit"        names = "pascal"      order = ["eyeBlinkLeft", ...]
    [units]                  rad = 0.0174533       what a factor in the file is multiplied by, for columns of that unit
    [defaults]               of every column: low, high, unit, negative
    [columns]                jawOpen = { from = { mouth = 1.0 }, low = 0, high = 1, unit = "", negative = "clip" }
                             `from` names channels, drivers, or products of two: "jaw_open * lip_round"
    [emotions.happy]         "mouthSmile*" = 0.7   `*` is Left and Right, or _left and _right, or _l_ and _r_
    [closure]                mouthFunnel = 1.0     share that the closure gate takes; mouthClose = "jawOpen": equals
                             that column where lips shut; "high": its own highest value
    [yields]                 eyeWideLeft = "shut_left"    the driver that takes a column's emotions away

A table that is `like` another begins with that one's rows; `order` picks and sorts them, `names` writes them otherwise.
"""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from functools import cache
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType
from typing import Any, get_args

from scorebreath.curves.channels import CHANNELS
from scorebreath.curves.rigs.drivers import DRIVERS
from scorebreath.curves.rigs.rig import HIGH, Column, Negative, Rig, factors
from scorebreath.errors import InputError, did_you_mean
from scorebreath.score.acting import EMOTIONS

RIGS = ("arkit", "livelink", "oculus", "fap", "muscles")
"""Ours, in the order in which they are listed."""
SECTIONS = (
    "about", "signs", "like", "names", "order", "units", "defaults", "columns", "emotions", "closure", "yields",
)  # fmt: skip
KEYS = ("from", "low", "high", "unit", "negative")
SIDES = (("Left", "Right"), ("_left", "_right"), ("_l_", "_r_"))
LARGEST = 1e9
"""What no number of a table exceeds, so that no sum overflows."""
Table = dict[str, Any]


def rig_named(name: str) -> Rig:
    """One of `RIGS`, or the rig in a TOML file.

    Args:
        name: A name, or a path that ends with `.toml`.

    Raises:
        InputError: There is no such rig, or its table is broken.
    """
    if name in RIGS:
        return _ours(name)
    if not name.endswith(".toml"):
        raise InputError(
            f"no rig is called {name!r} (there are {', '.join(RIGS)}, and .toml files){did_you_mean(name, RIGS)}"
        )
    try:
        text = Path(name).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"the rig {name!r} cannot be read: {error}") from None
    return read_rig(Path(name).stem, text)


@cache
def _ours(name: str) -> Rig:
    return replace(read_rig(name, _text(name)), kind=name)


def _text(name: str) -> str:
    return (files("scorebreath.curves.rigs") / f"{name}.toml").read_text("utf-8")


def read_rig(name: str, text: str) -> Rig:
    """A rig from its TOML table.

    Args:
        name: What it is called.
        text: As described above.

    Raises:
        InputError: It is no TOML, or says what no rig says; the message names the rig and the row.
    """
    document = _document(name, text)
    known = {*(channel.name for channel in CHANNELS), *DRIVERS}
    columns = _rows(name, document, "columns")
    order = document.get("order", list(columns))
    if not isinstance(order, list):
        raise InputError(f"rig {name}: order = {order!r}; expected a list of columns")
    _known(name, "order", order, columns)
    for place, each in enumerate(order):
        if each in order[:place]:
            raise InputError(f"rig {name}: order names {each!r} twice; expected each column once")
        if not each or each == "time" or not each.isprintable() or set(each) & set(',"'):
            raise InputError(f"rig {name}: column {each!r}: expected a name without commas or quotes, and not 'time'")
    for unit, factor in _rows(name, document, "units").items():
        if _number(name, f"units: {unit}", factor) <= 0.0:
            raise InputError(f"rig {name}: units: {unit} = {factor}; expected a number above 0")
    names = document.get("names", "")
    table = tuple(_renamed(name, names, _column(name, each, document, known)) for each in order)
    if not table:
        raise InputError(f"rig {name}: [columns] is empty; expected at least one")
    for column in table:
        if column.shuts == column.name:
            raise InputError(f"rig {name}: closure: {column.name} cannot equal itself; expected another column")
        if column.shuts not in ("", HIGH, *(each.name for each in table)):
            raise InputError(f"rig {name}: {column.name} closes {column.shuts}, which order leaves out; expected both")
    return Rig(
        name=name, about=str(document.get("about", "")), signs=str(document.get("signs", "")), table=table,
        kind=_kind(document.get("like", ""), table),
    )  # fmt: skip


def _kind(like: str, table: Sequence[Column]) -> str:
    """The rig that a table is like, if it still has its columns and units."""
    if like and [(each.name, each.unit) for each in table] == [(each.name, each.unit) for each in _ours(like).table]:
        return like
    return ""


def _document(name: str, text: str) -> Table:
    try:
        own = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"rig {name}: no TOML: {error}") from None
    _known(name, "section", own, SECTIONS)
    for section in ("columns", "emotions", "closure", "yields", "units", "defaults"):
        _rows(name, own, section)
    for emotion in _known(name, "emotions", own.get("emotions", {}), EMOTIONS):
        _rows(name, own["emotions"], emotion)
    if "like" not in own:
        return own
    if own["like"] not in RIGS:
        raise InputError(f"rig {name}: like = {own['like']!r}; expected one of {', '.join(RIGS)}")
    base = _document(own["like"], _text(own["like"]))
    merged = base | own
    for section in ("columns", "closure", "yields", "units", "defaults"):
        merged[section] = base.get(section, {}) | own.get(section, {})
    felt = base.get("emotions", {}), own.get("emotions", {})
    merged["emotions"] = {each: felt[0].get(each, {}) | felt[1].get(each, {}) for each in (*felt[0], *felt[1])}
    return merged


def _column(rig: str, name: str, document: Table, known: Collection[str]) -> Column:
    row = _rows(rig, document["columns"], name)
    _known(rig, f"{name}: key", row, KEYS)
    row = {"low": 0.0, "high": 1.0, "unit": "", "negative": "clip"} | document.get("defaults", {}) | row
    if row["negative"] not in get_args(Negative):
        raise InputError(f"rig {rig}: {name}: negative = {row['negative']!r}; expected {', '.join(get_args(Negative))}")
    scale = _number(rig, f"units {row['unit']}", document.get("units", {}).get(row["unit"], 1.0))
    parts = _rows(rig, row, "from")
    _known(rig, f"{name}: from", [each for part in parts for each in factors(part)], known)
    if any(len(factors(part)) > 2 for part in parts):
        raise InputError(f"rig {rig}: {name}: from: expected products of two at most")
    emotions = {
        emotion: scale * _number(rig, f"{emotion}: {each}", weight)
        for emotion, weights in document.get("emotions", {}).items()
        for each, weight in weights.items()
        if name in _both(rig, emotion, each, document["columns"])
    }
    low, high = (_number(rig, f"{name}: {key}", row[key]) for key in ("low", "high"))
    if low >= high:
        raise InputError(f"rig {rig}: {name}: low = {low:g} must be below high = {high:g}")
    gate = _of_column(rig, "closure", name, document, 0.0)
    if not isinstance(gate, str) and not 0 <= _number(rig, f"closure: {name}", gate) <= 1:
        raise InputError(f"rig {rig}: closure: {name} = {gate} must be in [0, 1]")
    yields = _of_column(rig, "yields", name, document, "")
    if yields:
        _known(rig, f"yields: {name}", [yields], DRIVERS)
    if isinstance(gate, str):
        _known(rig, f"closure: {name}", [gate], {HIGH, *document["columns"]})
    return Column(
        name=name, unit=str(row["unit"]), low=low * scale, high=high * scale, negative=row["negative"],
        parts=MappingProxyType({each: scale * _number(rig, f"{name}: {each}", parts[each]) for each in parts}),
        emotions=MappingProxyType(emotions), gate=0.0 if isinstance(gate, str) else float(gate),
        shuts=gate if isinstance(gate, str) else "", yields=yields,
    )  # fmt: skip


def _of_column(rig: str, section: str, name: str, document: Table, default: Any) -> Any:
    """What a section says of a column; a name without `*` goes before one with it."""
    rows = document.get(section, {})
    if name in rows:
        return rows[name]
    for each, value in rows.items():
        if name in _both(rig, section, each, document["columns"]):
            return value
    return default


def _both(rig: str, where: str, name: str, columns: Collection[str]) -> tuple[str, ...]:
    """The columns that a name stands for."""
    if name in columns:
        return (name,)
    for sides in SIDES if name.count("*") == 1 else ():
        found = tuple(name.replace("*", side) for side in sides)
        if all(each in columns for each in found):
            return found
    raise InputError(f"rig {rig}: {where}: no column is called {name!r}{did_you_mean(name, columns)}")


def _renamed(rig: str, names: Any, column: Column) -> Column:
    """The column as `names` writes it."""
    if names not in ("", "pascal"):
        raise InputError(f"rig {rig}: names = {names!r}; expected pascal")
    if not names:
        return column
    shuts = column.shuts if column.shuts == HIGH else _pascal(column.shuts)
    return replace(column, name=_pascal(column.name), shuts=shuts)


def _pascal(name: str) -> str:
    return name[:1].upper() + name[1:]


def _rows(rig: str, document: Mapping[str, Any], section: str) -> Table:
    rows = document.get(section, {})
    if not isinstance(rows, dict):
        raise InputError(f"rig {rig}: {section} = {rows!r}; expected a table")
    return rows


def _known(rig: str, what: str, names: Any, known: Collection[str]) -> Any:
    if not isinstance(names, dict | list):
        raise InputError(f"rig {rig}: {what} = {names!r}; expected a table")
    for name in names:
        if name not in known:
            raise InputError(f"rig {rig}: {what} {name!r} is unknown{did_you_mean(str(name), known)}")
    return names


def _number(rig: str, what: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) <= LARGEST:
        raise InputError(f"rig {rig}: {what} = {value!r}; expected a number, at most {LARGEST:.0e}")
    return float(value)
