"""The models by name."""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType

from scorebreath.errors import InputError, did_you_mean
from scorebreath.parameters.table import Parameters
from scorebreath.planning import bernardet_2017, bernardet_2019, natural
from scorebreath.planning.bernardet_2017 import Bernardet2017
from scorebreath.planning.bernardet_2019 import Bernardet2019
from scorebreath.planning.model import Planner, SyllableCounter
from scorebreath.planning.natural import Natural
from scorebreath.planning.syllables import pyphen_counter

Factory = Callable[[Parameters, str, SyllableCounter, bool], Planner]
"""A planner from parameters, language, the voice's syllable counter, and whether the text is verse."""

PLANNERS = MappingProxyType[str, Factory](
    {
        natural.NAME: Natural,
        bernardet_2017.NAME: lambda values, language, _, poem: Bernardet2017(values, pyphen_counter(language), poem),
        bernardet_2019.NAME: lambda values, language, _, poem: Bernardet2019(values, pyphen_counter(language), poem),
    }
)
"""The papers' models count syllables by hyphenation, as the papers do; `natural` as the voice says them."""

DEFAULT = natural.NAME


def open_planner(
    model: str, parameters: Parameters, language: str, count: SyllableCounter, *, poem: bool = False
) -> Planner:
    """A planner at the beginning of a text.

    Args:
        model: A name of `PLANNERS`.
        parameters: What was set.
        language: BCP 47.
        count: The voice's syllable counter.
        poem: Whether line ends are phrase edges, also behind a comma.

    Raises:
        InputError: No such model.
    """
    factory = PLANNERS.get(model)
    if factory is None:
        raise InputError(f"model={model!r} must be one of {', '.join(PLANNERS)}{did_you_mean(model, PLANNERS)}")
    return factory(parameters, language, count, poem)
