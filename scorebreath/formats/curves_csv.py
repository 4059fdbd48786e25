"""Curves as CSV: a header, then a row a frame.

Row i is at `i / fps` seconds, for every i with `i / fps <= duration`; sample 0 of the sound is time 0. With keys there
are rows between them: where closures begin and end, and very short phones (A15, A16). Numbers have six decimals and no
exponent; lines end with LF.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import BinaryIO

import numpy as np

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.lips.keys import key_times
from scorebreath.curves.rigs.rig import Rig
from scorebreath.formats.decimals import encode, whole
from scorebreath.formats.frames import Sample, blocks, blocks_at, check_rate


def write(
    stream: BinaryIO, curve_set: CurveSet, duration: float, fps: Fraction, *, rig: Rig | None = None, keys: bool = False
) -> None:
    """Write all channels, or a rig's columns, from 0 to `duration` seconds.

    Args:
        stream: Takes bytes.
        curve_set: Whose curves.
        duration: Seconds.
        fps: Frames a second, exact: `Fraction(30000, 1001)`.
        rig: Whose columns; None: the channels themselves.
        keys: Whether key frames stand between the frames.

    Raises:
        InputError: The rate is out of range.
    """
    check_rate(fps)
    names: Sequence[str] = curve_set.channels if rig is None else rig.columns
    sample: Sample = curve_set.sample if rig is None else lambda times: rig.sample(curve_set, times)
    stream.write((",".join(("time", *names)) + "\n").encode("utf-8"))
    found = blocks_at(sample, key_times(curve_set, duration, fps)) if keys else blocks(sample, duration, fps)
    for times, values in found:
        stream.write(encode(whole(np.column_stack((times, values))), b",", b"\n"))
