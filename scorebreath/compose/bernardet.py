"""The control model of Bernardet et al. (S1 3.2, S2 2.2): inspiration and expiration oscillate (B3).

The driver d is a saw-tooth: it rises from 0 with slope volume_lung / length_inspiration (B6) and falls back to 0 with
slope volume_lung / length_speech while the group is spoken (B12, B14). It stands in the Score as lung volume above a
resting level of 0: the model knows no residual volume and carries nothing from breath to breath (X15). Speech begins
where the inspiration ends, and the next inspiration where speech ends.
"""

from __future__ import annotations

from dataclasses import replace

from scorebreath.compose import acts, marked, parts
from scorebreath.compose.chances import Chances
from scorebreath.compose.feeling import Feeling
from scorebreath.compose.fitting import Wanted, fit
from scorebreath.compose.idle import NOTHING, RELAXATION, relax
from scorebreath.compose.lungs import EMPTY
from scorebreath.compose.phrasing import phrase
from scorebreath.compose.placer import Placer
from scorebreath.compose.state import BodyState, Room, Spoken
from scorebreath.equations.bernardet import volume_lung
from scorebreath.parameters.derive import LowLevel, derive
from scorebreath.parameters.modifiers import modifiers
from scorebreath.parameters.physique import physique
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import Part
from scorebreath.score.document import Person
from scorebreath.score.events import Event, Inspiration, Lead, Motion, Utterance
from scorebreath.script.marks import Act, BreathingMark, Mark
from scorebreath.units import snap


def person(parameters: Parameters) -> Person:
    """A body at whose rest the driver is 0."""
    return Person(vital_capacity=snap(physique(parameters).vital_capacity), resting_volume=0.0)


def feel(state: BodyState, time: float) -> Feeling:
    """The same at all times: the model has no states."""
    p, low = state.parameters, derive(state.parameters)
    return Feeling(
        modifiers=modifiers(p, {}), low=low, levels=EMPTY, motion=motion(p, low),
        thorax_share=snap(1.0 - p.abdomen_share), lead=Lead(), lives=False,
    )  # fmt: skip


def step(state: BodyState, spoken: Spoken) -> tuple[BodyState, list[Event]]:
    """Place one group: breathe in, then speak while breathing out."""
    p, low = state.parameters, derive(state.parameters)
    chances = Chances(seed=state.seed, body=state.body, place=spoken.place)
    placer = Placer(state=state, id=spoken.id, group=spoken.id, chances=chances, feels=feel)
    breath, named = marked.before(placer, spoken.group.before)
    inspiration = _asked(_inspiration(placer, spoken, p, low), breath, placer.state.breathing)
    if spoken.room is not None:
        _fitted(placer, spoken.room, inspiration)
    elif breath is not None and breath.name == "gasp":
        acts.gasp(placer, inspiration.to_volume, acts.asked(breath))
    else:
        placer.events.append(inspiration)
        placer.time, placer.volume = snap(inspiration.end), inspiration.to_volume
    for mark in named:
        placer.marker(mark, placer.time)
    _speak(placer, spoken, low)
    marked.after(placer, spoken.group.after)
    return placer.done(site=spoken.group.cut.site)


def finish(state: BodyState, tail: float = 0.0) -> tuple[BodyState, list[Event]]:
    """Nothing for `tail` seconds: the driver is back at 0, unless an act has left something in the lungs."""
    if state.volume == 0.0:
        return replace(state, time=snap(state.time + tail)), []
    chances = Chances(seed=state.seed, body=state.body, place="end")
    placer = Placer(state=state, id=f"{state.body}.end", chances=chances, feels=feel)
    relax(placer, RELAXATION)
    placer.time = snap(placer.time + tail)
    return placer.done()


def rest(state: BodyState, until: float, what: str) -> tuple[BodyState, list[Event]]:
    """Nothing: the model knows no breathing at rest (X15); what an interruption has left in the lungs goes out."""
    if state.volume == 0.0 or until - state.time <= NOTHING:
        return replace(state, time=max(state.time, until)), []
    placer = _alone(state, what)
    relax(placer, min(RELAXATION, until - state.time))
    state, events = placer.done()
    return replace(state, time=max(state.time, until)), events


def idle(state: BodyState) -> tuple[BodyState, list[Event]]:
    """Nothing, for a second (X15), unless something is left in the lungs."""
    if state.volume == 0.0:
        return replace(state, time=snap(state.time + RELAXATION)), []
    placer = _alone(state, "idle")
    relax(placer, RELAXATION)
    return placer.done()


