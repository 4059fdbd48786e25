"""MPEG-4's facial animation parameters as the text file that FAP players read.

    2.1 NAME FPS FRAMES
    0 0 1 1 ...          which of the 68 parameters this frame has
    0 120 -85 ...        the frame's number, and those parameters, whole numbers of FAPUs

Parameters 1 and 2 (viseme, expression) are never sent: the 66 others say all there is.
"""

from __future__ import annotations

import re
from fractions import Fraction
from typing import BinaryIO

import numpy as np

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.rigs.rig import Rig
from scorebreath.errors import InputError
from scorebreath.formats.frames import blocks, check_rate, frame_count

HIGH_LEVEL = 2
"""Parameters before those of the rig."""


def write(stream: BinaryIO, rig: Rig, curve_set: CurveSet, duration: float, fps: Fraction) -> None:
    """Write the frames from 0 to `duration` seconds.

    Args:
        stream: Takes bytes.
        rig: The one called `fap`: parameters 3 to 68.
        curve_set: Whose curves.
        duration: Seconds.
        fps: Frames a second; the file knows whole numbers only.

    Raises:
        InputError: The rate is out of range or no whole number.
    """
    if check_rate(fps).denominator != 1:
        raise InputError(f"fps={fps} must be a whole number in a .fap file, such as 25 or 60")
    name = re.sub(r"[^\w.-]", "_", curve_set.body, flags=re.ASCII)
    stream.write(f"2.1 {name} {fps} {frame_count(duration, fps)}\n".encode("ascii"))
    driven = np.array([bool(column.parts or column.emotions) for column in rig.table])
    mask = " ".join(["0"] * HIGH_LEVEL + ["01"[each] for each in driven.tolist()])
    frame = 0
    for _, values in blocks(lambda times: rig.sample(curve_set, times), duration, fps):
        for row in np.rint(values[:, driven]).astype(np.int64).tolist():
            stream.write(f"{mask}\n{frame} {' '.join(map(str, row))}\n".encode("ascii"))
            frame += 1
