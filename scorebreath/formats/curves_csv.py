"""Curves as CSV: a header, then a row a frame.

Row i is at `i / fps` seconds, for every i with `i / fps <= duration`; sample 0 of the sound is time 0. Numbers have six
decimals and no exponent; lines end with LF.
"""

from __future__ import annotations

from fractions import Fraction
from typing import BinaryIO

import numpy as np

from scorebreath.curves.curve_set import CurveSet
from scorebreath.formats.decimals import encode
from scorebreath.formats.frames import blocks


def write(stream: BinaryIO, curve_set: CurveSet, duration: float, fps: Fraction) -> None:
    """Write all channels from 0 to `duration` seconds.

    Args:
        stream: Takes bytes.
        curve_set: Whose curves.
        duration: Seconds.
        fps: Frames a second, exact: `Fraction(30000, 1001)`.

    Raises:
        InputError: The rate is out of range.
    """
    stream.write((",".join(("time", *curve_set.channels)) + "\n").encode("ascii"))
    for times, values in blocks(curve_set, duration, fps):
        stream.write(encode(np.column_stack((times, values)), b",", b"\n"))
