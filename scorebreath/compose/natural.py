"""The natural model: lungs within their levels, breaths that follow what is to be said and how the body feels.

What is breathed in is what will be spent, above the level where speech usually ends; a part of what the last group left
too much or too little is carried over (physiology 2.2). The inspiration is the longer the more is to be said, and lasts
longer or shorter by the boundary and by chance (physiology 1.3); a silence stands before and after it (physiology 1.4);
mouth and nostrils open ahead of the flow, and its sound is as loud and bright as the air is fast. States move all of
this together (physiology 4.2, B55, B60).
"""

from __future__ import annotations

from dataclasses import replace

from scorebreath.compose import acts, marked, parts, timing
from scorebreath.compose.acts import Asked, asked
from scorebreath.compose.chances import Chances
from scorebreath.compose.feeling import Feeling
from scorebreath.compose.fitting import Wanted, fit
from scorebreath.compose.idle import NOTHING, RELAXATION, breathe, wait
from scorebreath.compose.lungs import TOP, initiation, levels
from scorebreath.compose.phrasing import phrase
from scorebreath.compose.placer import Placer
from scorebreath.compose.sounds import INITIAL_DB, Air
from scorebreath.compose.state import BodyState, Spoken, SpokenPart
from scorebreath.equations.breath import flow_level
from scorebreath.parameters.modifiers import modifiers
from scorebreath.parameters.physique import physique
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, Part
from scorebreath.score.document import Person
from scorebreath.score.events import Event, Lead, Utterance
from scorebreath.script.emotional import ENDS, ahead
from scorebreath.script.marks import Act, EmotionMark, Mark
from scorebreath.units import snap

FACE_LEAD = 0.08
"""s that mouth and nostrils move ahead of the flow (physiology 6, 8)."""
VOLUME_VARIATION = 0.5
"""What a syllable takes varies from group to group by so many times as much as resting cycles do."""
MOST_IRREGULAR = 1.6
"""Times its usual spread that the depth of breaths varies at most."""
QUICKER = 0.3
"""Share of its length that a breath of surprise is shorter by, on top of what the state does."""
SHORT_HOLD = 0.3
"""s that it is held for at least, on average: half of what 4.2 gives the whole state."""
SIGH_SPREAD = 0.3
"""Coefficient of variation of the time between sighs."""


def person(parameters: Parameters) -> Person:
    """The body of the parameters' person; `capacity_lung` scales its lungs."""
    body = physique(parameters)
    return Person(
        vital_capacity=snap(min(20.0, max(0.1, body.vital_capacity * parameters.capacity_lung / 100.0))),
        resting_volume=snap(body.resting_volume),
        vocal_tract=snap(body.vocal_tract_length),
    )


def feel(state: BodyState, time: float) -> Feeling:
    """As its states have it."""
    p, person = state.parameters, state.person
    m = modifiers(p, state.blend.at(time))
    low = parts.low_level(p, m.nose_share, 1.0 - m.thorax_share)
    return Feeling(
        modifiers=m, low=low, levels=levels(p, person, m), motion=parts.motion(p, low, person, m.tremor),
        thorax_share=snap(m.thorax_share), lead=Lead(mouth=FACE_LEAD, nostril=FACE_LEAD), lives=True,
    )  # fmt: skip


def step(state: BodyState, spoken: Spoken) -> tuple[BodyState, list[Event]]:
    """Place one group: what the markup asks for before it, the breath, the speech, the silence after it."""
    chances = Chances(seed=state.seed, body=state.body, place=spoken.place)
    placer = Placer(state=state, id=spoken.id, group=spoken.id, chances=chances, feels=feel)
    breath, named = marked.before(placer, spoken.group.before)
    placer.feel()
    if spoken.room is None:
        _sigh_by_itself(placer)
    _inspire(placer, spoken, breath)
    if spoken.room is None:
        edge = timing.delay(placer.p, placer.modifiers, placer.chances)
        placer.hold("ready", edge, rule="physiology 1.4")
    for mark in named:
        placer.marker(mark, placer.time)
    _speak(placer, spoken)
    behind = marked.names_first(placer, spoken.group.after)
    _fall_silent(placer, spoken)
    marked.after(placer, behind)
    return placer.done(site=spoken.group.cut.site)


