"""`NAME=VALUE` as people type it, checked against the table."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

from scorebreath.errors import ParameterError
from scorebreath.parameters.table import Parameters, bounds, choices

_FLAGS = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}


def parse_assignment(text: str) -> tuple[str, Any]:
    """Name and value of an assignment.

    Args:
        text: `NAME=VALUE`; numbers as `0.4`, flags as `true` or `false`, words in any case.

    Returns:
        Name and checked value.

    Raises:
        ParameterError: It has no `=`, the name is unknown, or the value is wrong.

    >>> parse_assignment("nose_share=0.4"), parse_assignment("breath_sound=off")
    (('nose_share', 0.4), ('breath_sound', False))
    >>> parse_assignment("sex=Female")
    ('sex', 'female')
    """
    name, equals, given = (part.strip() for part in text.partition("="))
    if not equals:
        raise ParameterError(f"{text!r}: expected NAME=VALUE, such as nose_share=0.4")
    name = name.replace("-", "_")
    value: Any = given
    if name in Parameters.model_fields:
        if Parameters.model_fields[name].annotation is bool:
            value = _FLAGS.get(given.lower(), given)
        elif given.lower() in choices(name):
            value = given.lower()
        elif bounds(name):
            with suppress(ValueError):  # what is no number is refused below, with the range
                value = float(given)
    return name, getattr(Parameters(**{name: value}), name)
