"""The breathing models by name: how a planned and spoken group is placed in time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from scorebreath.compose import bernardet, natural
from scorebreath.compose.state import BodyState, Spoken
from scorebreath.errors import InputError, did_you_mean
from scorebreath.parameters.table import Parameters
from scorebreath.score.document import Person
from scorebreath.score.events import Event
from scorebreath.script.marks import Mark


@dataclass(frozen=True, slots=True, kw_only=True)
class BreathingModel:
    """The functions of a breathing model."""

    person: Callable[[Parameters], Person]
    """the body that breathes"""
    step: Callable[[BodyState, Spoken], tuple[BodyState, list[Event]]]
    """places one group"""
    finish: Callable[[BodyState, float], tuple[BodyState, list[Event]]]
    """what follows the last group, and so many seconds more"""
    rest: Callable[[BodyState, float, str], tuple[BodyState, list[Event]]]
    """what it does until a time while it has nothing to say; the text names what for"""
    act: Callable[[BodyState, tuple[Mark, ...], str], tuple[BodyState, list[Event]]]
    """does what markup asks for that belongs to no group"""
    idle: Callable[[BodyState], tuple[BodyState, list[Event]]]
    """a breath's time more at rest, while nobody knows for how long"""
    has_states: bool = False
    """whether moods and efforts move its breath"""


_BERNARDET = BreathingModel(
    person=bernardet.person,
    step=bernardet.step,
    finish=bernardet.finish,
    rest=bernardet.rest,
    act=bernardet.act,
    idle=bernardet.idle,
)

MODELS: Mapping[str, BreathingModel] = MappingProxyType(
    {
        "bernardet-2017": _BERNARDET,
        "bernardet-2019": _BERNARDET,
        "natural": BreathingModel(
            person=natural.person,
            step=natural.step,
            finish=natural.finish,
            rest=natural.rest,
            act=natural.act,
            idle=natural.idle,
            has_states=True,
        ),
    }
)
"""Each model has a planner of the same name."""


def breathing_model(name: str) -> BreathingModel:
    """The model of that name.

    Raises:
        InputError: There is none.
    """
    if name not in MODELS:
        raise InputError(f"no model is called {name!r} (there are {', '.join(MODELS)}){did_you_mean(name, MODELS)}")
    return MODELS[name]
