"""Rotations as VMC and Unity have them: left-handed axes, x to the right, y up, z where the character looks.

A quaternion is (x, y, z, w); it turns a vector by the same formula as anywhere, only what looks positive differs.
"""

from __future__ import annotations

import math

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
STILL: Quaternion = (0.0, 0.0, 0.0, 1.0)


def turn(pitch: float, yaw: float, roll: float) -> Quaternion:
    """Angles of ours, in degrees, as a rotation of Unity's.

    Chin up is about -x, to the character's left about -y, towards its right shoulder about -z; yaw turns what pitch
    has tilted, and pitch what roll has.

    >>> [round(number, 4) for number in turn(0, 90, 0)]
    [0.0, -0.7071, 0.0, 0.7071]
    """
    about_x, about_y, about_z = (_about(axis, -angle) for axis, angle in ((0, pitch), (1, yaw), (2, roll)))
    return times(times(about_y, about_x), about_z)


def times(second: Quaternion, first: Quaternion) -> Quaternion:
    """One rotation after another."""
    (ax, ay, az, aw), (bx, by, bz, bw) = second, first
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def back(rotation: Quaternion) -> Quaternion:
    """The rotation that undoes one."""
    x, y, z, w = rotation
    return -x, -y, -z, w


def share(rotation: Quaternion, part: float) -> Quaternion:
    """A part of a rotation, about the same axis: parts that add up to 1 make the whole, one after another.

    >>> share(turn(0, 60, 0), 0.5) == turn(0, 30, 0)
    True
    """
    x, y, z, w = rotation if rotation[3] >= 0 else tuple(-number for number in rotation)
    length = math.sqrt(x * x + y * y + z * z)
    if length == 0.0:
        return STILL
    half = math.atan2(length, w) * part
    factor = math.sin(half) / length
    return x * factor, y * factor, z * factor, math.cos(half)


def _about(axis: int, degrees: float) -> Quaternion:
    half = math.radians(degrees) / 2
    parts = [0.0, 0.0, 0.0]
    parts[axis] = math.sin(half)
    return parts[0], parts[1], parts[2], math.cos(half)
