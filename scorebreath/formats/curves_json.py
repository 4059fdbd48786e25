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
from tempfile import TemporaryFile
from typing import IO, BinaryIO

import numpy as np
from numpy.typing import NDArray

from scorebreath.curves.channels import Channel
from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.rigs.rig import Column, Rig
from scorebreath.formats.decimals import encode, whole
from scorebreath.formats.frames import BLOCK, Sample, blocks, check_rate, frame_count

SCHEMA = "scorebreath.curves/1"
RIG_SCHEMA = "scorebreath.rig/1"
Millionths = NDArray[np.int64]


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
    with TemporaryFile() as held:
        columns = _sampled(held, curve_set, duration, fps, rig)
        rows = [_channel(one) for one in curve_set.table] if rig is None else [_column(one) for one in rig.table]
        for number, row in enumerate(rows):
            stream.write((b"," if number else b"") + b"\n" + _text(row)[:-1] + b',"values":[')
            for first in range(0, len(columns), BLOCK):
                comma = b"," if first else b""
                stream.write(comma + encode(columns[first : first + BLOCK, number, np.newaxis], b",", b",")[:-1])
            stream.write(b"]}")
        del columns
    stream.write(b"\n]}\n")


def _sampled(held: IO[bytes], curve_set: CurveSet, duration: float, fps: Fraction, rig: Rig | None) -> Millionths:
    """All frames, sampled once and laid down on the disk: so the memory stays bounded, whatever the length."""
    sample: Sample = curve_set.sample if rig is None else lambda times: rig.sample(curve_set, times)
    for _, values in blocks(sample, duration, fps):
        held.write(whole(values).tobytes())
    held.flush()
    width = len(curve_set.table if rig is None else rig.table)
    return np.memmap(held, dtype=np.int64, mode="r", shape=(frame_count(duration, fps), width))


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