def _alone(state: BodyState, what: str) -> Placer:
    """A placer for what belongs to no group."""
    return Placer(
        state=replace(state, waits=state.waits + 1), id=f"{state.body}.{what}{state.waits or ''}",
        chances=Chances(seed=state.seed, body=state.body, place=f"{what}@{state.waits}"), feels=feel,
    )  # fmt: skip


def act(state: BodyState, marks: tuple[Mark, ...], what: str) -> tuple[BodyState, list[Event]]:
    """Do what the markup asks for, without anything to say."""
    if not marks:
        return state, []
    chances = Chances(seed=state.seed, body=state.body, place=what)
    placer = Placer(state=state, id=f"{state.body}.{what}", chances=chances, feels=feel)
    marked.after(placer, marks)
    return placer.done()


def _inspiration(placer: Placer, spoken: Spoken, p: Parameters, low: LowLevel) -> Inspiration:
    syllables = spoken.group.syllables
    volume = snap(volume_lung(p.capacity_lung, syllables, low.length_utterance))
    length = snap(low.length_inspiration)
    nostril_flare, mouth_open = parts.face(p, low)
    return Inspiration(
        id=f"{spoken.id}.in",
        body=placer.state.body,
        group=spoken.id,
        onset=placer.time,
        duration=length,
        rule=f"B6 B7: {syllables} of {low.length_utterance:g} syllables",
        from_volume=placer.volume,
        to_volume=max(placer.volume, volume),
        thorax_share=placer.feeling.thorax_share,
        motion=placer.feeling.motion,
        sound_nose=snap(low.amplitude_sound_nose),
        sound_mouth=snap(low.amplitude_sound_mouth),
        nostril_flare=nostril_flare,
        mouth_open=mouth_open,
        face=parts.ramps(length),
        lead=placer.feeling.lead,
        noise=parts.trapezoid_noise(placer.state, spoken, onset=0.0, length=length),
    )


def _fitted(placer: Placer, room: Room, asked: Inspiration) -> None:
    """The inspiration as late and as long as a recording's silence lets it be, the driver reaching as far as always."""

    def inhale(to: float, length: float, rule: str) -> None:
        shape, noise = parts.ramps(length), asked.noise
        if noise is not None:
            noise = replace(
                noise, duration=length, attack=shape.attack, hold=shape.hold, release=shape.release
            )  # fmt: skip
        placer.events.append(
            replace(asked, onset=placer.time, duration=length, face=shape, noise=noise, rule=f"{asked.rule}; {rule}")
        )
        placer.time, placer.volume = snap(placer.time + length), asked.to_volume

    fit(placer, room, Wanted(to=asked.to_volume, length=asked.duration, before=0.0, after=0.0), inhale)


def _asked(breath: Inspiration, act: Act | None, wishes: BreathingMark | None) -> Inspiration:
    """The inspiration as long and as loud as the markup asks; its volume is the model's."""
    if act is None and wishes is None:
        return breath
    length = (act.length if act else 1.0) * (wishes.length if wishes else 1.0)
    louder = (act.level_db if act else 0.0) + (wishes.level_db if wishes else 0.0)
    lasting = snap(act.seconds if act and act.seconds is not None else breath.duration * length)
    shape, noise = parts.ramps(lasting), breath.noise
    if noise is not None:
        noise = replace(
            noise, duration=lasting, attack=shape.attack, hold=shape.hold, release=shape.release,
            level_db=snap(noise.level_db + louder),
        )  # fmt: skip
    silent = act is None and wishes is not None and wishes.silent
    rule = f"asked: {act.written}; {breath.rule}" if act else breath.rule
    return replace(
        breath, duration=lasting, face=shape, noise=None if silent else noise, rule=rule,
        origin="markup" if act else "rule",
    )  # fmt: skip


def _speak(placer: Placer, spoken: Spoken, low: LowLevel) -> None:
    """The speech; where the markup divides it, each part lets out its share of the driver."""
    left = sum(said.speech.duration for said in spoken.parts)
    placed: list[tuple[Utterance, Part]] = []
    for number, said in enumerate(spoken.parts):
        if number:
            for index, mark in enumerate(marked.bodily(said.part.before)):
                marked.heed(placer, mark, f"part{number}.{index}")
        speech = parts.utterance(placer.state, spoken, said, low=low, onset=placer.time, number=number)
        placer.events.append(speech)
        placed.append((speech, said.part))
        last = number == len(spoken.parts) - 1
        to = 0.0 if last else placer.volume * (1.0 - said.speech.duration / left)
        left -= said.speech.duration
        placer.spend(speech.onset, speech.duration, to, "B12")
        marked.inside(placer, speech, said)
    phrase(placer, placed)


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
