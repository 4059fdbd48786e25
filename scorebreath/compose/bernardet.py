"""The control model of Bernardet et al. (S1 3.2, S2 2.2): inspiration and expiration oscillate (B3).

The driver d is a saw-tooth: it rises from 0 with slope volume_lung / length_inspiration (B6) and falls back to 0 with
slope volume_lung / length_speech while the group is spoken (B12, B14). It stands in the Score as lung volume above a
resting level of 0: the model knows no residual volume and carries nothing from breath to breath (X15). Speech begins
where the inspiration ends, and the next inspiration where speech ends.
"""

from __future__ import annotations

from dataclasses import replace

from scorebreath.compose import parts
from scorebreath.compose.state import BodyState, Spoken
from scorebreath.equations.bernardet import volume_lung
from scorebreath.parameters.derive import LowLevel, derive
from scorebreath.parameters.physique import physique
from scorebreath.parameters.table import Parameters
from scorebreath.score.document import Person
from scorebreath.score.events import Event, Expiration, Inspiration, Lead, Motion
from scorebreath.units import snap


def person(parameters: Parameters) -> Person:
    """A body at whose rest the driver is 0."""
    return Person(vital_capacity=snap(physique(parameters).vital_capacity), resting_volume=0.0)


def step(state: BodyState, spoken: Spoken) -> tuple[BodyState, list[Event]]:
    """Place one group: breathe in, then speak while breathing out."""
    p, low = state.parameters, derive(state.parameters)
    syllables = spoken.group.syllables
    volume = snap(volume_lung(p.capacity_lung, syllables, low.length_utterance))
    length = snap(low.length_inspiration)
    speech = parts.utterance(state, spoken, low, snap(state.time + length))
    nostril_flare, mouth_open = parts.face(state, low)
    moved = motion(p, low)
    share = snap(1.0 - p.abdomen_share)
    inspiration = Inspiration(
        id=f"{spoken.id}.in",
        body=state.body,
        group=spoken.id,
        onset=state.time,
        duration=length,
        rule=f"B6 B7: {syllables} of {low.length_utterance:g} syllables",
        from_volume=0.0,
        to_volume=volume,
        thorax_share=share,
        motion=moved,
        sound_nose=snap(low.amplitude_sound_nose),
        sound_mouth=snap(low.amplitude_sound_mouth),
        nostril_flare=nostril_flare,
        mouth_open=mouth_open,
        face=parts.ramps(length),
        lead=Lead(),
        noise=parts.breath_noise(state, spoken, onset=0.0, length=length),
    )
    expiration = Expiration(
        id=f"{spoken.id}.out",
        body=state.body,
        group=spoken.id,
        onset=speech.onset,
        duration=speech.duration,
        rule="B12",
        from_volume=volume,
        to_volume=0.0,
        thorax_share=share,
        motion=moved,
    )
    after = replace(state, time=snap(speech.end), volume=0.0, site=spoken.group.cut.site)
    return after, [inspiration, speech, expiration]


def finish(state: BodyState) -> tuple[BodyState, list[Event]]:
    """Nothing: the driver is back at 0."""
    return state, []


def motion(p: Parameters, low: LowLevel) -> Motion:
    """What d moves (B6, B8): thorax = volume_thorax * d, abdomen = volume_abdomen * d, head likewise."""
    if not p.breath_motion:
        return parts.MOTIONLESS
    return Motion(
        thorax=snap(p.motion_gain * low.volume_thorax),
        abdomen=snap(p.motion_gain * low.volume_abdomen),
        shoulder=0.0,
        neck_pitch=snap(p.motion_gain * p.amplitude_neck_motion),
    )
