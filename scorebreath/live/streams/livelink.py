"""Live Link Face, version 6: the datagram that Epic's app sends to Unreal, one a picture.

    u8 6 | i32 36, 36 characters: id of the device | i32 n, n bytes: name of the subject
    i32 frame | f32 part of a frame | i32 rate | i32 1 | u8 61 | 61 x f32              (big endian, 306 + n bytes)

52 shapes in the order of Unreal's enumeration, which has the left before the right where the app's CSV has the
opposite, then nine angles. Signs and units are those of the rig `livelink`, as in the CSV.
"""

from __future__ import annotations

import math
import struct
import uuid
from collections.abc import Mapping
from types import MappingProxyType

from scorebreath.errors import InputError
from scorebreath.live.picture import Picture
from scorebreath.live.streams.datagrams import Datagrams

VERSION = 6
ORDER = (
    "EyeBlinkLeft", "EyeLookDownLeft", "EyeLookInLeft", "EyeLookOutLeft", "EyeLookUpLeft", "EyeSquintLeft",
    "EyeWideLeft", "EyeBlinkRight", "EyeLookDownRight", "EyeLookInRight", "EyeLookOutRight", "EyeLookUpRight",
    "EyeSquintRight", "EyeWideRight", "JawForward", "JawLeft", "JawRight", "JawOpen", "MouthClose", "MouthFunnel",
    "MouthPucker", "MouthLeft", "MouthRight", "MouthSmileLeft", "MouthSmileRight", "MouthFrownLeft", "MouthFrownRight",
    "MouthDimpleLeft", "MouthDimpleRight", "MouthStretchLeft", "MouthStretchRight", "MouthRollLower", "MouthRollUpper",
    "MouthShrugLower", "MouthShrugUpper", "MouthPressLeft", "MouthPressRight", "MouthLowerDownLeft",
    "MouthLowerDownRight", "MouthUpperUpLeft", "MouthUpperUpRight", "BrowDownLeft", "BrowDownRight", "BrowInnerUp",
    "BrowOuterUpLeft", "BrowOuterUpRight", "CheekPuff", "CheekSquintLeft", "CheekSquintRight", "NoseSneerLeft",
    "NoseSneerRight", "TongueOut", "HeadYaw", "HeadPitch", "HeadRoll", "LeftEyeYaw", "LeftEyePitch", "LeftEyeRoll",
    "RightEyeYaw", "RightEyePitch", "RightEyeRoll",
)  # fmt: skip
"""The values of a datagram."""
SHAPES = 52
"""How many of them are shapes; the others are angles."""
ANGLES: Mapping[str, float] = MappingProxyType(
    {"radians": 1.0, "degrees": 180.0 / math.pi, "half-turns": 1.0 / math.pi}
)
"""What an angle in radians is multiplied by. The app's takes have radians; Unreal's own sender has half turns."""
LONGEST_NAME = 200
"""Bytes of a subject's name."""
_IDS = uuid.UUID("5c0e6e2b-7a8b-5f53-8a0f-2b3b9d4fd0a1")


class LiveLinkTarget:
    """A receiver of Live Link Face: each body is a subject of its own.

    Args:
        name: What it is, for people.
        datagrams: Where to.
        rate: Frames a second that frame numbers count.
        angles: One of `ANGLES`.

    Raises:
        InputError: `angles` is none of them.
    """

    def __init__(self, name: str, datagrams: Datagrams, *, rate: int = 60, angles: str = "radians") -> None:
        """Look at the options."""
        if angles not in ANGLES:
            raise InputError(f"{name}: angles={angles!r}; expected {', '.join(ANGLES)}")
        self._name, self._datagrams, self._rate, self._factor = name, datagrams, rate, ANGLES[angles]

    @property
    def name(self) -> str:
        """What it is, for people."""
        return self._name

    def send(self, picture: Picture) -> None:
        """Send one picture.

        Raises:
            OSError: The network refused it.
        """
        self._datagrams.send([packet(picture, rate=self._rate, factor=self._factor)])

    def close(self) -> None:
        """Close the socket."""
        self._datagrams.close()


def packet(picture: Picture, *, rate: int = 60, factor: float = 1.0) -> bytes:
    """A picture's datagram; angles are multiplied by `factor`."""
    subject = picture.name.encode("utf-8", "replace")[:LONGEST_NAME].decode("utf-8", "ignore").encode("utf-8")
    device = str(uuid.uuid5(_IDS, picture.name)).encode("ascii")
    frame, part = frame_time(picture.time, rate)
    shown = picture.rig("livelink")
    values = [shown[name] * (factor if number >= SHAPES else 1.0) for number, name in enumerate(ORDER)]
    return b"".join(
        (
            struct.pack(">Bi", VERSION, len(device)), device,
            struct.pack(">i", len(subject)), subject,
            struct.pack(">ifii", frame, part, rate, 1),
            struct.pack(f">B{len(ORDER)}f", len(ORDER), *values),
        )
    )  # fmt: skip


def frame_time(seconds: float, rate: int) -> tuple[int, float]:
    """A time as a whole frame and the part of the next that is over, in millionths.

    >>> frame_time(1.5, 60), frame_time(0.025, 60), frame_time(1 / 60, 60)
    ((90, 0.0), (1, 0.5), (1, 0.0))
    """
    frame, part = divmod(round(seconds * rate * 1_000_000), 1_000_000)
    return frame & 0x7FFFFFFF, part / 1_000_000
