"""Curves as JSON, `scorebreath.curves/1`: the table of channels with a column of values each.

    {"schema": "scorebreath.curves/1", "body", "duration", "fps": [30000, 1001], "frames",
     "channels": [{"name", "unit", "range": [low, high], "meaning", "values": [...]}, ...]}

Value i is at `i * fps[1] / fps[0]` seconds, for every i up to the duration. The range says what to expect.
"""

from __future__ import annotations

import json
from fractions import Fraction
from typing import BinaryIO

from scorebreath.curves.channels import Channel
from scorebreath.curves.curve_set import CurveSet
from scorebreath.formats.decimals import encode
from scorebreath.formats.frames import blocks, check_rate, frame_count

SCHEMA = "scorebreath.curves/1"


def write(stream: BinaryIO, curve_set: CurveSet, duration: float, fps: Fraction) -> None:
    """Write all channels from 0 to `duration` seconds, one after the other.

    Args:
        stream: Takes bytes.
        curve_set: Whose curves.
        duration: Seconds.
        fps: Frames a second, exact: `Fraction(30000, 1001)`.

    Raises:
        InputError: The rate is out of range.
    """
    head = {
        "schema": SCHEMA,
        "body": curve_set.body,
        "duration": duration,
        "fps": [check_rate(fps).numerator, fps.denominator],
        "frames": frame_count(duration, fps),
    }
    stream.write(_text(head)[:-1] + b',"channels":[')
    for number, channel in enumerate(curve_set.table):
        stream.write((b"," if number else b"") + b"\n" + _text(_row(channel))[:-1] + b',"values":[')
        comma = b""
        for _, values in blocks(curve_set, duration, fps, [channel.name]):
            stream.write(comma + encode(values, b",", b",")[:-1])
            comma = b","
        stream.write(b"]}")
    stream.write(b"\n]}\n")


def _row(channel: Channel) -> dict[str, object]:
    return {
        "name": channel.name,
        "unit": channel.unit,
        "range": [channel.low, channel.high],
        "meaning": channel.meaning,
    }


def _text(value: dict[str, object]) -> bytes:
    return json.dumps(value, separators=(",", ":")).encode("ascii")
