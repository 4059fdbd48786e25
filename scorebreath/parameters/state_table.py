"""The rows of `states.toml` (physiology 4.2), read once when first asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import Any, Literal, cast

from scorebreath.errors import InputError, did_you_mean
from scorebreath.parameters.columns import COLUMNS, deviations, read_table

NEUTRAL = "neutral"
_ANCHORS = {"half": 0.5, "full": 1.0}
"""Tables of a row, and the intensity that each is for."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StateRow:
    """A state that a body may be in: what it does to breathing at given intensities."""

    name: str
    kind: Literal["mood", "body"]
    """moods take each other's place, states of the body add up"""
    description: str
    source: str
    aliases: tuple[str, ...]
    """other words for it"""
    recovery: float
    """time constant with which it fades by itself, s; 0: it stays"""
    anchors: tuple[tuple[float, Mapping[str, float]], ...]
    """intensity, and the value of every column there, ascending; what is neutral at 0 goes in straight lines from one
    to the next"""
    added: tuple[tuple[float, Mapping[str, float]], ...]
    """the same as deviations from neutral, only those that are not 0"""

    def deviations(self, intensity: float) -> dict[str, float]:
        """What it adds to the neutral speaker at an intensity of 0..1, by column (`columns.COLUMNS`)."""
        low, before = 0.0, cast("Mapping[str, float]", {})
        for high, after in self.added:
            if intensity <= high or high == self.added[-1][0]:
                share = (intensity - low) / (high - low)
                names = before.keys() | after.keys()
                return {n: before.get(n, 0.0) * (1.0 - share) + after.get(n, 0.0) * share for n in names}
            low, before = high, after
        return {}


class _States(Mapping[str, StateRow]):
    """The table by canonical names, in its order; the file is read at the first look."""

    def __getitem__(self, name: str) -> StateRow:
        return _rows()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(_rows())

    def __len__(self) -> int:
        return len(_rows())


STATES: Mapping[str, StateRow] = _States()
"""Every state by its name, `neutral` first."""


def find_state(name: str) -> StateRow:
    """A state by its name or another word for it, in any case, with `-`, `_` or a space between words.

    Raises:
        InputError: There is no such state; names what may be meant.

    >>> find_state("Afraid").name, find_state("out of breath").name
    ('anxious', 'exertion')
    """
    key = "-".join(name.lower().replace("_", " ").replace("-", " ").split())
    known = _names()
    if key not in known:
        raise InputError(f"no state is called {name!r}{did_you_mean(key, known)} (there are {', '.join(_rows())})")
    return _rows()[known[key]]


@cache
def _names() -> Mapping[str, str]:
    names = {alias: row.name for row in _rows().values() for alias in row.aliases}
    return MappingProxyType(names | {name: name for name in _rows()})


@cache
def _rows() -> Mapping[str, StateRow]:
    return MappingProxyType({name: _row(name, table) for name, table in read_table("states.toml").items()})


def _row(name: str, table: Mapping[str, Any]) -> StateRow:
    neutral = {column: COLUMNS[column].neutral for column in COLUMNS}
    points = [(intensity, table[key]) for key, intensity in _ANCHORS.items() if key in table]
    added = [(intensity, deviations(values, name)) for intensity, values in points]
    return StateRow(
        name=name,
        kind=table["kind"],
        description=table["description"],
        source=table["source"],
        aliases=tuple(table.get("aliases", ())),
        recovery=float(table.get("recovery", 0.0)),
        anchors=tuple((intensity, MappingProxyType(neutral | values)) for intensity, values in points),
        added=tuple((i, MappingProxyType({n: v for n, v in row.items() if v})) for i, row in added),
    )
