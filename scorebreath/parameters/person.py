"""How much of each row of `persons.toml` a person is, and what those rows do (physiology 1.5)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from math import log10
from types import MappingProxyType
from typing import Any

from scorebreath.parameters.columns import deviations, read_table
from scorebreath.parameters.table import Parameters

LOUD_DB, SOFT_DB, LIMIT_DB = 8.0, -6.0, 12.0
"""Levels that the rows `loud` and `soft` are for, and the one beyond which nothing more changes, dB."""
CHILD = (10.0, 16.0)
"""Years up to which somebody breathes as a child, and from which as an adult."""
AGED = (60.0, 75.0)
"""Years from which age begins to tell, and from which it does so fully."""

BY_HAND: Mapping[str, str] = MappingProxyType(
    {
        "syllables": "norm_syllables",
        "inspiration": "inspiration_base",
        "volume": "volume_per_syllable",
        "start": "termination_volume",
        "delay": "silence_after_breath",
        "rate": "resting_rate",
        "depth": "tidal_volume",
    }
)
"""Parameters that, set by hand, say it for this very person: age, posture and condition leave them alone."""


def person_weights(p: Parameters) -> dict[str, float]:
    """How much of each row applies, those that do not left out.

    >>> person_weights(Parameters(age=67.5, posture="supine"))
    {'aged': 0.5, 'supine': 1.0}
    >>> person_weights(Parameters())
    {}
    """
    weights = {
        "aged": _ramp(p.age, *AGED),
        "child": 1.0 - _ramp(p.age, *CHILD),
        p.condition: 1.0,
        p.posture: 1.0,
    }
    return {name: weight for name, weight in weights.items() if weight and name in _rows()}


def loudness_weights(p: Parameters) -> dict[str, float]:
    """The same for how loud somebody speaks.

    >>> loudness_weights(Parameters(speaking_loudness=50.0))
    {'soft': 1.00...}
    """
    decibel = min(LIMIT_DB, max(-LIMIT_DB, 20.0 * log10(p.speaking_loudness / 100.0)))
    if decibel > 0:
        return {"loud": decibel / LOUD_DB}
    return {"soft": decibel / SOFT_DB} if decibel < 0 else {}


def person_rows(p: Parameters) -> list[dict[str, float]]:
    """What each row that applies adds to the neutral speaker, by column; hand-set values are left alone."""
    found = [
        {c: v * weight for c, v in _rows()[name].items() if BY_HAND.get(c) not in p.model_fields_set}
        for name, weight in person_weights(p).items()
    ]
    found += [{c: v * weight for c, v in _rows()[name].items()} for name, weight in loudness_weights(p).items()]
    return found


@cache
def _rows() -> Mapping[str, Mapping[str, float]]:
    return MappingProxyType({name: _row(name, table) for name, table in read_table("persons.toml").items()})


def _row(name: str, table: Mapping[str, Any]) -> Mapping[str, float]:
    return MappingProxyType(deviations({key: value for key, value in table.items() if key != "source"}, name))


def _ramp(value: float, low: float, high: float) -> float:
    return min(1.0, max(0.0, (value - low) / (high - low)))
