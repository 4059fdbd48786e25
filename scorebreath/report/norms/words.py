"""Results in words for people, and as plain values for programs."""

from __future__ import annotations

from typing import Any

from scorebreath.report.norms.compare import Norms
from scorebreath.report.norms.figures import Figure, Of
from scorebreath.report.norms.row import Compared, Result
from scorebreath.report.norms.sources import MARKS, SOURCES
from scorebreath.units import plain

SUBJECTS: dict[Of, str] = {"mean": "mean ", "sd": "SD ", "each": "each ", "value": ""}
COLUMNS = ("measure", "unit", "n", "median", "mean", "SD", "5 to 95 %", "verdict", "published")
"""What people are shown of a row."""
GRAIN = 6
"""Digits after the point of numbers for programs."""


def number(value: float | None, digits: int) -> str:
    """A number as a row shows it; nothing for none.

    >>> number(3.0, 2), number(None, 2), number(-0.001, 2)
    ('3.00', '', '0.00')
    """
    return "" if value is None else f"{round(value, digits) + 0.0:.{digits}f}"


def with_unit(text: str, unit: str) -> str:
    """A number's text and its unit, if it has one."""
    return f"{text} {unit}" if unit else text


def figure_said(figure: Figure, unit: str) -> str:
    """What is published.

    >>> figure_said(Figure(of="mean", source="wang", mark="V2", mean=4.05, sd=1.5), "s")
    'mean 4.05 ± 1.5 s'
    >>> figure_said(Figure(of="each", source="scorebreath", mark="E", low=0.25, high=1.1), "s")
    'each 0.25 to 1.1 s'
    >>> figure_said(Figure(of="value", source="scorebreath", mark="E", low=90.0), "%")
    'at least 90 %'
    """
    if figure.mean is not None:
        spread = f" ± {plain(figure.sd)}" if figure.sd is not None else ""
        return with_unit(f"{SUBJECTS[figure.of]}{'' if spread else 'about '}{plain(figure.mean)}{spread}", unit)
    return f"{SUBJECTS[figure.of]}{_limits(figure.low, figure.high, unit)}"


def _limits(low: float | None, high: float | None, unit: str) -> str:
    if low is not None and high is not None:
        return with_unit(plain(low) if low == high else f"{plain(low)} to {plain(high)}", unit)
    if low is not None:
        return with_unit(f"at least {plain(low)}", unit)
    return with_unit(f"at most {plain(high)}", unit) if high is not None else ""


def range_said(result: Result) -> str:
    """From the 5th to the 95th of a hundred breaths."""
    if result.p5 is None:
        return ""
    digits = result.row.digits
    return f"{number(result.p5, digits)} to {number(result.p95, digits)}"


def published_said(result: Result) -> str:
    """The figures that the verdict counts, or where there is none, those that are shown."""
    chosen = [each.figure for each in result.compared if each.figure.judges and each.figure.range]
    figures = chosen or [each.figure for each in result.compared]
    return "; ".join(f"{figure_said(one, result.row.unit)} ({SOURCES[one.source].short})" for one in figures)


def why(result: Result) -> str:
    """Which numbers lie outside of what, as far as the verdict counts them; empty where none does."""
    outside = [each for each in result.compared if each.figure.judges and each.verdict.word == "outside"]
    return "; ".join(_why(result, each) for each in outside)


def _why(result: Result, compared: Compared) -> str:
    figure, row = compared.figure, result.row
    has = {
        "mean": f"mean {number(result.value, row.digits)}",
        "sd": f"SD {number(result.sd, row.digits)}",
        "each": f"from {number(result.lowest, row.digits)} to {number(result.highest, row.digits)}",
        "value": number(result.value, row.digits),
    }[figure.of]
    return f"{has} is {compared.verdict.direction} {figure_said(figure, row.unit).removeprefix(SUBJECTS[figure.of])}"


def shares_said(result: Result) -> str:
    """Kinds of place and their shares, the commonest first."""
    common = sorted(result.shares.items(), key=lambda item: -item[1])
    return ", ".join(f"{name} {number(share, 0)} %" for name, share in common if share > 0)


def line(result: Result) -> dict[str, Any]:
    """A row for people: every cell is text."""
    row = result.row
    cells = (
        row.title,
        row.unit,
        result.n,
        number(result.median, row.digits),
        number(result.value, row.digits),
        number(result.sd, row.digits),
        range_said(result),
        str(result.verdict),
        f"none; the score has {shares_said(result)}" if result.shares else published_said(result) or "none",
    )
    return dict(zip(COLUMNS, cells, strict=True))


def event(result: Result) -> dict[str, Any]:
    """A row for programs: every figure, with its source in full; the keys are stable."""
    row = result.row
    return {
        "name": row.name,
        "title": row.title,
        "part": row.part,
        "unit": row.unit,
        "kind": row.kind,
        "measured": row.measured,
        "verdict": result.verdict.word,
        "direction": result.verdict.direction,
        "why": why(result),
        "n": result.n,
        "value": _grained(result.value),
        "median": _grained(result.median),
        "sd": _grained(result.sd),
        "p5": _grained(result.p5),
        "p95": _grained(result.p95),
        "lowest": _grained(result.lowest),
        "highest": _grained(result.highest),
        "shares": {name: _grained(share) for name, share in result.shares.items()},
        "figures": [_figure(each) for each in result.compared],
    }


def _figure(compared: Compared) -> dict[str, Any]:
    figure = compared.figure
    return {
        "of": figure.of,
        "low": figure.low,
        "high": figure.high,
        "mean": figure.mean,
        "sd": figure.sd,
        "source": SOURCES[figure.source].short,
        "citation": SOURCES[figure.source].full,
        "mark": figure.mark,
        "trust": MARKS[figure.mark],
        "judges": figure.judges,
        "note": figure.note,
        "verdict": compared.verdict.word,
        "direction": compared.verdict.direction,
    }


def about(found: Norms) -> dict[str, Any]:
    """Who breathes, for programs; the keys are stable."""
    heard = found.heard
    return {
        "body": found.body,
        "style": found.who.style,
        "model": found.who.model,
        "age": found.who.age,
        "posture": found.who.posture,
        "loudness": found.who.loudness,
        "route": found.who.route,
        "vital_capacity": found.person.vital_capacity,
        "resting_volume": found.person.resting_volume,
        "states": list(found.states),
        "duration": found.duration,
        "groups": found.groups,
        "heard": None
        if heard is None
        else {"sample_rate": heard.sample_rate, "seconds": heard.seconds, "alone": heard.alone},
    }


def about_said(found: Norms) -> list[str]:
    """The same for people, a fact each."""
    who = found.who
    facts = [
        f"{found.groups} breath group{'' if found.groups == 1 else 's'} in {plain(round(found.duration, 1))} s",
        f"model {who.model}",
        f"style {who.style}",
        f"age {plain(who.age)}",
        f"{who.posture}, vital capacity {number(found.person.vital_capacity, 2)} L",
        {"both": "breaths through nose and mouth"}.get(who.route, f"breaths through the {who.route}"),
    ]
    if found.states:
        facts.append(f"states: {', '.join(found.states)}")
    if found.heard is None:
        facts.append("not listened to")
    elif found.heard.alone:
        facts.append("breaths rendered to be listened to")
    return facts


def summary(found: Norms) -> str:
    """How many rows have each verdict."""
    return ", ".join(f"{count} {word}" for word, count in found.counts.items() if count)


def _grained(value: float | None) -> float | None:
    return None if value is None else round(value, GRAIN) + 0.0
