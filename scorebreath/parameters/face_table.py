"""The table's rows of the face: how often, how far, how long.

A rate whose default is None follows from `face`, see `parameters.faces`, until it is set by hand.
"""

from __future__ import annotations

from typing import Literal

from scorebreath.parameters.row import row
from scorebreath.parameters.voice_table import VoiceTable

FACES = ("restrained", "albrecht-2002")
"""The ways a face can behave, each a table of `faces.toml`."""


class FaceTable(VoiceTable):
    """What moves lids, brows, head and eyes."""

    face: Literal["restrained", "albrecht-2002"] = row(
        "restrained", "How often and how much the face moves: as people do, or at the rates of S3",
        level="face", source="physiology 7.5; S3 6.1",
    )  # fmt: skip
    blink_interval: float | None = row(
        None, "Mean time between blinks that come by themselves", unit="s", low=0.5, high=60,
        level="face", source="A21; physiology 7.5 (Bentivoglio 1997)",
    )  # fmt: skip
    blink_at_pause: float | None = row(
        None, "Share of pauses with a blink", low=0, high=1, level="face", source="A20; physiology 7.5",
    )  # fmt: skip
    blink_double: float | None = row(
        None, "Share of blinks that are followed by another one at once", low=0, high=1,
        level="face", source="physiology 7.5",
    )  # fmt: skip
    brow_at_maximum: float | None = row(
        None, "Share of pitch maxima with a raise of the brows", low=0, high=1,
        level="face", source="A28, Y4 (Cave 1996); physiology 7.5",
    )  # fmt: skip
    brow_interval: float | None = row(
        None, "Least time between two raises of the brows", unit="s", low=0, high=60,
        level="face", source="physiology 7.5",
    )  # fmt: skip
    brow_per_minute: float | None = row(
        None, "The most raises of the brows within a minute", low=0, high=600,
        level="face", source="physiology 7.5",
    )  # fmt: skip
    brow_height: float | None = row(
        None, "Raise of the right brow, and the left one's at an accent of usual height", low=0, high=1,
        level="face", source="A29, Y1; physiology 7.5",
    )  # fmt: skip
    head_per_semitone: float | None = row(
        None, "Head raised at a pitch maximum, for each semitone above the voice's low tone", unit="deg/st", low=0,
        high=5, level="face", source="A25, Y1; physiology 7.5",
    )  # fmt: skip
    head_highest: float | None = row(
        None, "The most that an accent raises the head", unit="deg", low=0, high=20,
        level="face", source="Y1; physiology 7.5",
    )  # fmt: skip
    head_at_maximum: float | None = row(
        None, "Share of pitch maxima at which the head is raised", low=0, high=1,
        level="face", source="A25; physiology 7.5",
    )  # fmt: skip
    roll_at_raise: float | None = row(
        None, "Share of the head's raises that are rolled to a side", low=0, high=1,
        level="face", source="A27",
    )  # fmt: skip
    roll_angle: float | None = row(
        None, "How far they are rolled", unit="deg", low=0, high=20, level="face", source="Y1; physiology 7.5",
    )  # fmt: skip
    question_raise: float | None = row(
        None, "Head raised on the last word of a question", unit="deg", low=0, high=20,
        level="face", source="A23, Y1",
    )  # fmt: skip
    question_brow: float | None = row(
        None, "Brows raised on the last word of a question", low=0, high=1,
        level="face", source="A23, Y1; physiology 7.5",
    )  # fmt: skip
    glance_at_accent: float | None = row(
        None, "Share of accented syllables with a glance at the listener", low=0, high=1,
        level="face", source="A31",
    )  # fmt: skip
    glance_at_pause: float | None = row(
        None, "Share of pauses between phrases with a glance at the listener", low=0, high=1,
        level="face", source="A34",
    )  # fmt: skip
    look_at_listener: float | None = row(
        None, "Share of speaking time for which the eyes are at the listener, at least: glances add to it",
        low=0, high=1,
        level="face", source="physiology 7.5 (Argyle & Cook 1976: 41 %)",
    )  # fmt: skip
    look_when_silent: float | None = row(
        None, "Share of the time for which somebody who does not speak looks at the other", low=0, high=1,
        level="face", source="physiology 7.5 (Argyle & Cook 1976: 75 %)",
    )  # fmt: skip
    gaze_range: float | None = row(
        None, "How far small random shifts of gaze go", unit="deg", low=0, high=10,
        level="face", source="A35; physiology 7.5",
    )  # fmt: skip
    gaze_away: float | None = row(
        None, "How far the eyes look away from the listener", unit="deg", low=0, high=25,
        level="face", source="physiology 7.5 (Andrist 2014: 8 to 12)",
    )  # fmt: skip
    word_search: float | None = row(
        None, "Share of searches for a word that are seen", low=0, high=1,
        level="face", source="A32, A33, Y2",
    )  # fmt: skip
    emotion_breath: float = row(
        0.6, "How much an emotion moves the breath, too; 0: not at all", low=0, high=1,
        level="face", source="B60; physiology 4.2",
    )  # fmt: skip
    face_blinks: bool = row(True, "Whether blinks are seen; nothing else changes", level="output", source="A60")
    face_brows: bool = row(True, "Whether brows move; nothing else changes", level="output", source="A60")
    face_head: bool = row(
        True, "Whether speech moves the head; the breath still does, and nothing else changes",
        level="output", source="A60",
    )  # fmt: skip
    face_gaze: bool = row(True, "Whether the eyes move; nothing else changes", level="output", source="A60")
    face_emotion: bool = row(True, "Whether emotions are seen; nothing else changes", level="output", source="A60")
