"""Measures of time: breath groups, inspirations, cycles, silences."""

from __future__ import annotations

import numpy as np

from scorebreath.report.norms.figures import Array
from scorebreath.report.norms.material import Mask, Material
from scorebreath.score.events import Inspiration

MEASURED = 1e-6
"""Shortest time by which anything is divided, s."""


def ratio(part: Array, whole: Array, where: Mask) -> Array:
    """One over the other where that says something; not a number elsewhere; (n,)."""
    return np.asarray(np.divide(part, whole, out=np.full(len(whole), np.nan), where=where), dtype=np.float64)


def group_with_inspiration(m: Material) -> Array:
    """From the inspiration's onset to the last phone, s."""
    chosen = m.on_speech_breath
    return np.asarray(m.end[chosen] - m.breath_onset[m.breath[chosen]])


def group_speech(m: Material) -> Array:
    """From the first phone to the last, s."""
    return m.end - m.start


def syllables(m: Material) -> Array:
    """Of each breath group."""
    return m.syllables


def articulation_rate(m: Material) -> Array:
    """Syllables a second, pauses left out."""
    _, length, owner = m.gaps
    spoken = m.end - m.start - np.bincount(owner, weights=length, minlength=len(m.start))
    return ratio(m.syllables, spoken, (spoken > MEASURED) & (m.syllables > 0))


def ti(m: Material) -> Array:
    """Length of speech inspirations, s."""
    return m.ti[m.for_speech]


def ti_and_syllables(m: Material) -> Array:
    """Length of the inspiration, s, and syllables of the group that is said on it; (n, 2)."""
    chosen = m.on_speech_breath
    return np.stack((m.ti[m.breath[chosen]] if chosen.any() else np.zeros(0), m.syllables[chosen]), axis=1)


def speech_fraction(m: Material) -> Array:
    """Share of a speech cycle that is breathing in."""
    index, length = m.cycles(m.for_speech)
    return m.ti[index] / length


def speech_rate(m: Material) -> Array:
    """Speech cycles a minute."""
    return 60.0 / m.cycles(m.for_speech)[1]


def breath_pause(m: Material) -> Array:
    """From the last phone of one group to the first of the next, s."""
    return m.start[m.pauses] - m.end[m.pauses - 1]


def before_breath(m: Material, *sites: str) -> Array:
    """From the last phone to the breath's sound (to its movement where it has none), at some kinds of boundary, s."""
    found = [
        m.breath_onset[m.breath[after]] + _sound(m.inspirations[m.breath[after]])[0] - m.end[after - 1]
        for after in m.pauses
        if (place := m.boundaries[after - 1]) is not None and place.site in sites
    ]
    return np.array(found, dtype=np.float64)


def after_breath(m: Material) -> Array:
    """From the end of the breath's sound (of its movement where it has none) to the first phone, s."""
    if not m.inspirations:
        return np.zeros(0)
    chosen = np.flatnonzero(m.on_speech_breath & m.free(m.breath_onset[m.breath], m.start))
    ends = [m.breath_onset[m.breath[k]] + _sound(m.inspirations[m.breath[k]])[1] for k in chosen]
    return m.start[chosen] - np.array(ends, dtype=np.float64)


def breathless_pause(m: Material) -> Array:
    """Silences inside breath groups, s."""
    onset, length, _ = m.gaps
    return length[m.free(onset, onset + length)]


def _sound(breath: Inspiration) -> tuple[float, float]:
    """Where it is heard, s from its onset."""
    if breath.noise is None:
        return 0.0, breath.duration
    return breath.noise.onset, breath.noise.onset + breath.noise.duration


def _rest(m: Material) -> tuple[Array, Array, Array]:
    """Of tidal breaths followed by another one: cycle, s; breathing in, s; depth, L."""
    followed = m.tidal & np.append(m.tidal[1:], np.False_) if m.tidal.size else m.tidal
    index, length = m.cycles(followed)
    depth = [m.inspirations[k].to_volume - m.inspirations[k].from_volume for k in index]
    return length, m.ti[index], m.body.person.vital_capacity * np.array(depth, dtype=np.float64)


def rest_rate(m: Material) -> Array:
    """Tidal breaths a minute."""
    return 60.0 / _rest(m)[0]


def rest_ti(m: Material) -> Array:
    """Length of tidal inspirations, s."""
    return _rest(m)[1]


def rest_fraction(m: Material) -> Array:
    """Share of a tidal cycle that is breathing in."""
    length, breathing, _ = _rest(m)
    return breathing / length


def rest_volume(m: Material) -> Array:
    """Depth of tidal breaths, L."""
    return _rest(m)[2]
