"""A breath fitted into the silence that a recording leaves before its speech.

A speaker who was recorded has breathed somewhere in that silence, audibly or not. Where the breath is heard and kept,
the body breathes then, and for as long. Where it is not, the breath is drawn as late as by itself: right before the
speech, the rest of the silence before it. In a silence that is too short the breath is shortened before the gaps around
it go, and below the shortest catch breath there is none (physiology 1.3, 1.4).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from scorebreath.compose.idle import NOTHING, wait
from scorebreath.compose.placer import Placer
from scorebreath.compose.state import KeptBreath, Room
from scorebreath.compose.timing import FASTEST_FLOW
from scorebreath.equations.shapes import HIGHEST_FLOW
from scorebreath.score.events import Inspiration, Noise
from scorebreath.units import snap

SHORTEST = 0.12
"""s; no breath is drawn in less"""
LEAST_EDGE = 0.01
"""s that are left on both sides of a breath, at least"""
AT_REST = 2.5
"""s of silence more than the breath needs, from which on the body goes back to breathing at rest meanwhile"""
EDGE = 0.005
"""s over which a kept breath fades in and out"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wanted:
    """The breath that a body would draw, had it all the time it wants."""

    to: float
    """fraction of VC"""
    length: float
    """s"""
    before: float
    """s of silence before it"""
    after: float
    """s between it and the speech"""


Inhale = Callable[[float, float, str], None]
"""Draws a breath now: to a volume, in a length, for a reason."""


def fit(placer: Placer, room: Room, wanted: Wanted, inhale: Inhale) -> None:
    """Fill the time until the speech; time is its onset afterwards, unless it is past already.

    Args:
        placer: The body, where its last speech has ended.
        room: What the recording leaves.
        wanted: What the body wants.
        inhale: Places the breath.
    """
    if room.breath is not None and room.breath.onset >= placer.time - NOTHING:
        _keep(placer, room.breath, wanted, inhale)
    else:
        _draw(placer, room.onset - placer.time, wanted, inhale)
    placer.hold("ready", snap(room.onset - placer.time), rule="physiology 1.4: until the recording speaks")


def _draw(placer: Placer, total: float, wanted: Wanted, inhale: Inhale) -> None:
    """A breath of its own, as late as it can be."""
    want = wanted.before + wanted.length + wanted.after
    spare = total - want
    length, after = wanted.length, wanted.after
    if spare < 0:
        edges = max(2 * LEAST_EDGE, min(wanted.before + wanted.after, 0.3 * total))
        length = min(length, total - edges)
        after = max(LEAST_EDGE, edges * wanted.after / max(wanted.before + wanted.after, 1e-6))
    length = snap(length)
    if length < SHORTEST:
        if wanted.to > placer.volume:
            placer.warn("no-room", f"the recording leaves {max(0.0, total):.2f} s: too little for a breath")
        return
    until = snap(placer.time + total - after - length)
    if spare > AT_REST:
        wait(placer, until, "physiology 1.6: while the recording is silent")
    placer.hold("rest", snap(until - placer.time), rule="physiology 1.4: the recording is silent")
    short = f", of {wanted.length:.2f} s wanted" if spare < 0 else ""
    inhale(_deep(placer, wanted.to, length), length, f"fitted: {length:.2f} s in a silence of {total:.2f} s{short}")


def _keep(placer: Placer, breath: KeptBreath, wanted: Wanted, inhale: Inhale) -> None:
    """The breath that is heard: the body moves with it, and its sound is the recording's."""
    placer.hold("rest", snap(breath.onset - placer.time), rule="physiology 1.4: the recording is silent")
    inhale(_deep(placer, wanted.to, breath.duration), breath.duration, "heard in the recording")
    last = placer.events[-1]
    assert isinstance(last, Inspiration)
    if not placer.p.breath_sound:
        return
    edge = snap(min(EDGE, breath.duration / 4))
    noise = Noise(
        onset=0.0, duration=last.duration, attack=edge, hold=snap(last.duration - 2 * edge), release=edge,
        level_db=snap(breath.level_db), seed=1, source=breath.media,
    )  # fmt: skip
    placer.events[-1] = replace(last, noise=noise, sound_mouth=1.0, sound_nose=0.0)


def _deep(placer: Placer, to: float, length: float) -> float:
    """As deep as wanted, as far as a chest can in so short a time."""
    litres = placer.state.person.vital_capacity
    most = 0.98 * FASTEST_FLOW * length / (litres * HIGHEST_FLOW["sine"])
    return snap(min(to, placer.volume + most * 0.999))
