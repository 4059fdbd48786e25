"""What a body does besides speaking, each kind a row: sighs, gasps, sniffs, laughter, held and audible breaths.

Levels are relative to `breath_level`, through the mouth alone. An act comes from the markup, or from a state that makes
it likely; either way it is placed by the function of its row.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from scorebreath.compose.idle import SINKING, wait
from scorebreath.compose.lungs import TOP
from scorebreath.compose.placer import Placer
from scorebreath.compose.sounds import Air, sources
from scorebreath.score.event import Origin
from scorebreath.score.events import Noise
from scorebreath.script.marks import LONG_PAUSE, Act, ActName
from scorebreath.units import snap

LAUGH_RATE, LAUGH_SPREAD = 4.6, 0.12
"""Puffs a second, and their coefficient of variation over bouts (Filippelli 2001: 4.6 +- 1.1 Hz)."""
LAUGH_PUFFS = (3, 8)
LAUGH_BELOW = 1.0
"""L below the resting level at which laughter ends (physiology 4.2; Filippelli 2001: 1.55 L in long bouts)."""
SIGH_DEPTH = 2.2
"""Times a resting breath (Vlemincx 2013: 2 to 3)."""
ROOM = 0.03
"""Volume, fraction of VC, that a sniff needs."""
CATCH = 0.06
"""s that the throat's catch sounds when a breath is held."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """An act as it is asked for."""

    seconds: float | None = None
    level_db: float = 0.0
    length: float = 1.0
    origin: Origin = "rule"
    rule: str = ""

    def lasting(self, seconds: float) -> float:
        """How long it takes, s, where it takes `seconds` by itself."""
        return self.seconds if self.seconds is not None else seconds * self.length


def asked(act: Act) -> Asked:
    """By the markup."""
    return Asked(
        seconds=act.seconds, level_db=act.level_db, length=act.length, origin="markup", rule=f"asked: {act.written}"
    )


def perform(placer: Placer, name: ActName, how: Asked) -> None:
    """Place an act now."""
    ACTS[name](placer, how)


def _breath(placer: Placer, how: Asked) -> None:
    """In and out, as deep as a breath for speech; not the inspiration of a group, which is `natural`'s."""
    depth = placer.p.volume_per_syllable * placer.p.norm_syllables
    placer.inhale(
        "breath", max(placer.volume, placer.levels.rest) + depth, how.lasting(0.7), rule=how.rule, origin=how.origin,
        air=Air(extra_db=how.level_db),
    )  # fmt: skip
    placer.exhale("breath_out", placer.levels.rest, how.lasting(1.1), rule=how.rule, kind="tidal", origin=how.origin,
                  profile="exponential", air=SINKING)  # fmt: skip


def _sigh(placer: Placer, how: Asked) -> None:
    """A deep breath, most of it through the nose, and let go through the open mouth."""
    p, m, level = placer.p, placer.modifiers, placer.levels
    gain = p.amplitude_breathing_sound
    depth = max(0.18, SIGH_DEPTH * p.tidal_volume * placer.chances.between("sigh.depth", 0.9, 1.15))
    whole = how.lasting(1.3 * m.inspiration + 1.9)
    placer.inhale(
        "sigh", max(level.rest, placer.volume) + depth, 0.4 * whole, rule=how.rule, kind="sigh", origin=how.origin,
        nose=0.6 * gain, mouth=0.4 * gain, air=Air(extra_db=how.level_db), peak=0.5,
    )  # fmt: skip
    placer.exhale(
        "sigh_out", level.rest - 0.02, 0.6 * whole, rule=how.rule, kind="sigh", origin=how.origin, mouth=gain,
        opening=1.2, profile="exponential", peak=0.12,
        air=Air(kind="sigh", level_db=-3.0, extra_db=how.level_db, delay=0.0, trapezoid=(0.10, 0.70)),
    )  # fmt: skip


def _gasp(placer: Placer, how: Asked) -> None:
    """A gasp for nothing: the breath is let go again. Before speech it is `natural`'s inspiration."""
    gasp(placer, placer.levels.rest + 0.25, how)
    placer.exhale("gasp_out", placer.levels.rest, 1.2, rule=how.rule, kind="tidal", origin=how.origin,
                  profile="exponential", air=SINKING)  # fmt: skip


def gasp(placer: Placer, to: float, how: Asked) -> None:
    """Fast and loud through the wide open mouth, ends abruptly, and is held for a moment (physiology 3.3, 4.2)."""
    gain = placer.p.amplitude_breathing_sound
    length = how.lasting(placer.chances.between("gasp.length", 0.30, 0.45))
    release = min(0.2, 0.05 / length)
    deep = max(to, placer.levels.rest + 0.25, placer.volume + 0.12)
    placer.inhale(
        "gasp", deep, length, rule=how.rule, kind="gasp", origin=how.origin,
        nose=0.05 * gain, mouth=0.95 * gain, opening=2.5, peak=0.7,
        air=Air(kind="gasp", level_db=4.0, extra_db=how.level_db, delay=0.02, trapezoid=(0.6, release)),
    )  # fmt: skip
    placer.hold("gasp_hold", placer.chances.between("gasp.hold", 0.2, 0.6), rule=how.rule, origin=how.origin, held=True)


