"""A row of the table of norms, and what a Score gives for it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from scorebreath.report.norms.figures import (
    FEWEST,
    NO_FIGURE,
    TOO_FEW,
    Array,
    Circumstances,
    Figure,
    Verdict,
    compare,
    together,
)
from scorebreath.report.norms.material import Material

Kind = Literal["values", "share", "relation", "number", "sites"]
"""What a row's measure gives: `values` (n,) one of each breath; `share` (n,) 0 or 1 of each, told in per cent;
`relation` (n, 2) pairs, told as their correlation; `number` (1,); `sites` (n,) places in a list of kinds."""
PAIRS = 10
"""The fewest breaths of which a share or a correlation says anything."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A measure, and what is published about it."""

    name: str
    """stable key"""
    title: str
    part: str
    """heading it stands under"""
    unit: str
    measured: str
    """how, in a sentence"""
    measure: Callable[[Material], Array]
    kind: Kind = "values"
    figures: tuple[Figure, ...] = ()
    digits: int = 2
    """after the point, for people"""
    labels: tuple[str, ...] = ()
    """of `sites`: the kinds; of a `relation`: what its two numbers are"""
    fewest: int = 1
    """values below which nothing is said"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Compared:
    """A published figure beside the Score's."""

    figure: Figure
    verdict: Verdict
    """of this figure alone"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Result:
    """What a Score gives for a row; numbers are in the row's unit, None where there are too few breaths for them."""

    row: Row
    values: Array
    """as the measure gives them, those that are not finite left out"""
    n: int
    value: float | None
    """what verdicts are about first: the mean, the share in per cent, the correlation, the number"""
    median: float | None = None
    sd: float | None = None
    p5: float | None = None
    p95: float | None = None
    lowest: float | None = None
    highest: float | None = None
    shares: Mapping[str, float] = field(default_factory=dict)
    """of each kind of place, per cent; empty for other rows"""
    compared: tuple[Compared, ...] = ()
    """the figures that apply to this speaker"""
    verdict: Verdict = NO_FIGURE


def result(row: Row, material: Material) -> Result:
    """Measure a row and compare it."""
    values = row.measure(material)
    whole = np.isfinite(values) if values.ndim == 1 else np.all(np.isfinite(values), axis=1)
    values = np.round(values[whole], 9) + 0.0  # differences of times leave dust
    told = _told(row, values)
    return _verdict(told, material.who)


def _told(row: Row, values: Array) -> Result:
    n = len(values)
    if row.kind == "values" and n:
        low, p5, median, p95, high = (float(q) for q in np.percentile(values, (0, 5, 50, 95, 100)))
        return Result(
            row=row, values=values, n=n, value=float(values.mean()), median=median, p5=p5, p95=p95,
            sd=float(values.std(ddof=1)) if n > 1 else None, lowest=low, highest=high,
        )  # fmt: skip
    if row.kind == "sites" and n:
        counts = np.bincount(values.astype(np.intp), minlength=len(row.labels))
        shares = {label: 100.0 * float(count) / n for label, count in zip(row.labels, counts, strict=True)}
        return Result(row=row, values=values, n=n, value=None, shares=shares)
    value: float | None = None
    if n and row.kind == "share":
        value = 100.0 * float(values.mean())
    elif n and row.kind == "number":
        value = float(values[0])
    elif n >= PAIRS and row.kind == "relation":
        value = correlation(values)
    return Result(row=row, values=values, n=n, value=value)


def _verdict(told: Result, who: Circumstances) -> Result:
    compared = tuple(
        Compared(figure=figure, verdict=_compared(told, figure)) for figure in told.row.figures if figure.when.fits(who)
    )
    verdicts = [each.verdict for each in compared if each.figure.judges and each.figure.range]
    verdict = together(verdicts) if verdicts else NO_FIGURE
    if told.n < max(told.row.fewest, 1):
        verdict = TOO_FEW
    return Result(
        row=told.row, values=told.values, n=told.n, value=told.value, median=told.median, sd=told.sd, p5=told.p5,
        p95=told.p95, lowest=told.lowest, highest=told.highest, shares=told.shares, compared=compared, verdict=verdict,
    )  # fmt: skip


def _compared(told: Result, figure: Figure) -> Verdict:
    limits = figure.range
    if limits is None:
        return NO_FIGURE
    if told.n < max(FEWEST[figure.of], told.row.fewest):
        return TOO_FEW
    if figure.of == "each":
        return compare(told.values, limits)
    number = told.sd if figure.of == "sd" else told.value
    return TOO_FEW if number is None else compare(np.array([number]), limits)


def correlation(pairs: Array) -> float:
    """Pearson's r of (n, 2) numbers; 0 where one of the two is always the same.

    >>> round(correlation(np.array([[1.0, 2.0], [2.0, 4.0], [3.0, 6.5]])), 3)
    0.998
    >>> correlation(np.array([[1.0, 2.0], [2.0, 2.0]]))
    0.0
    """
    spread = np.ptp(pairs, axis=0)
    if not np.all(spread > 1e-9 * np.maximum(1.0, np.abs(pairs).max(axis=0))):
        return 0.0
    return float(np.corrcoef(pairs[:, 0], pairs[:, 1])[0, 1])