def finish(state: BodyState, tail: float = 0.0) -> tuple[BodyState, list[Event]]:
    """Back to rest after the last word, and on breathing for `tail` seconds more."""
    placer = _alone(state, "end")
    wait(placer, snap(placer.time + RELAXATION + tail), "physiology 1.6: after speech")
    return placer.done()


def rest(state: BodyState, until: float, what: str) -> tuple[BodyState, list[Event]]:
    """Breathe at rest until a time."""
    if until - state.time <= NOTHING:
        return state, []
    placer = _alone(state, what)
    wait(placer, until)
    return placer.done()


def idle(state: BodyState) -> tuple[BodyState, list[Event]]:
    """Breathe at rest, a breath at a time, while nobody knows for how long."""
    placer = _alone(state, "idle")
    breathe(placer)
    return placer.done()


def act(state: BodyState, marks: tuple[Mark, ...], what: str) -> tuple[BodyState, list[Event]]:
    """Do what the markup asks for, without anything to say."""
    if not marks:
        return state, []
    placer = _alone(state, what)
    marked.after(placer, marks)
    return placer.done()


def _alone(state: BodyState, what: str) -> Placer:
    """A placer for what belongs to no group."""
    place = f"{what}@{state.waits}"
    return Placer(
        state=replace(state, waits=state.waits + 1),
        id=f"{state.body}.{what}{state.waits or ''}",
        chances=Chances(seed=state.seed, body=state.body, place=place),
        feels=feel,
    )


def _sigh_by_itself(placer: Placer) -> None:
    """Some states sigh now and then, between sentences."""
    state, m = placer.state, placer.modifiers
    if m.sigh_interval <= 0 or state.site not in ("sentence", "paragraph"):
        return
    if placer.time - state.sighed > placer.chances.about("sigh.interval", m.sigh_interval, SIGH_SPREAD):
        acts.perform(placer, "sigh", Asked(rule="physiology 4.2: sighs by itself"))
        placer.state = replace(placer.state, sighed=placer.time)


def _inspire(placer: Placer, spoken: Spoken, breath: Act | None) -> None:
    """The breath for what is to be said: as deep, as long, as loud as it must be."""
    p, m, state, chances = placer.p, placer.modifiers, placer.state, placer.chances
    syllables = spoken.group.syllables
    need = syllables * _per_syllable(placer)
    irregular = min(MOST_IRREGULAR, m.variation / timing.NEUTRAL_VARIATION)
    deviation = p.initiation_spread * irregular * max(-2.0, min(2.0, chances.normal("inspiration.volume")))
    to = initiation(placer.levels, placer.volume, need, p.recovery_share, deviation)
    left = to - placer.levels.floor
    if need > left + 1e-6:
        _warn(placer, spoken.group, need, left)
    gasps = (breath and breath.name == "gasp") or (not breath and chances.happens("gasp", m.gasp_chance))
    if gasps and spoken.room is None:
        how = asked(breath) if breath else Asked(rule="physiology 4.2: gasps")
        acts.gasp(placer, min(TOP, to), how)
        return
    wishes = state.breathing
    louder = (breath.level_db if breath else 0.0) + (wishes.level_db if wishes else 0.0)
    longer = (breath.length if breath else 1.0) * (wishes.length if wishes else 1.0)
    louder += flow_level(longer, 1.0, p.flow_exponent)  # a longer breath that is asked for is not a softer one
    longer *= timing.for_depth(to - placer.volume, need)
    length = timing.speech_inspiration(p, m, chances, syllables=syllables, site=state.site, asked=longer)
    startled = 0.0 if breath else surprise(p, spoken.group)
    length *= 1.0 - QUICKER * startled
    if breath and breath.seconds is not None:
        length = breath.seconds
    if state.site in ("text end", "paragraph"):
        louder += INITIAL_DB
    if wishes and wishes.silent and not breath:
        louder = -200.0
    rule = (
        f"physiology 1.3: {syllables} syllables to come, after {state.site}{', quick at surprise' if startled else ''}"
    )

    def inhale(to: float, length: float, rule: str) -> None:
        placer.inhale(
            "in", to, length, rule=rule, air=Air(extra_db=louder), saccades=m.saccades,
            origin="markup" if breath else "rule",
        )  # fmt: skip

    if spoken.room is not None:
        before = timing.silence(p, m, chances, state.site)[1]
        after = timing.delay(p, m, chances)
        fit(placer, spoken.room, Wanted(to=to, length=length, before=before, after=after), inhale)
        return
    inhale(to, length, f"asked: {breath.written}" if breath else rule)
    if startled or chances.happens("hold", m.hold_chance):
        held = chances.about("hold.length", max(m.hold_length, SHORT_HOLD if startled else 0.0), 0.3)
        placer.hold("held", held, rule="physiology 4.2: holds at surprise" if startled else "physiology 4.2: holds",
                    held=True)  # fmt: skip