def _sniff(placer: Placer, how: Asked) -> None:
    """One or two short breaths through the nose; none where the lungs are full."""
    if placer.volume > TOP - ROOM:
        placer.warn("full-lungs", f"{how.rule or 'a sniff'}: the lungs are full, nothing more goes in")
        return
    gain = placer.p.amplitude_breathing_sound
    count = 2 if placer.chances.happens("sniff.twice", 0.35) and how.seconds is None else 1
    base = placer.chances
    for number in range(count):
        if number:
            placer.hold("sniff_gap", 0.12, rule=how.rule, origin=how.origin)
            placer.chances = replace(base, place=f"{base.place}/{number}")  # no two sniffs are the same
        placer.inhale(
            "sniff", placer.volume + 0.025, how.lasting(0.22), rule=how.rule, kind="sniff", origin=how.origin,
            nose=gain, mouth=0.0, opening=2.0, peak=0.35,
            air=Air(kind="sniff", level_db=3.0, extra_db=how.level_db, delay=0.01, trapezoid=(0.2, 0.35)),
        )  # fmt: skip
    placer.chances = base


def _laugh(placer: Placer, how: Asked) -> None:
    """A bout of puffs that empties the lungs below rest; breath is drawn for it where there is too little."""
    p, level, chances = placer.p, placer.levels, placer.chances
    gain = p.amplitude_breathing_sound
    rate = LAUGH_RATE * chances.about("laugh.rate", 1.0, LAUGH_SPREAD)
    few, many = LAUGH_PUFFS
    count = few + int(chances.share("laugh.count") * (many - few + 1))
    if how.seconds is not None:
        count = max(1, round(how.seconds * rate))
    end = max(level.floor, level.rest - LAUGH_BELOW / placer.state.person.vital_capacity)
    if placer.volume < level.rest + 0.08:
        placer.inhale("laugh_in", level.rest + 0.14, 0.4, rule=how.rule, origin=how.origin, mouth=gain, nose=0.1 * gain,
                      opening=1.5)  # fmt: skip
    placer.exhale(
        "laugh", end, count / rate, rule=how.rule, kind="laugh", origin=how.origin, mouth=gain, opening=1.6,
        puffs=tuple(number / rate for number in range(count)), peak=0.25,
        air=Air(kind="laugh", level_db=6.0, extra_db=how.level_db, delay=0.0, trapezoid=(0.15, 0.6)),
    )  # fmt: skip


def puff(placer: Placer, how: Asked) -> None:
    """A single puff through the nose, of amusement (physiology 4.2: 0.12 s, -20 dB)."""
    gain = placer.p.amplitude_breathing_sound
    placer.exhale(
        "puff", placer.volume - 0.02, 0.12, rule=how.rule, kind="laugh", origin=how.origin, nose=gain, mouth=0.0,
        opening=1.5, puffs=(0.0,),
        air=Air(kind="laugh", level_db=10.0, extra_db=how.level_db, delay=0.0, trapezoid=(0.2, 0.5)),
    )  # fmt: skip


def _exhale(placer: Placer, how: Asked) -> None:
    """An audible out-breath; a quiet breath is taken for it where there is too little."""
    level = placer.levels
    if placer.volume - level.reserve < 0.16:
        placer.inhale("exhale_in", level.rest + 0.12, 0.8, rule=how.rule, origin=how.origin, air=Air(extra_db=-6.0))
    let_go(placer, level.rest - 0.04, 1.0, how)


def let_go(placer: Placer, to: float, seconds: float, how: Asked) -> None:
    """Air out through the open mouth, to be heard."""
    gain = placer.p.amplitude_breathing_sound
    placer.exhale(
        "exhale", to, how.lasting(seconds), rule=how.rule, kind="audible", origin=how.origin, mouth=gain, opening=1.0,
        peak=0.3, air=Air(kind="exhale", level_db=-3.0, extra_db=how.level_db),
    )  # fmt: skip


def _hold(placer: Placer, how: Asked) -> None:
    """The throat shuts, with a soft catch, and the breath stays in."""
    length = snap(how.lasting(0.5))
    placer.hold("hold", length, rule=how.rule, origin=how.origin, held=True, noise=_catch(placer, how, length))


def _catch(placer: Placer, how: Asked, length: float) -> Noise | None:
    p = placer.p
    if not p.breath_sound or length <= 0:
        return None
    sounding = min(CATCH, length)
    attack = snap(sounding * 0.1)
    return Noise(
        onset=0.0, duration=snap(sounding), attack=attack, hold=0.0, release=snap(snap(sounding) - attack),
        level_db=snap(p.breath_level - 8.0 + how.level_db), seed=placer.chances.noise("hold.noise"),
        **sources(placer.state, placer.chances.place, "hold"),
    )  # fmt: skip


def _pause(placer: Placer, how: Asked) -> None:
    """Silence; the body breathes at rest in a long one."""
    length = snap(how.lasting(0.5))
    placer.pause("asked", "asked", length, rule=how.rule, origin=how.origin)
    if length >= LONG_PAUSE and placer.feeling.lives:
        wait(placer, snap(placer.time + length), how.rule)
    else:
        placer.hold("still", length, rule=how.rule, origin=how.origin)


ACTS: Mapping[ActName, Callable[[Placer, Asked], None]] = MappingProxyType(
    {
        "breath": _breath,
        "sigh": _sigh,
        "gasp": _gasp,
        "sniff": _sniff,
        "laugh": _laugh,
        "exhale": _exhale,
        "hold": _hold,
        "pause": _pause,
    }
)
"""Every act by its name."""
