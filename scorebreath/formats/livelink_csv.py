"""The table that the Live Link Face app records, byte for byte as its takes look (Unreal imports it, many read it).

A header of 63 names in Epic's order (JawRight before JawLeft, MouthRight before MouthLeft); then a row a frame: the
timecode `HH:MM:SS:FF.mmm`, whose frames are sixtieths of a second whatever the rate; 61; 52 shapes and nine angles with
ten decimals. ASCII, commas, LF. The angles are radians; degrees are for readers that want them.
"""

from __future__ import annotations

from fractions import Fraction
from typing import BinaryIO

import numpy as np

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.rigs.rig import Rig
from scorebreath.formats.decimals import encode, whole
from scorebreath.formats.frames import BLOCK, blocks, check_rate, frame_count

PLACES = 10
BASE = 60
"""frames a second of the timecode"""


def write(
    stream: BinaryIO, rig: Rig, curve_set: CurveSet, duration: float, fps: Fraction, *, degrees: bool = False
) -> None:
    """Write a take from 0 to `duration` seconds; it begins at 00:00:00:00.000.

    Args:
        stream: Takes bytes.
        rig: The one called `livelink`, or one of its kind.
        curve_set: Whose curves.
        duration: Seconds.
        fps: Frames a second, exact.
        degrees: Whether angles are degrees instead of radians.

    Raises:
        InputError: The rate is out of range.
    """
    count = frame_count(duration, check_rate(fps))
    stream.write((",".join(("Timecode", "BlendShapeCount", *rig.columns)) + "\n").encode("ascii"))
    scale = np.array([np.degrees(1.0) if degrees and column.unit == "rad" else 1.0 for column in rig.table])
    for number, (_, values) in enumerate(blocks(lambda times: rig.sample(curve_set, times), duration, fps)):
        frames = range(number * BLOCK, min((number + 1) * BLOCK, count))
        rows = encode(whole(values * scale, PLACES), b",", b"\n", PLACES).splitlines(keepends=True)
        shapes = len(rig.columns)
        for frame, row in zip(frames, rows, strict=True):
            stream.write(f"{timecode(frame, fps)},{shapes},".encode("ascii") + row)


def timecode(frame: int, fps: Fraction) -> str:
    """A frame's time, rounded to a thousandth of a sixtieth of a second before it is taken apart.

    >>> timecode(1, Fraction(30)), timecode(90, Fraction(30000, 1001)), timecode(59_999_999, Fraction(1_000_000))
    ('00:00:00:02.000', '00:00:03:00.180', '00:01:00:00.000')
    """
    sixtieths = Fraction(frame * BASE * 1000) / fps
    seconds, rest = divmod(int(sixtieths + Fraction(1, 2)), BASE * 1000)
    minutes, seconds = divmod(seconds, 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours:02d}:{minutes:02d}:{seconds:02d}:{rest // 1000:02d}.{rest % 1000:03d}"
