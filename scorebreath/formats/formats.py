"""The table of formats. A new format is a file beside this one and a row here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import BinaryIO

from scorebreath.curves.curve_set import CurveSet, curves
from scorebreath.curves.rigs.rig import Rig
from scorebreath.curves.rigs.table import RIGS, rig_named
from scorebreath.errors import InputError, did_you_mean
from scorebreath.formats import curves_csv, curves_json, fap, groups_csv, livelink_csv, maryxml
from scorebreath.score.document import Score


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """What a writer may be told."""

    fps: Fraction = Fraction(60)
    """frames a second, for formats of frames"""
    body: str | None = None
    """whose curves; None where the Score has one body"""
    closure_gate: bool = True
    """whether p, b and m shut the lips whatever else opens them"""
    keys: bool = False
    """whether key frames stand between the frames (A15, A16), for tables with a column of times"""
    degrees: bool = False
    """whether Live Link's angles are degrees instead of radians"""


Writer = Callable[[BinaryIO, Score, ExportOptions], None]
_CurvesWriter = Callable[[BinaryIO, CurveSet, float, ExportOptions], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Format:
    """One format."""

    name: str
    suffix: str
    what: str
    write: Writer
    keys: bool = False
    """whether it can hold key frames"""


def _of_curves(write: _CurvesWriter) -> Writer:
    def writer(stream: BinaryIO, score: Score, options: ExportOptions) -> None:
        write(stream, curves(score, options.body, closure_gate=options.closure_gate), score.duration, options)

    return writer


def _of_score(write: Callable[[BinaryIO, Score], None]) -> Writer:
    def writer(stream: BinaryIO, score: Score, options: ExportOptions) -> None:
        write(stream, score)

    return writer


def _of_rig(name: str, write: Callable[[BinaryIO, Rig, CurveSet, float, ExportOptions], None]) -> Writer:
    return _of_curves(lambda stream, of, duration, options: write(stream, rig_named(name), of, duration, options))


def _channels_csv(stream: BinaryIO, of: CurveSet, duration: float, options: ExportOptions) -> None:
    curves_csv.write(stream, of, duration, options.fps, keys=options.keys)


def _channels_json(stream: BinaryIO, of: CurveSet, duration: float, options: ExportOptions) -> None:
    curves_json.write(stream, of, duration, options.fps)


def _rig_csv(stream: BinaryIO, rig: Rig, of: CurveSet, duration: float, options: ExportOptions) -> None:
    curves_csv.write(stream, of, duration, options.fps, rig=rig, keys=options.keys)


def _rig_json(stream: BinaryIO, rig: Rig, of: CurveSet, duration: float, options: ExportOptions) -> None:
    curves_json.write(stream, of, duration, options.fps, rig=rig)


def _livelink(stream: BinaryIO, rig: Rig, of: CurveSet, duration: float, options: ExportOptions) -> None:
    livelink_csv.write(stream, rig, of, duration, options.fps, degrees=options.degrees)


def _fap(stream: BinaryIO, rig: Rig, of: CurveSet, duration: float, options: ExportOptions) -> None:
    fap.write(stream, rig, of, duration, options.fps)


def rig_formats(rig: str) -> tuple[Format, ...]:
    """What a rig can be written as: a table and a document, or what its own programs read.

    Args:
        rig: A name, or the path of a `.toml` file; see `rig_named`. One like `livelink` or `fap`, with all its columns
            in their units, can be written as that.
    """
    kind = rig if rig in RIGS else rig_named(rig).kind
    table = Format(
        name=f"{rig}.csv", suffix=".csv", what=f"rig {rig}, a row a frame", write=_of_rig(rig, _rig_csv), keys=True
    )
    if kind == "livelink":
        table = Format(
            name=f"{rig}.csv", suffix=".csv", what="ARKit's shapes as the Live Link Face app records them",
            write=_of_rig(rig, _livelink),
        )  # fmt: skip
    document = Format(
        name=f"{rig}.json", suffix=".json", what=f"rig {rig}, a column each", write=_of_rig(rig, _rig_json)
    )
    if kind != "fap":
        return table, document
    file = Format(
        name=f"{rig}.fap", suffix=".fap", what="MPEG-4 facial animation parameters, for players of FAP files",
        write=_of_rig(rig, _fap),
    )  # fmt: skip
    return table, document, file


FORMATS: Mapping[str, Format] = MappingProxyType(
    {
        row.name: row
        for row in (
            Format(
                name="curves.csv", suffix=".csv", what="all channels, a row a frame", write=_of_curves(_channels_csv),
                keys=True,
            ),
            Format(
                name="curves.json", suffix=".json", what="all channels with their table, a column each",
                write=_of_curves(_channels_json),
            ),
            Format(
                name="groups.csv", suffix=".csv", what="breath groups, a row a breath",
                write=_of_score(groups_csv.write),
            ),
            Format(
                name="maryxml", suffix=".xml", what="MaryXML 0.5: words, accents, phones, phrases, boundaries",
                write=_of_score(maryxml.write),
            ),
            *(row for rig in RIGS for row in rig_formats(rig)),
        )
    }
)  # fmt: skip
"""Every format by its name."""


def format_named(name: str) -> Format:
    """The format of that name.

    Raises:
        InputError: There is none.
    """
    if name not in FORMATS:
        raise InputError(f"no format is called {name!r} (there are {', '.join(FORMATS)}){did_you_mean(name, FORMATS)}")
    return FORMATS[name]
