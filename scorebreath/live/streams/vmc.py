"""Virtual Motion Capture protocol (OSC): expressions of a VRM, Perfect Sync, the breath, and bones if asked for.

    /VMC/Ext/OK ,iiii 1 3 0 1         /VMC/Ext/T ,f seconds of the performance
    /VMC/Ext/Bone/Pos ,sfffffff bone, place x y z, rotation x y z w
    /VMC/Ext/Blend/Val ,sf name value ...         /VMC/Ext/Blend/Apply

A picture is a bundle, or several where it has more than 1400 bytes, each complete; Apply comes last. Names are
case-sensitive, and receivers leave alone what the model does not have. Bundles say `at once`: a receiver that heeded
another time would hold them back.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Literal

from scorebreath.engine.osc import message
from scorebreath.errors import InputError, did_you_mean
from scorebreath.live.picture import Picture
from scorebreath.live.streams.datagrams import AT_ONCE, Datagrams, bundles
from scorebreath.live.streams.skeleton import Rest
from scorebreath.live.streams.turning import Quaternion, back, share, times, turn

NAMES = ("vrm0", "vrm1", "both")
SHAPES = ("presets", "arkit", "both")
CASES = ("pascal", "camel")
From = Literal["channel", "arkit", "oculus"]


@dataclass(frozen=True, slots=True)
class Preset:
    """An expression that every VRM has, or may have."""

    vrm0: str
    vrm1: str
    source: From
    column: str
    """of the channels, or of that rig"""


PRESETS = (
    Preset("A", "aa", "oculus", "aa"),
    Preset("I", "ih", "oculus", "ih"),
    Preset("U", "ou", "oculus", "ou"),
    Preset("E", "ee", "oculus", "E"),
    Preset("O", "oh", "oculus", "oh"),
    Preset("Blink_L", "blinkLeft", "arkit", "eyeBlinkLeft"),
    Preset("Blink_R", "blinkRight", "arkit", "eyeBlinkRight"),
    Preset("Joy", "happy", "channel", "emotion_happy"),
    Preset("Angry", "angry", "channel", "emotion_angry"),
    Preset("Sorrow", "sad", "channel", "emotion_sad"),
    Preset("Fun", "relaxed", "channel", "emotion_kidding"),
    Preset("Surprised", "surprised", "channel", "emotion_surprised"),
    Preset("LookUp", "lookUp", "arkit", "eyeLookUpLeft"),
    Preset("LookDown", "lookDown", "arkit", "eyeLookDownLeft"),
    Preset("LookLeft", "lookLeft", "arkit", "eyeLookOutLeft"),
    Preset("LookRight", "lookRight", "arkit", "eyeLookInLeft"),
)
"""Blink is not sent beside Blink_L and Blink_R, which would shut the lids twice."""
PERFECT_SYNC = 52
"""The first columns of the rig `arkit` are clips of Perfect Sync."""
BREATH = ("nostrilDilateLeft", "nostrilDilateRight", "thorax", "abdomen", "shoulder")
"""Columns of the rig `arkit` that VRM has no names for: clips that a model may have been given."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Move:
    """How a bone moves: degrees for each channel, and what part of the head's turn is its own."""

    pitch: Mapping[str, float] = field(default_factory=dict)
    yaw: Mapping[str, float] = field(default_factory=dict)
    roll: Mapping[str, float] = field(default_factory=dict)
    head: float = 0.0

    def rotation(self, channels: Mapping[str, float]) -> Quaternion:
        """Its rotation against rest, in the character's axes."""
        pitch, yaw, roll = (
            sum(factor * channels[name] for name, factor in angle.items())
            for angle in (self.pitch, self.yaw, self.roll)
        )
        if self.head:
            whole = turn(channels["head_pitch"], channels["head_yaw"], channels["head_roll"])
            return share(whole, self.head)
        return turn(pitch, yaw, roll)


_EYE = Move(pitch={"eye_pitch": 1.0}, yaw={"eye_yaw": 1.0})
BONES: Mapping[str, Move] = MappingProxyType(
    {
        "Chest": Move(pitch={"thorax": 1.0}),
        "UpperChest": Move(pitch={"thorax": 1.5}),
        "Neck": Move(head=0.4),
        "Head": Move(head=0.6),
        "LeftShoulder": Move(roll={"shoulder": 6.0}),
        "RightShoulder": Move(roll={"shoulder": -6.0}),
        "LeftEye": _EYE,
        "RightEye": _EYE,
    }
)
"""Neck and head share the head's turn. The degrees of chest and shoulders are chosen by eye."""


