"""The natural model, first version: lungs that start from rest, breaths that follow what is to be said.

A breath is as long and as deep as the coming group asks (physiology 1.3, 2.2); a short silence stands before and after
it (physiology 1.4); mouth and nostrils open ahead of the flow; the sound is shorter than the movement.
"""

from __future__ import annotations

from dataclasses import replace

from scorebreath import chance
from scorebreath.compose import parts
from scorebreath.compose.state import BodyState, Spoken
from scorebreath.equations.breath import initiation_volume, inspiration_length
from scorebreath.parameters.derive import LowLevel, derive
from scorebreath.parameters.physique import physique
from scorebreath.parameters.table import Parameters
from scorebreath.score.document import Person
from scorebreath.score.events import Event, Expiration, Hold, Inspiration, Lead, Motion, Pause, PauseKind
from scorebreath.units import snap

TERMINATION = 0.36
"""Where speech usually stops, fraction of VC (physiology 2.2; Hixon 1973)."""
SITE_FACTOR = {"word": 0.7, "phrase": 0.7, "paragraph": 1.15}
"""Inspirations are shorter where the text has no boundary, longer after a paragraph (physiology 1.3)."""
FACE_LEAD = 0.08
"""s that mouth and nostrils move ahead of the flow (physiology 6)."""
NOISE_DELAY = 0.04
"""s of flow too slow to be heard (physiology 1.4, 8)."""
FULL_SHARE = {"thorax": 0.65, "abdomen": 0.35}
"""Shares at which a full inspiration is a weight of 1 (physiology 2.3)."""
SHOULDER = 0.5
"""Shoulder weight of a full inspiration in quiet speech (physiology 2.4: 10 of 20 mm)."""
SMALLEST = 0.02
"""Volume of the smallest breath before speech, fraction of VC: below it nobody would breathe in."""
RELAXATION = 1.0
"""s from the last word back to rest."""


def person(parameters: Parameters) -> Person:
    """A body at rest."""
    body = physique(parameters)
    return Person(vital_capacity=snap(body.vital_capacity), resting_volume=snap(body.resting_volume))


def step(state: BodyState, spoken: Spoken) -> tuple[BodyState, list[Event]]:
    """Place one group: breathe in, wait an instant, speak, and be silent for as long as the boundary asks."""
    p, low = state.parameters, derive(state.parameters)
    moved, share = motion(p, low), snap(1.0 - p.abdomen_share)
    inspiration = _inspiration(state, spoken, low, moved, share)
    edge = snap(p.silence_after_breath)
    speech = parts.utterance(state, spoken, low, snap(inspiration.end + edge))
    expiration = Expiration(
        id=f"{spoken.id}.out",
        body=state.body,
        group=spoken.id,
        onset=speech.onset,
        duration=speech.duration,
        rule=f"physiology 2.2: {p.volume_per_syllable:g} VC a syllable",
        from_volume=inspiration.to_volume,
        to_volume=min(inspiration.to_volume, snap(TERMINATION)),
        thorax_share=share,
        motion=moved,
    )
    kind, silence = _silence(p, spoken)
    onset = snap(speech.end)

    def hold(name: str, onset: float, duration: float, volume: float) -> Hold:
        return Hold(
            id=f"{spoken.id}.{name}",
            body=state.body,
            group=spoken.id,
            onset=onset,
            duration=duration,
            rule="physiology 1.4",
            volume=volume,
            thorax_share=share,
            motion=moved,
        )

    pause = Pause(
        id=f"{spoken.id}.pause",
        body=state.body,
        group=spoken.id,
        onset=onset,
        duration=silence,
        rule=f"physiology 1.4: {kind}",
        kind=kind,
    )
    events: list[Event] = [
        inspiration,
        hold("ready", snap(inspiration.end), edge, inspiration.to_volume),
        speech,
        expiration,
        hold("rest", onset, silence, expiration.to_volume),
        pause,
    ]
    after = replace(state, time=snap(onset + silence), volume=expiration.to_volume, site=spoken.group.cut.site)
    return after, events


