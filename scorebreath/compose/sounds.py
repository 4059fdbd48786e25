"""How loud and bright a breath is: it follows the air (physiology 3.1-3.3)."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TypedDict

from scorebreath.compose.chances import Chances
from scorebreath.compose.state import BodyState
from scorebreath.equations.breath import brightness, flow_level, mix_level, trapezoid
from scorebreath.media.recordings import RecordingKind
from scorebreath.parameters.modifiers import Modifiers
from scorebreath.parameters.table import Parameters
from scorebreath.score.events import Noise
from scorebreath.units import snap

SYNTH = "synth"
"""Source of what is not recorded."""
REFERENCE_FLOW = 0.223 * pi / 2
"""Highest flow, VC/s, of a breath that is as loud as `breath_level`. A group of 18 syllables takes 16.2 % of VC in
0.6 s, 0.27 VC/s on average (physiology 1.3, 2.2); most breaths are for less, and their mean level is what is asked."""
INITIAL_DB = -3.0
"""Breaths that begin speech against those within it (physiology 3.2; Werner 2021)."""
LOUDEST_DB, FAINTEST_DB = -6.0, -52.0
"""A breath is never louder against speech (physiology 3.2), and not worth playing when fainter."""
BRIGHTEST = 4.0
"""x the brightness of a breath with the reference flow, at most."""
DELAY = 0.04
"""s of flow too slow to be heard, before the noise begins (physiology 1.4, 8)."""
PEAK = 0.40
"""Where the flow of an inspiration is highest, share of its length (physiology 3.3)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Air:
    """Air that moves, as far as its sound is concerned."""

    kind: RecordingKind = "mouth"
    """whose recordings serve, beside the nose's"""
    flow: float = 0.0
    """highest, VC/s"""
    length: float = 0.0
    """s, of the movement"""
    nose: float = 0.0
    """gain of the nose's sound"""
    mouth: float = 0.0
    """gain of the mouth's sound"""
    peak: float = PEAK
    """share of the length"""
    level_db: float | None = None
    """its level whatever the flow, relative to `breath_level`; None: as the flow says"""
    extra_db: float = 0.0
    """what is asked for on top"""
    delay: float = DELAY
    """s before it is heard"""
    trapezoid: tuple[float, float] | None = None
    """shares of the attack and the release of an envelope with straight ramps; None: as the parameters say"""


def noise(state: BodyState, m: Modifiers, chances: Chances, air: Air, *, purpose: str) -> Noise | None:
    """The audible part of a breath; None where it is not to be heard, or too faint to be.

    Level and brightness follow the highest flow; the level is that of a unit gain, such that a breath with the
    reference flow at the default gains is at `breath_level`.
    """
    p = state.parameters
    whole = snap(air.length)
    length = snap(whole - min(air.delay, whole / 4))
    if not p.breath_sound or length <= 0 or air.flow <= 0 or air.nose + air.mouth <= 0:
        return None
    own = flow_level(air.flow, REFERENCE_FLOW, p.flow_exponent) if air.level_db is None else air.level_db
    level = p.breath_level + m.breath_db + air.extra_db + own
    heard = level - default_mix() + mix_level(air.mouth, air.nose)
    if heard < FAINTEST_DB and p.breath_level > FAINTEST_DB:
        return None
    level -= default_mix() + max(0.0, heard - max(LOUDEST_DB, p.breath_level))
    attack, hold, release = _envelope(p, air, length)
    return Noise(
        onset=snap(whole - length),
        duration=length,
        attack=attack,
        hold=hold,
        release=release,
        level_db=snap(max(-200.0, min(40.0, level))),
        seed=chances.noise(purpose),
        **sources(state, chances.place, air.kind),
        envelope="flow" if air.trapezoid is None and p.breath_envelope == "flow" else "trapezoid",
        brightness=snap(min(BRIGHTEST, brightness(air.flow, REFERENCE_FLOW) * m.brightness * p.breath_brightness)),
    )


class Sources(TypedDict):
    """Where a noise comes from, as `Noise` names it."""

    source: str
    source_nose: str


def sources(state: BodyState, place: str, kind: RecordingKind) -> Sources:
    """The recordings of a breath, where the user has given some; the synthesiser's where not."""
    known = state.recordings
    take = known.take(kind, state.body, place) if known else None
    through_nose = known.take("nose", state.body, place) if known and kind == "mouth" else None
    source, nose = (each.sha if each else SYNTH for each in (take, through_nose))
    return Sources(source=source, source_nose=nose if kind == "mouth" and nose != source else "")


def _envelope(p: Parameters, air: Air, length: float) -> tuple[float, float, float]:
    """Attack, hold, release on the grid, exactly `length` together."""
    if air.trapezoid is not None:
        attack, release = (share * length for share in air.trapezoid)
    elif p.breath_envelope == "flow":
        attack, release = air.peak * length, (1.0 - air.peak) * length
    else:
        attack, _, release = trapezoid(length)
    attack = snap(attack)
    release = snap(min(release, length - attack))
    return attack, snap(max(0.0, length - attack - release)), release


def default_mix() -> float:
    """Level of mouth and nose together at the default gains, dB."""
    share = float(Parameters.model_fields["nose_share"].default)
    return mix_level(1.0 - share, share)
