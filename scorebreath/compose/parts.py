"""Events that every breathing model makes alike."""

from __future__ import annotations

from scorebreath import chance
from scorebreath.compose.state import BodyState, Spoken
from scorebreath.equations.breath import mix_level, trapezoid
from scorebreath.parameters.derive import LowLevel
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup
from scorebreath.score.events import Closing, Motion, Noise, Trapezoid, Utterance
from scorebreath.units import decibels, snap

MOTIONLESS = Motion(thorax=0.0, abdomen=0.0, shoulder=0.0, neck_pitch=0.0)


def ramps(length: float) -> Trapezoid:
    """The trapezoid of a breath, its three parts on the grid and exactly `length` together."""
    attack, _, release = (snap(part) for part in trapezoid(length))
    return Trapezoid(attack=attack, hold=snap(length - attack - release), release=release)


def breath_noise(state: BodyState, spoken: Spoken, *, onset: float, length: float) -> Noise | None:
    """The audible part of an inspiration; None where breaths are not to be heard.

    The level is that of a unit gain, such that a breath at the default gains is at `breath_level` (physiology 3.2).
    """
    if not state.parameters.breath_sound:
        return None
    shape = ramps(length)
    return Noise(
        onset=snap(onset),
        duration=snap(length),
        attack=shape.attack,
        hold=shape.hold,
        release=shape.release,
        level_db=snap(state.parameters.breath_level - _default_mix()),
        seed=chance.engine_seed(state.seed, state.body, "inspiration.noise", spoken.place),
    )


def face(state: BodyState, low: LowLevel) -> tuple[float, float]:
    """Maxima of nostril flare and mouth opening (B33, B34); 0 where breaths are not to be seen."""
    if not state.parameters.breath_motion:
        return 0.0, 0.0
    return snap(low.amplitude_nostril_flare), snap(low.amplitude_mouth_open)


def utterance(state: BodyState, spoken: Spoken, low: LowLevel, onset: float) -> Utterance:
    """The speech of a group (B12)."""
    speech = spoken.speech
    return Utterance(
        id=f"{spoken.id}.speech",
        body=state.body,
        group=spoken.id,
        onset=onset,
        duration=snap(speech.duration),
        rule="speech",
        media=spoken.media,
        gain_db=snap(decibels(low.prosody_loudness / 100.0)),
        closing=closing(spoken.group),
        words=speech.words,
        phones=speech.phones,
        pitch=speech.pitch,
        level=speech.level,
    )


def closing(group: BreathGroup) -> Closing:
    """How a group ends: its sentence with it, asking or not, or in the midst of it."""
    if not group.ends_sentence:
        return "continuing"
    return "question" if group.sentence_type == "question" else "final"


def _default_mix() -> float:
    share = float(Parameters.model_fields["nose_share"].default)
    return mix_level(1.0 - share, share)
