"""What a person and the states of the moment make of the neutral speaker's breathing (physiology 1.5, 4.2)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from scorebreath.parameters.columns import COLUMNS
from scorebreath.parameters.person import person_rows
from scorebreath.parameters.physique import thorax_share
from scorebreath.parameters.states import find_state
from scorebreath.parameters.table import Parameters

RATE_INSPIRATION, RATE_VOLUME = -0.5, -0.8
"""Powers of the speaking rate: fast speech breathes in faster, and spends less air on a syllable (E; physiology 1.5:
lengths x 0.85 and 1.1 at rates of 1.3 and 0.75, depths x 1.0 and 1.05, with a group's syllables going by rate^0.7)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Modifiers:
    """Factors are 1, shifts 0 and chances 0 for the neutral speaker; shares and times are what is in force."""

    syllables: float = 1.0
    """x preferred length of a breath group"""
    inspiration: float = 1.0
    """x length of an inspiration for speech"""
    volume: float = 1.0
    """x volume spent on a syllable"""
    start: float = 0.0
    """shift of the levels at which speech begins and ends, fraction of VC; they go with the resting level, too
    (`Physique.resting_volume`: posture)"""
    pause: float = 1.0
    """x silences before a breath"""
    delay: float = 1.0
    """x silence between a breath and the first phone"""
    thorax_share: float = 0.65
    """of the volume, 0..1"""
    nose_share: float = 0.35
    """of the air breathed in for speech, 0..1"""
    breath_db: float = 0.0
    """dB by which breaths are louder, on top of what their flow does"""
    variation: float = 0.15
    """coefficient of variation of resting cycles; speech breaths vary as much more or less as this differs from 0.15"""
    brightness: float = 1.0
    """x resonances"""
    flare: float = 1.0
    """x nostril flare"""
    tremor: float = 0.0
    """share by which the thorax trembles"""
    rate: float = 1.0
    """x resting rate"""
    depth: float = 1.0
    """x resting tidal volume"""
    fraction: float = 0.40
    """inspiration's share of a resting cycle"""
    rest_pause: float = 0.3
    """s between a resting expiration and the next inspiration"""
    sigh_interval: float = 0.0
    """s between sighs; 0: none"""
    hold_chance: float = 0.0
    """chance that a breath is held before speech"""
    hold_length: float = 0.5
    """s that it then is held"""
    gasp_chance: float = 0.0
    """chance that an inspiration for speech is a gasp"""
    saccades: int = 1
    """parts in which an inspiration is drawn"""
    laugh_chance: float = 0.0
    """chance that laughter follows a group that ends its sentence"""
    puff_chance: float = 0.0
    """chance that a puff through the nose follows such a group"""
    exhale_chance: float = 0.0
    """chance that what is left in the lungs is let out audibly before the next breath"""


def modifiers(p: Parameters, states: Mapping[str, float]) -> Modifiers:
    """All that modifies breathing now.

    States add up, m = 1 + sum of intensity x (m_state - 1); what they give is multiplied by what the person is (age,
    posture, condition) and how loud and fast it speaks; shares and levels are shifted. Whatever comes of it stays
    within the bounds of `columns.COLUMNS`.

    Args:
        p: Age, sex, posture, condition, loudness, rate; what was set by hand wins over age, posture and condition, and
            is what states start from.
        states: Intensity of each state, 0..1 (`parameters.states`).

    Raises:
        InputError: There is no such state.

    >>> modifiers(Parameters(), {}) == Modifiers()
    True
    >>> modifiers(Parameters(), {"anxious": 0.5}).rate, modifiers(Parameters(age=80.0), {"anxious": 1.0}).syllables
    (1.175, 0.56)
    """
    return _modifiers(p, frozenset(p.model_fields_set), tuple(sorted(states.items())))


@lru_cache(maxsize=512)
def _modifiers(p: Parameters, by_hand: frozenset[str], states: tuple[tuple[str, float], ...]) -> Modifiers:
    """Cached: `by_hand` is part of the key, as equal parameters may differ in it."""
    moved = _summed(find_state(name).deviations(min(1.0, max(0.0, level))) for name, level in states)
    moved["variation"] = moved.get("variation", 0.0) * p.breath_variability / COLUMNS["variation"].neutral
    person = person_rows(p)
    values = {name: _combined(name, _neutral(p, name), moved.get(name, 0.0), person) for name in COLUMNS}
    values["inspiration"] *= p.prosody_rate**RATE_INSPIRATION
    values["volume"] *= p.prosody_rate**RATE_VOLUME
    return Modifiers(**{name: _bounded(name, value) for name, value in values.items()})


def _summed(rows: Iterable[Mapping[str, float]]) -> dict[str, float]:
    total: dict[str, float] = {}
    for row in rows:
        for name, value in row.items():
            total[name] = total.get(name, 0.0) + value
    return total


def _neutral(p: Parameters, name: str) -> float:
    """What states start from: this person's own value."""
    own = {"nose_share": p.nose_share, "variation": p.breath_variability}
    if name == "thorax_share":
        return thorax_share(p)
    return own.get(name, COLUMNS[name].neutral)


def _combined(name: str, neutral: float, moved: float, person: Iterable[Mapping[str, float]]) -> float:
    """A person's value of a column, with what states moved it by."""
    value = neutral + moved
    if COLUMNS[name].kind != "factor":
        return value + sum(row.get(name, 0.0) for row in person)
    value = max(value, COLUMNS[name].low)
    for row in person:
        value *= 1.0 + row.get(name, 0.0)
    return value


def _bounded(name: str, value: float) -> Any:
    """Within the column's bounds, on a grid that hides how floats add up."""
    column = COLUMNS[name]
    if column.kind == "frequency":
        if value < 1.0 / column.high:
            return column.neutral
        value = 1.0 / value
    value = round(min(column.high, max(column.low, value)), 9)
    return round(value) if name == "saccades" else value