def surprise(p: Parameters, group: BreathGroup) -> float:
    """How much a group begins with surprise, 0..1: before it, or up to where its first phrase ends (B60)."""
    marks = [*ahead(group.before)]
    for word in group.words:
        marks += word.after
        if word.edge in ENDS:
            break
    felt = [mark.intensity for mark in marks if isinstance(mark, EmotionMark) and mark.name == "surprised"]
    return p.emotion_breath * max(felt, default=0.0)


def _warn(placer: Placer, group: BreathGroup, need: float, left: float) -> None:
    text = " ".join(group.text.split())
    placer.warn(
        "lung-budget",
        f"{group.syllables} syllables need {need:.0%} of vital capacity and {max(0.0, left):.0%} are there: "
        f"{text if len(text) <= 60 else text[:57] + '...'}",
    )


def _per_syllable(placer: Placer) -> float:
    """Volume of a syllable of this group, fraction of the body's own capacity."""
    p, m = placer.p, placer.modifiers
    usual = p.volume_per_syllable * 100.0 / p.capacity_lung * m.volume
    return placer.chances.about("volume", usual, VOLUME_VARIATION * m.variation)


def _speak(placer: Placer, spoken: Spoken) -> None:
    """The parts of a group, each spoken on the same breath, with what stands between them."""
    per_syllable = _per_syllable(placer)
    placed: list[tuple[Utterance, Part]] = []
    for number, said in enumerate(spoken.parts):
        if number:
            _between(placer, spoken, said, number)
        speech = parts.utterance(placer.state, spoken, said, low=placer.low, onset=placer.time, number=number)
        placer.events.append(speech)
        placed.append((speech, said.part))
        to = max(placer.levels.floor, placer.volume - said.part.syllables * per_syllable)
        placer.spend(speech.onset, speech.duration, to, f"physiology 2.2: {per_syllable:.4f} VC a syllable")
        marked.inside(placer, speech, said)
    phrase(placer, placed)


def _between(placer: Placer, spoken: Spoken, said: SpokenPart, number: int) -> None:
    """Between two parts: what is asked for, or else the pause of a sentence's end without a breath."""
    acting = [mark for mark in said.part.before if isinstance(mark, Act)]
    if said.part.site in ("sentence", "paragraph") and not acting:
        chances = replace(placer.chances, place=f"{spoken.place}/part{number}")
        kind, length = timing.breathless(placer.p, placer.modifiers, chances, said.part.site)
        placer.pause("gap", kind, length, rule="physiology 1.4: no breath")
        placer.hold("gap_rest", length, rule="physiology 1.4: no breath")
    for index, mark in enumerate(marked.bodily(said.part.before)):
        marked.heed(placer, mark, f"part{number}.{index}")


def _fall_silent(placer: Placer, spoken: Spoken) -> None:
    """The silence behind a group, and what some states fill it with."""
    placer.feel()
    p, m, chances, group = placer.p, placer.modifiers, placer.chances, spoken.group
    kind, length = timing.silence(p, m, chances, group.cut.site)
    if spoken.room is not None and spoken.room.silence is not None:
        placer.pause("pause", kind, spoken.room.silence, rule="as recorded")
        return
    if group.ends_sentence and chances.happens("laugh", m.laugh_chance):
        placer.hold("before_laugh", 0.12, rule="physiology 4.2")
        acts.perform(placer, "laugh", Asked(rule="physiology 4.2: laughs"))
    elif group.ends_sentence and chances.happens("puff", m.puff_chance):
        acts.puff(placer, Asked(rule="physiology 4.2: a puff of amusement"))
    elif chances.happens("exhale", m.exhale_chance) and placer.volume - placer.levels.floor > 0.05:
        down = max(placer.levels.floor + 0.01, placer.volume - 0.12)
        acts.let_go(placer, down, 0.35, Asked(rule="physiology 4.2: lets go what is left"))
    placer.pause("pause", kind, length, rule=f"physiology 1.4: {kind}")
    placer.hold("rest", length, rule="physiology 1.4")
