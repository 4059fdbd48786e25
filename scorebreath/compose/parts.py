"""What every breathing model makes alike."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from scorebreath import chance
from scorebreath.compose.sounds import default_mix, sources
from scorebreath.compose.state import BodyState, Spoken, SpokenPart
from scorebreath.compose.wording import accented
from scorebreath.equations.breath import trapezoid
from scorebreath.parameters.derive import LowLevel, derive
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, Part
from scorebreath.score.document import Person
from scorebreath.score.events import Closing, Motion, Noise, Trapezoid, Utterance
from scorebreath.units import decibels, snap

MOTIONLESS = Motion(thorax=0.0, abdomen=0.0, shoulder=0.0, neck_pitch=0.0)
FULL_SHARE = {"thorax": 0.65, "abdomen": 0.35}
"""Shares at which a full inspiration is a weight of 1 (physiology 2.3)."""
SHOULDER = 0.5
"""Shoulder weight of a full inspiration in quiet speech (physiology 2.4: 10 of 20 mm)."""


@lru_cache(maxsize=256)
def low_level(p: Parameters, nose_share: float, abdomen_share: float) -> LowLevel:
    """Eq. 1 with the shares of the moment."""
    if (nose_share, abdomen_share) != (p.nose_share, p.abdomen_share):
        p = p.model_copy(update={"nose_share": nose_share, "abdomen_share": abdomen_share})
    return derive(p)


def ramps(length: float) -> Trapezoid:
    """The trapezoid of a breath, its three parts on the grid and exactly `length` together."""
    attack, _, release = (snap(part) for part in trapezoid(length))
    return Trapezoid(attack=attack, hold=snap(length - attack - release), release=release)


def trapezoid_noise(state: BodyState, spoken: Spoken, *, onset: float, length: float) -> Noise | None:
    """The papers' sound of an inspiration (B46); None where breaths are not to be heard.

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
        level_db=snap(state.parameters.breath_level - default_mix()),
        seed=chance.engine_seed(state.seed, state.body, "inspiration.noise", spoken.place),
        **sources(state, spoken.place, "mouth"),
        brightness=snap(state.parameters.breath_brightness),
    )


def face(p: Parameters, low: LowLevel, *, flare: float = 1.0, opening: float = 1.0) -> tuple[float, float]:
    """Maxima of nostril flare and mouth opening (B33, B34); 0 where breaths are not to be seen.

    Args:
        p: Says whether they are seen.
        low: The maxima of an ordinary breath.
        flare: x nostril flare.
        opening: x mouth opening.
    """
    if not p.breath_motion:
        return 0.0, 0.0
    return snap(min(1.0, low.amplitude_nostril_flare * flare)), snap(min(1.0, low.amplitude_mouth_open * opening))


def motion(p: Parameters, low: LowLevel, person: Person, tremor: float) -> Motion:
    """Weights for one unit of volume: 1 for a full inspiration at the default share, scaled by `motion_gain`."""
    if not p.breath_motion:
        return MOTIONLESS
    full = p.motion_gain / (1.0 - person.resting_volume)
    breath = p.volume_per_syllable * p.norm_syllables
    return Motion(
        thorax=snap(full * low.volume_thorax / FULL_SHARE["thorax"]),
        abdomen=snap(full * low.volume_abdomen / FULL_SHARE["abdomen"]),
        shoulder=snap(full * SHOULDER),
        neck_pitch=snap(p.motion_gain * p.amplitude_neck_motion / breath),
        tremor=snap(tremor),
    )


def utterance(
    state: BodyState, spoken: Spoken, said: SpokenPart, *, low: LowLevel, onset: float, number: int = 0
) -> Utterance:
    """The speech of a group, or of a part of it (B12)."""
    speech, prosody = said.speech, said.part.prosody
    words = accented(speech, said.part, state.language)
    if prosody is not None and prosody.emphasis:
        words = tuple(replace(word, accent=True) for word in words)
    louder = prosody.volume_db if prosody is not None else 0.0
    return Utterance(
        id=f"{spoken.id}.speech" + (f"{number + 1}" if number else ""),
        body=state.body,
        group=spoken.id,
        onset=onset,
        duration=snap(speech.duration),
        rule="speech" if prosody is None else f"speech {prosody.written}",
        media=said.media,
        gain_db=snap(decibels(low.prosody_loudness / 100.0) + louder + said.gain_db),
        closing=closing(said.part),
        words=words,
        phones=speech.phones,
        pitch=speech.pitch,
        level=speech.level,
    )


def closing(said: BreathGroup | Part) -> Closing:
    """How it ends: its sentence with it, asking or not, or in the midst of it."""
    if not said.ends_sentence:
        return "continuing"
    return "question" if said.sentence_type == "question" else "final"
