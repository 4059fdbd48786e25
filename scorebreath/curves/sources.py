"""What the channels are computed from: one body's events."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.curves.breathing import Breathing, breathing
from scorebreath.curves.levels import BreathLevel, SpeechLevel, breath_level, speech_level
from scorebreath.curves.lips.lips import Lips, lips
from scorebreath.curves.looks.looks import Looks, looks
from scorebreath.curves.nose_and_mouth import FaceShape, face_shape
from scorebreath.curves.tracks import Acts
from scorebreath.score.document import Body, Score
from scorebreath.score.events import Expiration, Inspiration


@dataclass(frozen=True, slots=True, kw_only=True)
class Levels:
    """What is heard of a body: closed forms of what sounds, nothing of which is seen coming."""

    speech: SpeechLevel
    breath: BreathLevel


@dataclass(frozen=True, slots=True, kw_only=True)
class Sources:
    """A body's events, sorted and as arrays."""

    duration: float
    """s, of the Score"""
    breathing: Breathing
    nostrils: FaceShape
    mouth: FaceShape
    speech: SpeechLevel
    breath: BreathLevel
    lips: Lips
    looks: Looks


def levels(score: Score, body: Body) -> Levels:
    """Read what is heard of one body, cuts and moves of parameters among it.

    Raises:
        ScoreError: Utterances overlap, or a noise is longer than its breath.
    """
    return Levels(
        speech=speech_level(score, body.id, body.voice.reference_db),
        breath=breath_level(score, body.id),
    )


def sources(acts: Acts, body: Body, duration: float, heard: Levels) -> Sources:
    """Read one body's events, none of them a cut.

    Raises:
        ScoreError: Events contradict each other, or leave their own reach.
    """
    breaths = [e for e in acts.events if isinstance(e, Inspiration | Expiration) and e.body == body.id]
    return Sources(
        duration=duration,
        breathing=breathing(acts, body.id, body.person),
        nostrils=face_shape(breaths, "nostril"),
        mouth=face_shape(breaths, "mouth"),
        speech=heard.speech,
        breath=heard.breath,
        lips=lips(acts, body.id),
        looks=looks(acts, body.id),
    )
