"""The table of formats. A new format is a file beside this one and a row here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import BinaryIO

from scorebreath.curves.curve_set import CurveSet, curves
from scorebreath.errors import InputError
from scorebreath.formats import curves_csv, curves_json, groups_csv
from scorebreath.score.document import Score


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """What a writer may be told."""

    fps: Fraction = Fraction(60)
    """frames a second, for formats of frames"""
    body: str | None = None
    """whose curves; None where the Score has one body"""


Writer = Callable[[BinaryIO, Score, ExportOptions], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Format:
    """One format."""

    name: str
    suffix: str
    what: str
    write: Writer


def _of_curves(write: Callable[[BinaryIO, CurveSet, float, Fraction], None]) -> Writer:
    def writer(stream: BinaryIO, score: Score, options: ExportOptions) -> None:
        write(stream, curves(score, options.body), score.duration, options.fps)

    return writer


def _of_score(write: Callable[[BinaryIO, Score], None]) -> Writer:
    def writer(stream: BinaryIO, score: Score, options: ExportOptions) -> None:
        write(stream, score)

    return writer


FORMATS: Mapping[str, Format] = MappingProxyType(
    {
        name: Format(name=name, suffix=suffix, what=what, write=write)
        for name, suffix, what, write in (
            ("curves.csv", ".csv", "all channels, a row a frame", _of_curves(curves_csv.write)),
            ("curves.json", ".json", "all channels with their table, a column each", _of_curves(curves_json.write)),
            ("groups.csv", ".csv", "breath groups, a row a breath", _of_score(groups_csv.write)),
        )
    }
)
"""Every format by its name."""


def format_named(name: str) -> Format:
    """The format of that name.

    Raises:
        InputError: There is none.
    """
    if name not in FORMATS:
        raise InputError(f"no format is called {name!r}; expected one of {', '.join(FORMATS)}")
    return FORMATS[name]
