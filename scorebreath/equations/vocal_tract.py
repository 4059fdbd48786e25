"""How long a person's vocal tract is (physiology 3.4)."""

from __future__ import annotations

from math import log
from typing import Literal

CHILD_HEIGHT, CHILD_LENGTH = 128.0, 12.0
"""cm: a child of 8 years (Fitch & Giedd 1999, physiology 3.4)."""
WOMAN_HEIGHT, WOMAN_LENGTH = 165.0, 14.5
MAN_HEIGHT, MAN_LENGTH = 178.0, 17.0
DESCENT = (10.0, 17.0)
"""Years in which a boy's larynx descends."""

_GROWTH = log(WOMAN_LENGTH / CHILD_LENGTH) / log(WOMAN_HEIGHT / CHILD_HEIGHT)


def vocal_tract_length(sex: Literal["male", "female"], age: float, height: float) -> float:
    r"""From the lips to the larynx, cm (physiology 3.4; Fitch & Giedd 1999).

    Three measured lengths (man 17.0, woman 14.5, child of 8 years 12.0 cm), and an interpolation of ours between them:
    the tract grows with height as :math:`12.0\,(H / 128)^{0.745}`, which meets child and woman; boys add what the
    larynx's descent gives, 10.8 % in a man, by a smooth step from 10 to 17 years.

    Args:
        sex: After puberty men's larynx stands lower.
        age: Years.
        height: :math:`H`, cm.

    >>> [round(vocal_tract_length(*who), 2) for who in (("male", 30, 178), ("female", 30, 165), ("female", 8, 128))]
    [17.0, 14.5, 12.0]
    >>> vocal_tract_length("male", 8, 128) == vocal_tract_length("female", 8, 128)
    True
    """
    grown: float = CHILD_LENGTH * (height / CHILD_HEIGHT) ** _GROWTH
    if sex == "female":
        return grown
    man: float = MAN_LENGTH / (CHILD_LENGTH * (MAN_HEIGHT / CHILD_HEIGHT) ** _GROWTH)
    start, end = DESCENT
    share = min(1.0, max(0.0, (age - start) / (end - start)))
    return grown * (1.0 + (man - 1.0) * share * share * (3.0 - 2.0 * share))
