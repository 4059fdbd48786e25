"""Where the bones of a character rest: VMC sends a bone's place with its rotation, and receivers take both.

Read from the character's own .vrm or .glb (VRM 0 and 1), in Unity's axes; or a common one, for receivers that leave
bones where they are (most do, but for the hips).
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from scorebreath.errors import InputError
from scorebreath.live.streams.turning import STILL, Quaternion, Vector, times

LARGEST_JSON = 64 * 2**20
"""Bytes of a model's description that are read at most."""
FARTHEST = 100.0
"""Metres from a bone to its parent at most."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rest:
    """How a bone rests."""

    place: Vector
    """m from its parent, in the parent's axes"""
    turned: Quaternion = STILL
    """against its parent"""
    parent: Quaternion = STILL
    """how its parent is turned in the character's axes"""


COMMON: Mapping[str, Rest] = MappingProxyType(
    {
        "Chest": Rest(place=(0.0, 0.12, 0.0)),
        "UpperChest": Rest(place=(0.0, 0.12, 0.0)),
        "Neck": Rest(place=(0.0, 0.13, -0.02)),
        "Head": Rest(place=(0.0, 0.08, 0.01)),
        "LeftShoulder": Rest(place=(-0.02, 0.10, -0.01)),
        "RightShoulder": Rest(place=(0.02, 0.10, -0.01)),
        "LeftEye": Rest(place=(-0.02, 0.06, 0.07)),
        "RightEye": Rest(place=(0.02, 0.06, 0.07)),
    }
)
"""Of nobody: a grown figure of 1.6 m, roughly."""


def of_model(path: str) -> dict[str, Rest]:
    """The bones of a VRM by their names in Unity, such as `UpperChest`.

    Args:
        path: Of a .vrm, or of a .glb with one of VRM's extensions.

    Raises:
        InputError: It cannot be read, or is no VRM.
    """
    try:
        with Path(path).open("rb") as stream:
            magic, _, _, size, kind = struct.unpack("<4sIIII", stream.read(20))
            if magic != b"glTF" or kind != 0x4E4F534A or size > LARGEST_JSON:
                raise ValueError("it does not begin like a .glb")
            document = json.loads(stream.read(size).decode("utf-8"))
        bones, mirrored = _named(document)
        return _resting(document["nodes"], bones, mirrored)
    except (OSError, struct.error, ValueError, RecursionError, LookupError, TypeError, AttributeError) as error:
        why = error if isinstance(error, OSError | ValueError) else "it is no VRM, or a broken one"
        raise InputError(f"model={path!r} cannot be read: {why}; expected the .vrm of the character") from None


def _named(document: Mapping[str, Any]) -> tuple[dict[str, int], int]:
    """Bone to node, and the axis of glTF that is the other way round in Unity."""
    extensions = document.get("extensions", {})
    if "VRMC_vrm" in extensions:
        found = extensions["VRMC_vrm"]["humanoid"]["humanBones"].items()
        return {_unity(name): _index(bone["node"]) for name, bone in found}, 0
    if "VRM" in extensions:
        listed = extensions["VRM"]["humanoid"]["humanBones"]
        return {_unity(bone["bone"]): _index(bone["node"]) for bone in listed}, 2
    raise ValueError("it has no extension VRMC_vrm or VRM")


def _unity(name: str) -> str:
    return name[:1].upper() + name[1:]


def _index(value: object) -> int:
    if not isinstance(value, int) or value < 0:
        raise ValueError(f"node {value!r} is no number of a node")
    return value


def _resting(nodes: list[Mapping[str, Any]], bones: Mapping[str, int], mirrored: int) -> dict[str, Rest]:
    above = {_index(child): number for number, node in enumerate(nodes) for child in node.get("children", ())}
    found = {}
    for name, number in bones.items():
        turned, node, seen = STILL, above.get(number), 0
        while node is not None:
            turned = times(_rotation(nodes[node], mirrored), turned)
            node, seen = above.get(node), seen + 1
            if seen > len(nodes):
                raise ValueError("a node is its own parent")
        place = _numbers(nodes[number].get("translation", (0.0, 0.0, 0.0)), 3)
        if max(map(abs, place)) > FARTHEST:
            raise ValueError(f"{name} is more than {FARTHEST:g} m away from its parent")
        x, y, z = (-value if axis == mirrored else value for axis, value in enumerate(place))
        found[name] = Rest(place=(x, y, z), turned=_rotation(nodes[number], mirrored), parent=turned)
    return found


def _rotation(node: Mapping[str, Any], mirrored: int) -> Quaternion:
    """Of a node against its parent: what turns about the mirrored axis does so as before, all else the other way."""
    if "matrix" in node:
        raise ValueError("a node has a matrix; expected translation and rotation, as VRM wants")
    values = _numbers(node.get("rotation", STILL), 4)
    x, y, z = (value if axis == mirrored else -value for axis, value in enumerate(values[:3]))
    length = math.hypot(*values)
    if not 0.5 < length < 2.0:
        raise ValueError("a rotation is none")
    return x / length, y / length, z / length, values[3] / length


def _numbers(values: Any, count: int) -> list[float]:
    numbers = [float(value) for value in values]
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        raise ValueError(f"{values!r:.60} are not {count} numbers")
    return numbers
