"""How much air people can breathe out: forced vital capacity from sex, age and height (physiology 2.1)."""

from __future__ import annotations

from bisect import bisect_right
from math import exp, log
from typing import Literal

from scorebreath.errors import ParameterError

Sex = Literal["male", "female"]

_GLI: dict[Sex, tuple[float, float, float]] = {
    "male": (-12.629131, 2.727421, 0.009174),
    "female": (-12.055901, 2.621579, -0.035975),
}
"""a0, a1, a2 of GLI Global 2022."""

_AGES = (5.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0)
_SPLINE: dict[Sex, tuple[float, ...]] = {
    "male": (
        -0.0414, -0.0466, -0.0502, -0.0370, -0.0064, 0.0311, 0.0640, 0.0869,
        0.1047, 0.0947, 0.0560, 0.0015, -0.0675, -0.1394, -0.2059, -0.2365,
    ),
    "female": (
        -0.0994, -0.0697, -0.0480, -0.0214, 0.0066, 0.0319, 0.0524, 0.0679,
        0.0899, 0.0966, 0.0771, 0.0222, -0.0505, -0.1254, -0.1950, -0.2272,
    ),
}  # fmt: skip
"""M-spline of GLI Global 2022 at `_AGES`; straight lines between them are within 0.56 % of the full table."""

_ECSC: dict[Sex, tuple[float, float, float]] = {"male": (5.76, 0.026, 4.34), "female": (4.43, 0.026, 2.89)}
"""Litres a metre, litres a year, litres of ECSC 1993."""

ECSC_ADULT, ECSC_FLAT = 18.0, 25.0
"""Years from which ECSC 1993 holds, and below which everybody counts as that old."""


def fvc_gli_2022(sex: Sex, age: float, height: float) -> float:
    r"""Forced vital capacity by GLI Global 2022, race-neutral (Bowerman et al. 2023; physiology 2.1), L.

    :math:`FVC = \exp(a_0 + a_1 \ln H + a_2 \ln A + M(A))`, with M the spline of the age. From 85 years on the spline
    goes on as straight as from 80 to 85.

    Args:
        sex: Chooses the coefficients.
        age: :math:`A`, years, 5..95.
        height: :math:`H`, cm.

    >>> [round(fvc_gli_2022("male", age, height), 2) for age, height in ((30, 178), (75, 178), (10, 138))]
    [5.1, 3.94, 2.18]
    >>> [round(fvc_gli_2022("female", age, 165), 2) for age in (30, 60)]
    [3.68, 3.1]
    """
    a0, a1, a2 = _GLI[sex]
    return exp(a0 + a1 * log(height) + a2 * log(age) + _spline(sex, age))


def fvc_ecsc_1993(sex: Sex, age: float, height: float) -> float:
    r"""Forced vital capacity of adults by ECSC 1993 (Quanjer et al. 1993; physiology 2.1), L.

    Men :math:`5.76 H - 0.026 A - 4.34`, women :math:`4.43 H - 0.026 A - 2.89`, H in metres; below 25 years A = 25.

    Args:
        sex: Chooses the equation.
        age: :math:`A`, years.
        height: :math:`H`, cm.

    Raises:
        ParameterError: Younger than 18: the equation is for adults.

    >>> [round(fvc_ecsc_1993("male", age, 178), 2) for age in (30, 75)]
    [5.13, 3.96]
    >>> [round(fvc_ecsc_1993("female", age, 165), 2) for age in (30, 60)]
    [3.64, 2.86]
    >>> fvc_ecsc_1993("male", 18, 178) == fvc_ecsc_1993("male", 25, 178)
    True
    """
    if age < ECSC_ADULT:
        raise ParameterError(
            f"capacity_equation='ecsc-1993' is for adults, but age={age:g} is below 18: "
            "set capacity_equation='gli-2022', or vital_capacity by hand"
        )
    metre, year, constant = _ECSC[sex]
    return metre * height / 100.0 - year * max(age, ECSC_FLAT) - constant


def _spline(sex: Sex, age: float) -> float:
    values = _SPLINE[sex]
    after = min(max(bisect_right(_AGES, age), 1), len(_AGES) - 1)
    low, high = _AGES[after - 1], _AGES[after]
    share = (age - low) / (high - low)
    return values[after - 1] + share * (values[after] - values[after - 1])
