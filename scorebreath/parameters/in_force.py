"""What holds for every parameter, whether somebody set it or it follows from others."""

from __future__ import annotations

from scorebreath.parameters.derive import derive
from scorebreath.parameters.faces import face
from scorebreath.parameters.physique import physique
from scorebreath.parameters.table import Parameters


def in_force(p: Parameters) -> dict[str, float | str | bool]:
    """The value of every parameter: as it was set, or as it is derived.

    Raises:
        ParameterError: The equation for vital capacity does not hold for this age.

    >>> in_force(Parameters(height=165.0))["vocal_tract_length"]
    16.07
    """
    sources = p, derive(p), face(p), physique(p)
    found = {}
    for name in Parameters.model_fields:
        known = (getattr(source, name, None) for source in sources)
        found[name] = next(value for value in known if value is not None)
    return found
