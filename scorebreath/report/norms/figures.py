"""A published figure, whom it is about, and how a Score compares with it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from scorebreath.parameters.table import Parameters
from scorebreath.report.norms.sources import Mark
from scorebreath.score.document import Body, Score
from scorebreath.score.events import Inspiration
from scorebreath.score.values import LARGEST

Array = NDArray[np.float64]
Of = Literal["mean", "sd", "each", "value"]
"""What a figure speaks about: the mean of many breaths, their spread, every single one, or a row's one number."""
Word = Literal["within", "outside", "no figure to compare", "too few"]
Direction = Literal["below", "above", "below and above"]
Style = Literal["reading", "spontaneous"]
Route = Literal["mouth", "nose", "both"]

FEWEST: Mapping[Of, int] = {"mean": 5, "sd": 10, "each": 5, "value": 1}
"""Breaths that are needed before a figure of each kind is compared."""
SLACK = 5e-6
"""What rounding to the Score's grid may add to a length, s."""
ADULT = (18.0, 200.0)
UPRIGHT = "upright"


@dataclass(frozen=True, slots=True, kw_only=True)
class Circumstances:
    """Who speaks, and how: they choose the figures that apply."""

    style: Style
    model: str
    age: float
    """years"""
    posture: str
    loudness: float
    """per cent of comfortable, as an amplitude"""
    route: Route
    """what the speech inspirations sound through"""


@dataclass(frozen=True, slots=True, kw_only=True)
class When:
    """For whom a figure holds; what is left out does not matter."""

    style: Style | None = None
    age: tuple[float, float] | None = None
    """years, from .. below"""
    posture: str | None = None
    loudness: tuple[float, float] | None = None
    """per cent, from .. below"""
    route: Route | None = None
    papers: bool | None = None
    """whether the model is one of the two of S1 and S2"""

    def fits(self, c: Circumstances) -> bool:
        """Whether these are the circumstances."""
        return (
            self.style in (None, c.style)
            and (self.age is None or self.age[0] <= c.age < self.age[1])
            and self.posture in (None, c.posture)
            and (self.loudness is None or self.loudness[0] <= c.loudness < self.loudness[1])
            and self.route in (None, c.route)
            and self.papers in (None, c.model.startswith("bernardet"))
        )


ALWAYS = When()


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """A published range, or a mean with its spread, or a mean alone (which is shown, not compared)."""

    of: Of
    source: str
    """key in SOURCES"""
    mark: Mark
    low: float | None = None
    high: float | None = None
    mean: float | None = None
    sd: float | None = None
    when: When = ALWAYS
    judges: bool = True
    """whether the row's verdict counts it; others are shown beside it, with a verdict of their own"""
    note: str = ""

    @property
    def range(self) -> tuple[float, float] | None:
        """Lowest and highest value that agree (open ends infinite): one SD around a mean; None without any spread."""
        if self.mean is not None and self.sd is not None and self.low is None and self.high is None:
            return self.mean - self.sd, self.mean + self.sd
        if self.low is None and self.high is None:
            return None
        return -np.inf if self.low is None else self.low, np.inf if self.high is None else self.high


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """How a Score compares."""

    word: Word
    direction: Direction | None = None

    def __str__(self) -> str:
        """E.g. `outside: above`."""
        return f"{self.word}: {self.direction}" if self.direction else self.word


WITHIN = Verdict(word="within")
NO_FIGURE = Verdict(word="no figure to compare")
TOO_FEW = Verdict(word="too few")


def compare(values: Array, limits: tuple[float, float]) -> Verdict:
    """Whether numbers lie in a range.

    >>> str(compare(np.array([0.2, 0.5]), (0.3, 0.6))), str(compare(np.array([0.3]), (0.3, 0.6)))
    ('outside: below', 'within')
    """
    below, above = bool(np.any(values < limits[0] - SLACK)), bool(np.any(values > limits[1] + SLACK))
    if not below and not above:
        return WITHIN
    return Verdict(word="outside", direction=_direction(below, above))


def together(verdicts: list[Verdict]) -> Verdict:
    """One verdict of many: outside if any is, too few only where none could be compared."""
    found = [verdict for verdict in verdicts if verdict not in (NO_FIGURE, TOO_FEW)]
    if not found:
        return TOO_FEW if TOO_FEW in verdicts else NO_FIGURE
    said = " ".join(verdict.direction or "" for verdict in found)
    below, above = "below" in said, "above" in said
    return Verdict(word="outside", direction=_direction(below, above)) if below or above else WITHIN


def _direction(below: bool, above: bool) -> Direction:
    if below and above:
        return "below and above"
    return "below" if below else "above"


ALONE = 0.1
"""Share of the breaths' power below which a route counts as not used."""
NOSE_POWER = 10.0 ** (-6.0 / 10.0)
"""Of the nose at equal gain, relative to the mouth (physiology 3.2)."""


def circumstances(score: Score, body: Body) -> Circumstances:
    """What the Score says about its speaker; where it says nothing, or nonsense, the defaults of the parameters."""
    given = body.parameters
    style = given.get("style")
    return Circumstances(
        style="spontaneous" if style == "spontaneous" else "reading",
        model=score.model,
        age=_number(given, "age"),
        posture=posture if isinstance(posture := given.get("posture", UPRIGHT), str) else UPRIGHT,
        loudness=_number(given, "speaking_loudness"),
        route=_route(score, body.id),
    )


def _number(given: Mapping[str, object], name: str) -> float:
    value = given.get(name)
    if isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < LARGEST:
        return float(value)
    return float(Parameters.model_fields[name].default)


def _route(score: Score, body: str) -> Route:
    breaths = [event for event in score.of(Inspiration, body) if event.kind == "speech"]
    mouth = sum(event.sound_mouth**2 for event in breaths)
    nose = NOSE_POWER * sum(event.sound_nose**2 for event in breaths)
    if nose <= ALONE * (mouth + nose):
        return "mouth"
    return "nose" if mouth <= ALONE * (mouth + nose) else "both"