def finish(state: BodyState) -> tuple[BodyState, list[Event]]:
    """Back to rest after the last word: below the resting level the chest fills by its own recoil."""
    rest = state.person.resting_volume
    if state.volume == rest:
        return state, []
    p = state.parameters
    moved, share = motion(p, derive(p)), snap(1.0 - p.abdomen_share)
    rule = "physiology 2.2: to the resting level"
    event: Event
    if state.volume > rest:
        event = Expiration(
            id=f"{state.body}.rest",
            body=state.body,
            onset=state.time,
            duration=RELAXATION,
            rule=rule,
            kind="tidal",
            from_volume=state.volume,
            to_volume=rest,
            profile="sine",
            thorax_share=share,
            motion=moved,
        )
    else:
        event = Inspiration(
            id=f"{state.body}.rest",
            body=state.body,
            onset=state.time,
            duration=RELAXATION,
            rule=rule,
            kind="tidal",
            from_volume=state.volume,
            to_volume=rest,
            profile="sine",
            thorax_share=share,
            motion=moved,
            sound_nose=0.0,
            sound_mouth=0.0,
            nostril_flare=0.0,
            mouth_open=0.0,
            face=parts.ramps(RELAXATION),
            lead=Lead(),
        )
    return replace(state, time=snap(state.time + RELAXATION), volume=rest), [event]


def motion(p: Parameters, low: LowLevel) -> Motion:
    """Weights for one unit of volume: 1 for a full inspiration at the default share, scaled by `motion_gain`."""
    if not p.breath_motion:
        return parts.MOTIONLESS
    full = p.motion_gain / (1.0 - physique(p).resting_volume)
    breath = p.volume_per_syllable * p.norm_syllables
    return Motion(
        thorax=snap(full * low.volume_thorax / FULL_SHARE["thorax"]),
        abdomen=snap(full * low.volume_abdomen / FULL_SHARE["abdomen"]),
        shoulder=snap(full * SHOULDER),
        neck_pitch=snap(p.motion_gain * p.amplitude_neck_motion / breath),
    )


def _inspiration(state: BodyState, spoken: Spoken, low: LowLevel, moved: Motion, share: float) -> Inspiration:
    p, syllables = state.parameters, spoken.group.syllables
    draw = float(chance.stream(state.seed, state.body, "inspiration.length", spoken.place).normal())
    factor = SITE_FACTOR.get(state.site, 1.0)
    base, slope = p.inspiration_base, p.inspiration_per_syllable
    length = snap(inspiration_length(base, slope, syllables, p.inspiration_spread * draw, factor))
    volume = max(snap(state.volume + SMALLEST), snap(initiation_volume(TERMINATION, p.volume_per_syllable, syllables)))
    nostril_flare, mouth_open = parts.face(state, low)
    return Inspiration(
        id=f"{spoken.id}.in",
        body=state.body,
        group=spoken.id,
        onset=state.time,
        duration=length,
        rule=f"physiology 1.3: {syllables} syllables to come, after {state.site}",
        from_volume=state.volume,
        to_volume=volume,
        profile="sine",
        thorax_share=share,
        motion=moved,
        sound_nose=snap(low.amplitude_sound_nose),
        sound_mouth=snap(low.amplitude_sound_mouth),
        nostril_flare=nostril_flare,
        mouth_open=mouth_open,
        face=parts.ramps(length),
        lead=Lead(mouth=FACE_LEAD, nostril=FACE_LEAD),
        noise=parts.breath_noise(state, spoken, onset=NOISE_DELAY, length=snap(length - NOISE_DELAY)),
    )


def _silence(p: Parameters, spoken: Spoken) -> tuple[PauseKind, float]:
    """Kind and length of the silence after a group."""
    site = spoken.group.cut.site
    if site in ("paragraph", "text end"):
        return "paragraph", snap(p.silence_after_paragraph)
    if site == "sentence":
        return "sentence", snap(p.silence_after_sentence)
    return "edge", snap(p.silence_before_breath)