class VmcTarget:
    """A receiver of VMC.

    Args:
        name: What it is, for people.
        datagrams: Where to.
        names: Of presets, one of `NAMES`.
        shapes: Which expressions, one of `SHAPES`. Both at once move the mouth of a Perfect Sync model twice.
        case: One of `CASES`: `JawOpen` or `jawOpen`.
        bones: Where bones rest; None: no bones are sent.

    Raises:
        InputError: An option is none of those.
    """

    def __init__(
        self, name: str, datagrams: Datagrams, *, names: str = "vrm0", shapes: str = "presets", case: str = "pascal",
        bones: Mapping[str, Rest] | None = None,
    ) -> None:  # fmt: skip
        """Look at the options."""
        for option, value, known in (("names", names, NAMES), ("shapes", shapes, SHAPES), ("case", case, CASES)):
            if value not in known:
                hint = did_you_mean(value, known)
                raise InputError(f"{name}: {option}={value!r}; expected {', '.join(known)}{hint}")
        self._name, self._datagrams = name, datagrams
        self._names, self._shapes, self._case, self._bones = names, shapes, case, bones

    @property
    def name(self) -> str:
        """What it is, for people."""
        return self._name

    def send(self, picture: Picture) -> None:
        """Send one picture.

        Raises:
            OSError: The network refused it.
        """
        self._datagrams.send(
            packets(picture, names=self._names, shapes=self._shapes, case=self._case, bones=self._bones)
        )

    def close(self) -> None:
        """Close the socket."""
        self._datagrams.close()


def packets(
    picture: Picture, *, names: str = "vrm0", shapes: str = "presets", case: str = "pascal",
    bones: Mapping[str, Rest] | None = None,
) -> list[bytes]:  # fmt: skip
    """A picture's bundles, to be sent in this order."""
    told = [message("/VMC/Ext/OK", 1, 3, 0, 1), message("/VMC/Ext/T", float(picture.time))]
    if bones is not None:
        found = pose(picture.channels, bones)
        told += [message("/VMC/Ext/Bone/Pos", bone, *rest.place, *turned) for bone, (rest, turned) in found.items()]
    values = expressions(picture, names=names, shapes=shapes, case=case)
    told += [message("/VMC/Ext/Blend/Val", name, value) for name, value in values.items()]
    return bundles(AT_ONCE, (), [*told, message("/VMC/Ext/Blend/Apply")])


def expressions(
    picture: Picture, *, names: str = "vrm0", shapes: str = "presets", case: str = "pascal"
) -> dict[str, float]:
    """Every expression by the name under which it is sent."""
    sources: dict[From, Callable[[], Mapping[str, float]]] = {
        "channel": lambda: picture.channels,
        "arkit": lambda: picture.rig("arkit"),
        "oculus": lambda: picture.rig("oculus"),
    }
    found: dict[str, float] = {}
    if shapes != "arkit":
        for preset in PRESETS:
            value = sources[preset.source]()[preset.column]
            found |= dict.fromkeys(_names(preset, names), value)
    apple = picture.rig("arkit")
    columns = (*(list(apple)[:PERFECT_SYNC] if shapes != "presets" else ()), *BREATH)
    return found | {_cased(column, case): apple[column] for column in columns}


def pose(channels: Mapping[str, float], bones: Mapping[str, Rest]) -> dict[str, tuple[Rest, Quaternion]]:
    """Every bone of the character that we move: how it rests, and its rotation now, against its parent's axes."""
    found = {}
    for name, move in BONES.items():
        if name not in bones:
            continue
        if name == "Head" and "Neck" not in bones:
            move = Move(head=1.0)  # noqa: PLW2901 - a head without a neck turns alone
        rest = bones[name]
        moved = times(times(back(rest.parent), move.rotation(channels)), rest.parent)
        found[name] = rest, times(moved, rest.turned)
    return found


def _names(preset: Preset, names: str) -> tuple[str, ...]:
    return {"vrm0": (preset.vrm0,), "vrm1": (preset.vrm1,), "both": (preset.vrm0, preset.vrm1)}[names]


def _cased(name: str, case: str) -> str:
    return name if case == "camel" else name[:1].upper() + name[1:]
