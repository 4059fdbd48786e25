"""When, roughly, each place of a text is said, and the body's state there: no voice has spoken yet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import exp, log
from typing import NamedTuple

from scorebreath.parameters.modifiers import Modifiers, modifiers
from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning import starts
from scorebreath.planning.sites import Habits
from scorebreath.planning.starts import RATE, Start
from scorebreath.planning.units import Unit
from scorebreath.script.marks import DIVIDING, Act, BreathingMark, Mark, ProsodyMark, StateMark, VoiceMark

STEPS = 20
"""Steps a factor is rounded to, in an e-fold: starts within 5 % are one, so that they can be compared."""
COARSE = 4
"""Steps that draws are rounded to: they differ at every place, and only equal starts can be compared."""
LEVELS = 20
"""Steps an intensity is rounded to."""
SHIFTS = 50.0
"""Steps that shifts of the lungs' levels are rounded to, in a vital capacity."""
REMEMBERED = 2000
"""starts and states that are remembered"""
ACT = 0.8
"""s that a breath or a sound of one takes, where the markup does not say"""
HELD = 0.5
"""s of a held breath, where the markup does not say"""


class _Steps(NamedTuple):
    """What a start depends on, rounded."""

    length: int
    volume: int
    shift: int
    rate: int
    frequency: int


@dataclass(slots=True, kw_only=True)
class _Speaker:
    """Whose breath it is, and what was worked out for them."""

    p: Parameters
    blend: Blend
    modifiers: dict[tuple[tuple[str, float], ...], Modifiers] = field(default_factory=dict)
    starts: dict[_Steps, Start] = field(default_factory=dict)


class Timeline:
    """Goes along with the text, unit by unit.

    Args:
        parameters: What was set.
        blend: The states at the beginning of the text.
        time: When the text begins, on the blend's clock, s.
        habits: Of the way of speaking.
        cast: Parameters of those who speak with another voice, by its name; else as the first one's.
    """

    def __init__(
        self,
        parameters: Parameters,
        blend: Blend,
        *,
        time: float = 0.0,
        habits: Habits,
        cast: Mapping[str, Parameters] | None = None,
    ) -> None:
        """Stand before the text."""
        self.time = time
        self._habits = habits
        self._rate = self._frequency = 1.0
        self._cast = cast or {}
        self._speakers = {"": _Speaker(p=parameters, blend=blend)}
        self._who = self._speakers[""]

    @property
    def shortness(self) -> float:
        """How long groups are here and now, relative to those of a person at ease."""
        return self._now().syllables / self._frequency

    def heed(self, marks: Sequence[Mark]) -> None:
        """What the markup asks for here is done, and takes its time."""
        for mark in marks:
            who = self._who
            if isinstance(mark, VoiceMark):
                self._who = self._speaker(mark.voice)
            elif isinstance(mark, StateMark):
                who.blend, _ = who.blend.changed(self.time, mark.name, mark.intensity, mark.ramp, held=mark.held)
            elif isinstance(mark, ProsodyMark):
                self._rate = mark.rate
            elif isinstance(mark, BreathingMark):
                self._frequency = mark.frequency
            elif isinstance(mark, Act):
                usual = ACT if mark.name in DIVIDING else HELD if mark.name == "hold" else who.p.breathless_pause
                self.time += usual if mark.seconds is None else mark.seconds

    def _speaker(self, voice: str) -> _Speaker:
        if voice not in self._speakers:
            self._speakers[voice] = _Speaker(p=self._cast.get(voice, self._speakers[""].p), blend=Blend())
        return self._speakers[voice]

    def say(self, unit: Unit, longer: float = 1.0) -> Start:
        """A unit is said, and what stands behind it.

        Args:
            unit: The next.
            longer: x preferred length of a group that begins behind it.

        Returns:
            The start of such a group.
        """
        p = self._who.p
        preferred = self.start().preferred
        breath = p.inspiration_base + p.silence_before_breath + p.silence_after_breath
        self.time += unit.syllables * (
            1.0 / (RATE * p.prosody_rate * self._rate) + p.inspiration_per_syllable + breath / preferred
        )
        if unit.edge == "paragraph":
            self.time += p.silence_after_paragraph
        elif unit.closes:
            self.time += p.silence_after_sentence
        self.heed(unit.after)
        return self.start(longer)

    def start(self, longer: float = 1.0) -> Start:
        """The body here and now; `longer`: x preferred length."""
        now = self._now()
        here = _Steps(
            length=_step(now.syllables) + COARSE * round(log(longer) * STEPS / COARSE),
            volume=_step(now.volume),
            shift=round(now.start * SHIFTS),
            rate=_step(self._rate),
            frequency=_step(self._frequency),
        )
        made = self._who.starts
        if here not in made:
            if len(made) >= REMEMBERED:
                made.clear()
            made[here] = self._made(here)
        return made[here]

    def _made(self, here: _Steps) -> Start:
        p, volume, rate = self._who.p, _factor(here.volume), _factor(here.rate)
        length = self._habits.length * _factor(here.length)
        return starts.start(
            starts.preferred_syllables(p, length, rate, _factor(here.frequency)),
            starts.most_syllables(p, volume, here.shift / SHIFTS, rate),
            starts.syllable_volume(p) * volume,
            spread=self._habits.spread,
            budget=self._habits.budget,
        )

    def _now(self) -> Modifiers:
        who = self._who
        levels = ((name, round(level * LEVELS) / LEVELS) for name, level in who.blend.at(self.time).items())
        states = tuple(sorted((name, level) for name, level in levels if level))
        if states not in who.modifiers:
            if len(who.modifiers) >= REMEMBERED:
                who.modifiers.clear()
            who.modifiers[states] = modifiers(who.p, dict(states))
        return who.modifiers[states]


def _step(factor: float) -> int:
    return round(log(factor) * STEPS)


def _factor(step: int) -> float:
    return exp(step / STEPS)
