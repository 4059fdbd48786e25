"""A row's numbers as a small picture: inline SVG, whose colours are the page's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from html import escape
from math import ceil, floor, log10

import numpy as np

from scorebreath.report.norms.figures import Array, Figure
from scorebreath.report.norms.row import PAIRS, Result
from scorebreath.report.norms.words import number
from scorebreath.units import plain

WIDTH, HEIGHT = 360, 132
LEFT, RIGHT, TOP, BOTTOM = 8, 8, 12, 30
FOOT = HEIGHT - BOTTOM
STRIP = 30
"""Values up to which each is drawn by itself."""
MOST_BINS = 36
TICKS = 5
DOTS = 2000
"""Points of a cloud at most, evenly spread over the breaths."""


def plot(result: Result) -> str:
    """The picture of a row; empty where there is nothing to draw."""
    if result.n < 1:
        return ""
    body = {"values": _distribution, "relation": _cloud, "sites": _bars, "share": _gauge, "number": _gauge}[
        result.row.kind
    ](result)
    if not body:
        return ""
    height = HEIGHT if result.row.kind != "sites" else _bars_height(result)
    label = escape(f"{result.row.title}: {result.verdict}", quote=True)
    return f'<svg viewBox="0 0 {WIDTH} {height}" role="img" aria-label="{label}">{body}</svg>'


Scale = Callable[[float], float]


def _scale(low: float, high: float) -> Scale:
    """From a row's unit to x."""
    return lambda value: LEFT + (min(max(value, low), high) - low) / (high - low) * (WIDTH - LEFT - RIGHT)


def ticks(low: float, high: float, most: int = TICKS) -> list[float]:
    """Round numbers within a range, about as many as asked for.

    >>> ticks(0.0, 10.0), ticks(0.13, 0.19)
    ([0.0, 2.0, 4.0, 6.0, 8.0, 10.0], [0.14, 0.16, 0.18])
    """
    rough = (high - low) / most
    decade = 10.0 ** floor(log10(rough))
    step = decade * next(factor for factor in (1.0, 2.0, 2.5, 5.0, 10.0) if factor * decade >= rough * 0.999)
    return [round(k * step, 9) + 0.0 for k in range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)]


def _limits(result: Result, values: Array) -> tuple[float, float]:
    """What the axis holds: the values, and every published end and mean."""
    marks = [float(values.min()), float(values.max())]
    for each in result.compared:
        figure = each.figure
        if figure.of == "sd" or (figure.of == "each" and not figure.judges):
            continue
        ends = figure.range or ()
        marks += [end for end in (*ends, figure.mean) if end is not None and np.isfinite(end)]
    low, high, finest = min(marks), max(marks), 10.0**-result.row.digits
    room = 0.06 * (high - low) if high - low > 1e-6 * max(abs(low), abs(high)) else max(abs(low) * 0.1, finest)
    return low - max(room, finest / 10.0), high + max(room, finest / 10.0)


def _axis(x: Scale, low: float, high: float) -> str:
    parts = [f'<path class="axis" d="M{LEFT} {FOOT}H{WIDTH - RIGHT}"/>']
    for tick in ticks(low, high):
        parts.append(
            f'<path class="axis" d="M{x(tick):.1f} {FOOT}v4"/>'
            f'<text x="{x(tick):.1f}" y="{FOOT + 16}" text-anchor="middle">{plain(tick)}</text>'
        )
    return "".join(parts)


def _behind(result: Result, x: Scale) -> str:
    """Ranges that the verdict counts, shaded."""
    return "".join(_band(each.figure, x, "band") for each in result.compared if each.figure.judges)


def _band(figure: Figure, x: Scale, name: str) -> str:
    if figure.of in ("sd", "each") or figure.range is None:
        return ""
    low, high = (x(float(end)) for end in np.clip(figure.range, -1e12, 1e12))
    return _box(low, TOP, max(high - low, 2.0), FOOT - TOP, name)


def _before(result: Result, x: Scale) -> str:
    """Other ranges as outlines, means without a spread as lines, the ends for single breaths."""
    parts = [_band(each.figure, x, "band other") for each in result.compared if not each.figure.judges]
    for each in result.compared:
        if each.figure.range is None and each.figure.mean is not None:
            parts.append(f'<path class="about" d="M{x(each.figure.mean):.1f} {TOP}V{FOOT}"/>')
    for each in result.compared:
        if each.figure.of == "each" and each.figure.judges and each.figure.range is not None:
            for end in each.figure.range:
                if np.isfinite(end):
                    parts.append(f'<path class="limit" d="M{x(end):.1f} {TOP}V{FOOT}"/>')
    return "".join(parts)


def _distribution(result: Result) -> str:
    values = result.values
    low, high = _limits(result, values)
    x = _scale(low, high)
    drawn = _strip(values, x) if result.n < STRIP else _histogram(values, x, low, high)
    return _behind(result, x) + drawn + _before(result, x) + _axis(x, low, high) + _quantiles(result, x)


def _strip(values: Array, x: Scale) -> str:
    """Each value a dot, those that would cover each other one above the other."""
    rows: list[float] = []
    parts: list[str] = []
    for value in np.sort(values):
        at = x(float(value))
        free = next((k for k, last in enumerate(rows) if at - last >= 6.5), len(rows))
        rows[free : free + 1] = [at]
        y = FOOT - 7 - 6.5 * (free % 9)
        parts.append(f'<circle class="value" cx="{at:.1f}" cy="{y:.1f}" r="3"/>')
    return "".join(parts)


