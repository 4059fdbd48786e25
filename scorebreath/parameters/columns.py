"""What persons and states may change: the columns of `states.toml` and `persons.toml`, and how they add up."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from types import MappingProxyType
from typing import Any, Literal

Kind = Literal["factor", "shift", "frequency"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """One quantity of `Modifiers`, as tables give it."""

    kind: Kind
    """`factor`: 1 + sum of intensity x (value - 1); `shift`: the neutral value + sum of intensity x (value - neutral);
    `frequency`: values are intervals, 0 for never; how often adds up, and beyond `high` is never"""
    neutral: float
    low: float
    high: float


def _factor(low: float, high: float) -> Column:
    return Column(kind="factor", neutral=1.0, low=low, high=high)


def _shift(neutral: float, low: float, high: float) -> Column:
    return Column(kind="shift", neutral=neutral, low=low, high=high)


COLUMNS: Mapping[str, Column] = MappingProxyType(
    {
        "syllables": _factor(0.15, 2.0),
        "inspiration": _factor(0.4, 2.5),
        "volume": _factor(0.4, 3.0),
        "start": _shift(0.0, -0.20, 0.25),
        "pause": _factor(0.3, 3.0),
        "delay": _factor(0.3, 4.0),
        "thorax_share": _shift(0.65, 0.0, 1.0),
        "nose_share": _shift(0.35, 0.0, 1.0),
        "breath_db": _shift(0.0, -20.0, 20.0),
        "variation": _shift(0.15, 0.0, 0.6),
        "brightness": _factor(0.5, 2.0),
        "flare": _factor(0.0, 6.0),
        "tremor": _shift(0.0, 0.0, 0.2),
        "rate": _factor(0.4, 4.0),
        "depth": _factor(0.3, 6.0),
        "fraction": _shift(0.40, 0.20, 0.65),
        "rest_pause": _shift(0.3, 0.0, 2.0),
        "sigh_interval": Column(kind="frequency", neutral=0.0, low=10.0, high=7200.0),
        "hold_chance": _shift(0.0, 0.0, 1.0),
        "hold_length": _shift(0.5, 0.1, 2.0),
        "gasp_chance": _shift(0.0, 0.0, 1.0),
        "saccades": _shift(1.0, 1.0, 5.0),
        "laugh_chance": _shift(0.0, 0.0, 1.0),
        "puff_chance": _shift(0.0, 0.0, 1.0),
        "exhale_chance": _shift(0.0, 0.0, 1.0),
    }
)
"""By the field of `Modifiers`; low and high bound whatever persons and states add up to."""


def deviations(values: Mapping[str, Any], where: str) -> dict[str, float]:
    """A row's values as what they add at full intensity.

    Args:
        values: Numbers by column; a column that is left out is neutral.
        where: The row's name, for the error.

    Raises:
        ValueError: A column does not exist, or a value is no number within its bounds (our tables: a bug).
    """
    added: dict[str, float] = {}
    for name, value in values.items():
        column = COLUMNS.get(name)
        if column is None or type(value) not in (int, float):
            raise ValueError(f"{where}: {name}={value!r} is no column with a number")
        if not column.low <= value <= column.high:
            raise ValueError(f"{where}: {name}={value} must be in [{column.low}, {column.high}]")
        added[name] = 1.0 / value if column.kind == "frequency" else value - column.neutral
    return added


def read_table(name: str) -> dict[str, dict[str, Any]]:
    """Rows of one of this folder's TOML tables, in its order."""
    return tomllib.loads((files("scorebreath.parameters") / name).read_text("utf-8"))
