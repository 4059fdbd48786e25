"""What every number in a Score obeys: finite, on the 1e-6 grid, never -0.0, within 1e9."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from functools import cache
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, TypeVar, get_type_hints

import numpy as np
from pydantic import Strict

from scorebreath.errors import ScoreError
from scorebreath.units import plain, snap, snap_array

Number = Annotated[float, Strict()]
"""A number on the grid."""
Whole = Annotated[int, Strict()]
"""An integer."""
Flag = Annotated[bool, Strict()]
"""True or false, nothing that merely looks like it."""

LARGEST = 1e9
WIDEST = (-LARGEST, LARGEST)
"""Limits of a number that has no narrower ones."""
Limits = Mapping[str, tuple[float, float]]


def limits(**named: tuple[float, float]) -> Limits:
    """Limits of some fields, as a class holds them."""
    return MappingProxyType(named)


FORWARD = (0.0, LARGEST)
"""Limits of a time or a length."""
SHARE = (0.0, 1.0)
_FLOATS = frozenset({float})
T = TypeVar("T")


def per_class(make: Callable[[Any], T]) -> Callable[[Any], T]:
    """Work out once for each class what depends on the class alone."""
    return cache(make)


class Gridded:
    """Base of everything in a Score: refuses numbers that a save and a load would change."""

    __slots__ = ()
    limits: ClassVar[Limits] = MappingProxyType({})
    """lowest and highest value of fields that have them; those of base classes hold too"""

    def __post_init__(self) -> None:
        """Check every number and every array of numbers.

        Raises:
            ScoreError: A number is not finite, off the grid, -0.0, or outside its limits (1e9 where none are named).
        """
        for name in _numbers(type(self)):
            value = getattr(self, name)
            if value is None:
                continue
            if type(value) is not float:  # an int is written without a point, and would come back as a float
                value = float(value)
                object.__setattr__(self, name, value)
            if not _on_grid(value):
                raise ScoreError(f"{type(self).__name__}.{name}={value!r} must be {_expected(type(self), name, value)}")
        for name, (low, high) in limits_of(type(self)).items():
            value = getattr(self, name)
            if value is not None and not low <= value <= high:
                raise ScoreError(f"{type(self).__name__}.{name}={value!r} must be {_within(low, high)}")
        for name in _series(type(self)):
            given = getattr(self, name)
            if not _FLOATS.issuperset(map(type, given)):
                object.__setattr__(self, name, tuple(float(value) for value in given))
            values = np.asarray(given, dtype=np.float64)
            if values.size and not (
                np.all(np.abs(values) <= LARGEST)
                and np.array_equal(snap_array(values), values)
                and not np.any(np.signbit(values) & (values == 0))
            ):
                raise ScoreError(
                    f"{type(self).__name__}.{name} must hold finite multiples of 1e-6 (no -0.0) {_within(*WIDEST)}"
                )


@per_class
def limits_of(kind: Any) -> Mapping[str, tuple[float, float]]:
    """All limits of a class, its own and its bases'."""
    return {name: pair for base in reversed(kind.__mro__) for name, pair in vars(base).get("limits", {}).items()}


def _expected(kind: Any, name: str, value: float) -> str:
    """What a number that is refused should have been."""
    if math.isfinite(value) and abs(value) > LARGEST:
        return _within(*limits_of(kind).get(name, WIDEST))
    return "a finite multiple of 1e-6 (not -0.0)"


def _within(low: float, high: float) -> str:
    return f"in [{plain(low)}, {plain(high)}]"


def _on_grid(value: float) -> bool:
    return -LARGEST <= value <= LARGEST and snap(value) == value and (value != 0 or math.copysign(1.0, value) > 0)


@per_class
def _hints(kind: Any) -> dict[str, Any]:
    return get_type_hints(kind, include_extras=True)


@per_class
def _numbers(kind: Any) -> tuple[str, ...]:
    wanted = (Number, Number | None)
    return tuple(f.name for f in dataclasses.fields(kind) if _hints(kind)[f.name] in wanted)


@per_class
def _series(kind: Any) -> tuple[str, ...]:
    return tuple(f.name for f in dataclasses.fields(kind) if _hints(kind)[f.name] == tuple[Number, ...])
