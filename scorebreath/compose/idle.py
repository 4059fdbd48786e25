"""Breathing at rest: before, between and after speech, and the way back to it (physiology 1.6)."""

from __future__ import annotations

from dataclasses import replace

from scorebreath.compose import timing
from scorebreath.compose.chances import Chances
from scorebreath.compose.placer import Placer
from scorebreath.compose.sounds import Air
from scorebreath.equations.shapes import HIGHEST_FLOW
from scorebreath.units import snap

CYCLE = 0.65
"""Share of a resting cycle that must fit for one to begin."""
NOTHING = 2e-6
"""s that are no time: sums of numbers on the grid."""
RELAXATION = 1.0
"""s from the last word back to rest."""
DEPTH_VARIATION = 1.3
"""Depths vary so many times as much as lengths do."""
FRACTION_VARIATION = 0.4
"""The inspiration's share varies so many times as much (1.62 +- 0.31 s within 0.42 +- 0.03: Tobin 1983)."""
NOSE = 0.95
"""Share of the nose at rest (physiology 1.6)."""
ORONASAL = 37.0 / 60.0
"""L/s of ventilation from which on the mouth helps (Niinimaa 1980: 35 to 40 L/min)."""
TOP = 0.85
"""Highest volume of a breath at rest."""
SIGHING = 2.2
"""Depth of a sigh at rest, times a resting breath (physiology 1.6: 2 to 3)."""
QUIETER = -10.0
"""dB of an expiration against an inspiration of equal flow (physiology 3.2: -8; rarely audible at rest)."""
HEARD = 0.06
"""Volume, fraction of VC, from which on the way back to rest is a breath to be heard."""
NEAR_REST = 0.01
"""Distance from the resting level, fraction of VC, that is as good as none."""
SINKING = Air(kind="exhale", extra_db=QUIETER, trapezoid=(0.12, 0.7))
"""The sound of air that leaves a chest at ease."""


def wait(placer: Placer, until: float, rule: str = "") -> None:
    """Breathe at rest until a time; the last breath is out by then. In a short while nothing happens but going to rest.

    Args:
        placer: The body; nothing happens if the time is over.
        until: s.
        rule: Why it waits.
    """
    base, count = placer.chances, 0
    while (left := until - placer.time) > NOTHING:
        placer.feel()
        cycle = 60.0 / (placer.p.resting_rate * placer.modifiers.rate)
        if count == 0 and (left < CYCLE * cycle or not placer.feeling.lives):
            relax(placer, min(left, RELAXATION))
            placer.hold("rest", snap(until - placer.time), rule=rule or "physiology 1.6: at rest")
            return
        placer.chances = _at(base, placer, count)
        drawn = cycle * placer.chances.about("rest.length", 1.0, placer.modifiers.variation)
        length = left if left < 1.5 * cycle else min(drawn, left - 0.75 * cycle)
        _cycle(placer, snap(placer.time + length), cycle)
        count += 1
    placer.chances = base
    placer.state = replace(placer.state, waits=placer.state.waits + count)


def breathe(placer: Placer) -> None:
    """Go on at rest, nobody knows for how long: back to the resting level, or one breath more."""
    placer.feel()
    rule = "physiology 1.6: at rest"
    if abs(placer.volume - placer.levels.rest) > NEAR_REST:
        relax(placer, RELAXATION)
        return
    base = placer.chances
    placer.chances = _at(base, placer, 0)
    cycle = 60.0 / (placer.p.resting_rate * placer.modifiers.rate)
    drawn = cycle * placer.chances.about("rest.length", 1.0, placer.modifiers.variation)
    begun = placer.time
    _cycle(placer, snap(placer.time + drawn), cycle)
    if placer.time - begun <= NOTHING:
        placer.hold("rest", drawn, rule=rule)
    placer.chances = base


def relax(placer: Placer, length: float) -> None:
    """To the resting level: above it the chest sinks by its own recoil, below it rises by it."""
    rest = placer.levels.rest
    rule = "physiology 2.2: to the resting level"
    if placer.volume > rest:
        heard = SINKING if placer.volume - rest > HEARD else None
        placer.exhale("relax", rest, length, rule=rule, kind="tidal", peak=0.5, air=heard)
    elif placer.volume < rest:
        if rest - placer.volume > HEARD:
            placer.inhale("relax", rest, length, rule=rule, kind="tidal")
        else:
            placer.inhale("relax", rest, length, rule=rule, kind="tidal", nose=0.0, mouth=0.0, opening=0.0, peak=0.5)


def _cycle(placer: Placer, end: float, usual: float) -> None:
    """One breath in and out, and the little pause after it, until `end`."""
    p, m, level, chances = placer.p, placer.modifiers, placer.levels, placer.chances
    length = end - placer.time
    depth = p.tidal_volume * m.depth * chances.about("rest.depth", 1.0, DEPTH_VARIATION * m.variation)
    sighs = m.sigh_interval > 0 and placer.time - placer.state.sighed > m.sigh_interval
    if sighs:
        depth = max(depth, SIGHING * p.tidal_volume)
        placer.state = replace(placer.state, sighed=placer.time)
    pause = min(m.rest_pause, 0.25 * length)
    inward = m.fraction * length * chances.about("rest.fraction", 1.0, FRACTION_VARIATION * m.variation)
    outward = max(0.2 * length, length - inward - pause)
    inward = min(inward, length - outward)
    to = min(TOP, level.rest + depth)
    litres = placer.state.person.vital_capacity
    ventilation = depth * litres / usual
    nose = NOSE if ventilation < ORONASAL else min(NOSE, m.nose_share)
    gain = p.amplitude_breathing_sound
    rule = "physiology 1.6"
    if placer.volume > to - 0.5 * depth:  # full from what was before: only out
        placer.exhale("tidal_out", level.rest, length - pause, rule=rule, kind="tidal", profile="exponential",
                      air=SINKING)  # fmt: skip
        placer.hold("tidal_pause", snap(end - placer.time), rule=rule)
        return
    placer.inhale(
        "tidal", to, inward, rule=rule, kind="sigh" if sighs else "tidal", nose=nose * gain, mouth=(1.0 - nose) * gain,
        peak=0.5,
    )  # fmt: skip
    out = max(0.2, min(outward, end - placer.time))
    hurried = timing.unhurried(out, placer.volume - level.rest, litres, HIGHEST_FLOW["exponential"]) > out
    placer.exhale(
        "tidal_out", level.rest, out, rule=rule, kind="sigh" if sighs else "tidal",
        profile="sine" if hurried else "exponential",  # faster than the chest's recoil: pressed out
        nose=nose * gain, mouth=(1.0 - nose) * gain, opening=0.5 if nose < NOSE else 0.0,
        air=SINKING,
    )  # fmt: skip
    placer.hold("tidal_pause", snap(end - placer.time), rule=rule)


def _at(base: Chances, placer: Placer, number: int) -> Chances:
    return Chances(seed=base.seed, body=base.body, place=f"{base.place}/rest{placer.state.waits + number}")
