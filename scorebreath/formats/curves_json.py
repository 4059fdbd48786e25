"""Curves as JSON: the table of channels, or of a rig's columns, with a column of values each.

    {"schema": "scorebreath.curves/1", "body", "duration", "fps": [30000, 1001], "frames",
     "channels": [{"name", "unit", "range": [low, high], "meaning", "values": [...]}, ...]}

    {"schema": "scorebreath.rig/1", "rig", "about", "signs", "closure_gate", "body", "duration", "fps", "frames",
     "columns": [{"name", "unit", "range": [low, high], "made_of", "values": [...]}, ...]}

Value i is at `i * fps[1] / fps[0]` seconds, for every i up to the duration. A channel's range says what to expect, a
rig's column stays within it.
"""

from __future__ import annotations

import json
from fractions import Fraction
from typing import BinaryIO

from scorebreath.curves.channels import Channel
from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.rigs.rig import Column, Rig
from scorebreath.formats.decimals import encode, whole
from scorebreath.formats.frames import Sample, blocks, check_rate, frame_count

SCHEMA = "scorebreath.curves/1"
RIG_SCHEMA = "scorebreath.rig/1"


def write(stream: BinaryIO, curve_set: CurveSet, duration: float, fps: Fraction, *, rig: Rig | None = None) -> None:
    """Write all channels, or a rig's columns, from 0 to `duration` seconds, one after the other.

    Args:
        stream: Takes bytes.
        curve_set: Whose curves.
        duration: Seconds.
        fps: Frames a second, exact: `Fraction(30000, 1001)`.
        rig: Whose columns; None: the channels themselves.

    Raises:
        InputError: The rate is out of range.
    """
    head: dict[str, object] = {"schema": SCHEMA}
    if rig is not None:
        head = {
            "schema": RIG_SCHEMA, "rig": rig.name, "about": rig.about, "signs": rig.signs,
            "closure_gate": curve_set.closure_gate,
        }  # fmt: skip
    head |= {
        "body": curve_set.body,
        "duration": duration,
        "fps": [check_rate(fps).numerator, fps.denominator],
        "frames": frame_count(duration, fps),
    }
    stream.write(_text(head)[:-1] + (b',"channels":[' if rig is None else b',"columns":['))
    for number, name in enumerate(curve_set.channels if rig is None else rig.columns):
        row = _channel(curve_set.channel(name)) if rig is None else _column(rig.column(name))
        stream.write((b"," if number else b"") + b"\n" + _text(row)[:-1] + b',"values":[')
        comma = b""
        for _, values in blocks(_one(curve_set, rig, name), duration, fps):
            stream.write(comma + encode(whole(values), b",", b",")[:-1])
            comma = b","
        stream.write(b"]}")
    stream.write(b"\n]}\n")


def _one(curve_set: CurveSet, rig: Rig | None, name: str) -> Sample:
    """One column alone, so that the memory stays bounded."""
    if rig is None:
        return lambda times: curve_set.sample(times, [name])
    return lambda times: rig.sample(curve_set, times, [name])


def _channel(channel: Channel) -> dict[str, object]:
    return {
        "name": channel.name,
        "unit": channel.unit,
        "range": [channel.low, channel.high],
        "meaning": channel.meaning,
    }


def _column(column: Column) -> dict[str, object]:
    return {
        "name": column.name,
        "unit": column.unit,
        "range": [column.low, column.high],
        "made_of": column.made_of,
    }


def _text(value: dict[str, object]) -> bytes:
    return json.dumps(value, separators=(",", ":")).encode("ascii")
