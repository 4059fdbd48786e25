"""The models by name."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Protocol

from scorebreath.errors import InputError, did_you_mean
from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning import bernardet_2017, bernardet_2019, natural
from scorebreath.planning.bernardet_2017 import Bernardet2017
from scorebreath.planning.bernardet_2019 import Bernardet2019
from scorebreath.planning.model import Planner, SyllableCounter
from scorebreath.planning.natural import Natural
from scorebreath.planning.syllables import pyphen_counter


class Factory(Protocol):
    """Makes a planner at the beginning of a text; arguments as of `open_planner`."""

    def __call__(
        self,
        parameters: Parameters,
        language: str,
        count: SyllableCounter,
        poem: bool,
        *,
        blend: Blend | None,
        time: float,
        seed: int,
        body: str,
        cast: Mapping[str, Parameters] | None,
    ) -> Planner:
        """A planner."""


def _papers(model: type[Bernardet2017 | Bernardet2019]) -> Factory:
    """The papers' models count syllables by hyphenation, as the papers do, and know neither states nor chance."""

    def factory(
        parameters: Parameters, language: str, count: SyllableCounter, poem: bool, **_: object
    ) -> Bernardet2017 | Bernardet2019:
        return model(parameters, pyphen_counter(language), poem)

    return factory


PLANNERS = MappingProxyType[str, Factory](
    {
        natural.NAME: Natural,
        bernardet_2017.NAME: _papers(Bernardet2017),
        bernardet_2019.NAME: _papers(Bernardet2019),
    }
)

DEFAULT = natural.NAME


def open_planner(
    model: str,
    parameters: Parameters,
    language: str,
    count: SyllableCounter,
    *,
    poem: bool = False,
    blend: Blend | None = None,
    time: float = 0.0,
    seed: int = 0,
    body: str = "body",
    cast: Mapping[str, Parameters] | None = None,
) -> Planner:
    """A planner at the beginning of a text.

    Args:
        model: A name of `PLANNERS`.
        parameters: What was set.
        language: BCP 47.
        count: The voice's syllable counter.
        poem: Whether line ends are phrase edges, also behind a comma.
        blend: States the body is in when the text begins (`natural`).
        time: When it begins, on the blend's clock, s.
        seed: Of chance (`natural`).
        body: Whose chance it is.
        cast: Parameters of those who speak with another voice, by its name (`natural`); else as the first one's.

    Raises:
        InputError: No such model.
    """
    factory = PLANNERS.get(model)
    if factory is None:
        raise InputError(f"model={model!r} must be one of {', '.join(PLANNERS)}{did_you_mean(model, PLANNERS)}")
    return factory(parameters, language, count, poem, blend=blend, time=time, seed=seed, body=body, cast=cast)
