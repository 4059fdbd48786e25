"""The one table of parameters: name, unit, range, default, meaning, source, OSC address, MIDI controller.

A low-level parameter whose default is None follows from the abstract ones (Eq. 1, `parameters.derive`) until it is
set by hand; from then on it stays, whatever its parent does, until it is reset.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Literal, Self, get_args, get_origin

from pydantic import ValidationError

from scorebreath.errors import ParameterError
from scorebreath.parameters.face_table import FaceTable
from scorebreath.units import plain

OSC_ROOT = "/scorebreath"


class Parameters(FaceTable):
    """Every parameter; immutable, checked, aware of what was set by hand (`model_fields_set`)."""

    def __init__(self, **values: Any) -> None:
        """Check names, types and ranges.

        Raises:
            ParameterError: Names the value, its name and its range.
        """
        try:
            super().__init__(**values)
        except ValidationError as error:
            first = error.errors()[0]
            raise ParameterError(_problem(str(first["loc"][0]), first.get("input"))) from None

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """A copy with some parameters set by hand; None resets one.

        Raises:
            ParameterError: A name or value is wrong.
        """
        kept = {name: getattr(self, name) for name in self.model_fields_set if name not in values}
        return type(self)(**kept, **{name: value for name, value in values.items() if value is not None})

    def set_by_hand(self) -> dict[str, Any]:
        """Name and value of every parameter that was set, sorted by name."""
        return {name: getattr(self, name) for name in sorted(self.model_fields_set)}


def osc_address(name: str) -> str:
    """OSC address of a parameter.

    >>> osc_address("nose_share")
    '/scorebreath/nose_share'
    """
    return f"{OSC_ROOT}/{name}"


def bounds(name: str) -> tuple[float, float] | None:
    """Lowest and highest value of a parameter, None for one that is no number.

    >>> bounds("nose_share")
    (0.0, 1.0)
    """
    low = high = math.nan
    for constraint in Parameters.model_fields[name].metadata:
        low = float(getattr(constraint, "ge", low))
        high = float(getattr(constraint, "le", high))
    return None if math.isnan(low) or math.isnan(high) else (low, high)


def choices(name: str) -> tuple[str, ...]:
    """The values of a parameter that is one of a few words; empty for all others.

    >>> choices("style"), choices("age")
    (('reading', 'spontaneous'), ())
    """
    kind = Parameters.model_fields[name].annotation
    return get_args(kind) if get_origin(kind) is Literal else ()


def _problem(name: str, value: object) -> str:
    if name not in Parameters.model_fields:
        import difflib

        close = difflib.get_close_matches(name, Parameters.model_fields, 1)
        return f"no parameter is called {name!r}" + (f"; did you mean {close[0]!r}?" if close else "")
    limits = bounds(name)
    if limits:
        return f"{name}={value!r} must be a number in [{plain(limits[0])}, {plain(limits[1])}]"
    return f"{name}={value!r} must be {' or '.join(map(repr, choices(name))) or 'true or false'}"