def _histogram(values: Array, x: Scale, low: float, high: float) -> str:
    edges = _bins(values)
    counts, _ = np.histogram(values, edges)
    top = max(int(counts.max()), 1)
    parts: list[str] = []
    for count, start, end in zip(counts.tolist(), edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        if count:
            height = max(1.0, (FOOT - TOP - 12) * count / top)
            wide = max(x(end) - x(start) - 0.6, 1.5)
            parts.append(_box(x(start), FOOT - height, wide, height))
    return "".join(parts)


def _box(x: float, y: float, width: float, height: float, name: str = "value") -> str:
    return f'<rect class="{name}" x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}"/>'


def _bins(values: Array) -> Array:
    """Edges by Freedman and Diaconis; whole numbers stand in the middle of theirs."""
    low, high = float(values.min()), float(values.max())
    if low == high:
        room = 0.5 if low == round(low) else 0.001 * abs(low)
        return np.array([low - room, high + room])
    quartiles = np.percentile(values, (25, 75))
    width = 2.0 * float(quartiles[1] - quartiles[0]) / len(values) ** (1 / 3) or (high - low) / 10
    width = max(width, (high - low) / MOST_BINS)
    if np.all(values == np.round(values)):
        whole = max(1, round(width))
        return np.arange(low - 0.5, high + 0.5 + whole, whole)
    return np.linspace(low, high, max(5, ceil((high - low) / width)) + 1)


def _quantiles(result: Result, x: Scale) -> str:
    """A line from the 5th to the 95th of a hundred, the mean on it; the median with its number above."""
    if result.p5 is None or result.p95 is None or result.median is None or result.value is None:
        return ""
    low, middle, high, mean = x(result.p5), x(result.median), x(result.p95), result.value
    anchor = "start" if middle < 40 else "end" if middle > WIDTH - 40 else "middle"
    return (
        f'<path class="spread" d="M{low:.1f} {TOP + 4}v8m0 -4H{high:.1f}m0 -4v8"/>'
        f'<path class="median" d="M{middle:.1f} {TOP + 1}V{FOOT}"/>'
        f'<circle class="mean" cx="{x(mean):.1f}" cy="{TOP + 8}" r="3.2"/>'
        f'<text class="median-number" x="{middle:.1f}" y="{TOP - 2}" text-anchor="{anchor}">'
        f"{number(result.median, result.row.digits)}</text>"
    )


def _gauge(result: Result) -> str:
    """One number on its axis."""
    if result.value is None:
        return ""
    values = np.array([result.value])
    low, high = (-4.0, 104.0) if result.row.kind == "share" else _limits(result, values)
    x = _scale(low, high)
    at = x(result.value)
    anchor = "start" if at < 40 else "end" if at > WIDTH - 40 else "middle"
    return (
        _behind(result, x)
        + _before(result, x)
        + _axis(x, low, high)
        + f'<path class="median" d="M{at:.1f} {TOP + 8}V{FOOT}"/>'
        f'<circle class="value" cx="{at:.1f}" cy="{FOOT - 38}" r="5"/>'
        f'<text class="median-number" x="{at:.1f}" y="{TOP + 4}" text-anchor="{anchor}">'
        f"{number(result.value, result.row.digits)}</text>"
    )


def _cloud(result: Result) -> str:
    """Pairs as points, and the line that fits them best."""
    pairs = result.values[:: max(1, -(-len(result.values) // DOTS))]
    (left, bottom), (right, top) = result.values.min(axis=0), result.values.max(axis=0)
    wide, tall = (max(span, 1e-3, 1e-6 * abs(end)) for span, end in ((right - left, right), (top - bottom, top)))
    low, high = float(left - 0.06 * wide), float(right + 0.06 * wide)
    x = _scale(low, high)

    def y(value: float) -> float:
        return float(FOOT - 6 - (value - bottom) / tall * (FOOT - TOP - 14))

    points = "".join(f'<circle class="point" cx="{x(a):.1f}" cy="{y(b):.1f}" r="2"/>' for a, b in pairs.tolist())
    ends = "".join(
        f'<text x="{LEFT}" y="{at:.1f}">{plain(round(value, 2))}</text>'
        for value, at in ((float(bottom), FOOT - 3.0), (float(top), TOP + 8.0))
    )
    across, up = (escape(label) for label in result.row.labels)
    names = (
        f'<text x="{WIDTH - RIGHT}" y="{HEIGHT - 2}" text-anchor="end">{across}</text>'
        f'<text x="{LEFT}" y="{TOP - 3}">{up}</text>'
    )
    return points + "".join(_fit(result, x, y)) + _axis(x, low, high) + ends + names


def _fit(result: Result, x: Scale, y: Callable[[float], float]) -> Iterator[str]:
    a, b = result.values.T
    if result.n < PAIRS or not np.ptp(a) > 0:
        return
    slope, foot = np.polyfit(a, b, 1)
    ends = [(float(at), float(foot + slope * at)) for at in (a.min(), a.max())]
    inside = [(at, min(max(value, float(b.min())), float(b.max()))) for at, value in ends]
    (x1, y1), (x2, y2) = ((x(at), y(value)) for at, value in inside)
    yield f'<path class="median" d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}"/>'


LINE = 15


def _shown(result: Result) -> list[tuple[str, float]]:
    return [(name, share) for name, share in result.shares.items() if share > 0]


def _bars_height(result: Result) -> int:
    return 10 + LINE * len(_shown(result))


def _bars(result: Result) -> str:
    """Shares of kinds, a bar each."""
    parts: list[str] = []
    for line, (name, share) in enumerate(_shown(result)):
        y = 6 + LINE * line
        wide = share / 100.0 * (WIDTH - 150)
        parts.append(
            f'<text x="72" y="{y + 10}" text-anchor="end">{escape(name)}</text>'
            f'{_box(80, y, max(wide, 1.0), LINE - 4)}<text x="{86 + wide:.1f}" y="{y + 10}">{number(share, 1)} %</text>'
        )
    return "".join(parts)
