"""What may stand after an option, for shell completion."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from scorebreath_cli.settings import FACE_PARTS, MARKUPS


def models() -> list[str]:
    """Planners."""
    from scorebreath.planning.planners import PLANNERS

    return sorted(PLANNERS)


def presets() -> list[str]:
    """Presets of ours."""
    from scorebreath.parameters.presets import names

    return list(names())


def voices() -> list[str]:
    """Voices, without their variants."""
    from scorebreath.speech.voices import list_voices

    return [voice.name for voice in list_voices()]


def states() -> list[str]:
    """Breathing states."""
    from scorebreath.parameters.state_table import STATES

    return sorted(STATES)


def markups() -> list[str]:
    """Kinds of markup."""
    return list(MARKUPS)


def faces() -> list[str]:
    """Ways a face can behave."""
    from scorebreath.parameters.face_table import FACES

    return list(FACES)


def parts() -> list[str]:
    """Parts of a face."""
    return list(FACE_PARTS)


def rigs() -> list[str]:
    """Characters whose shapes are known."""
    from scorebreath.curves.rigs.table import RIGS

    return list(RIGS)


def engines() -> list[str]:
    """Sound engines."""
    from scorebreath.engine.engines import ENGINES

    return list(ENGINES)


def live_engines() -> list[str]:
    """Engines that play as things happen, up to where a file or an address begins."""
    from scorebreath.engine.live.making import NAMES

    return [name.removesuffix("FILE").removesuffix("HOST:PORT") for name in NAMES]


def targets() -> list[str]:
    """Where curves can go, up to where the address begins."""
    from scorebreath.live.streams.addresses import SCHEMES, STDOUT

    return [*(f"{row.name}://" if row.host else f"{row.name}:" for row in SCHEMES.values()), STDOUT]


def assignments() -> list[str]:
    """Parameters, up to where the value begins."""
    return [f"{name}=" for name in parameters()]


def parameters() -> list[str]:
    """Parameters."""
    from scorebreath.parameters.table import Parameters

    return list(Parameters.model_fields)


def formats() -> list[str]:
    """Formats that a score can be written in."""
    from scorebreath.formats.formats import FORMATS

    return list(FORMATS)


CHOICES: Mapping[str, Callable[[], list[str]]] = MappingProxyType(
    {
        kind.__name__: kind
        for kind in (
            models,
            formats,
            presets,
            voices,
            states,
            markups,
            faces,
            parts,
            rigs,
            engines,
            live_engines,
            targets,
            assignments,
            parameters,
        )
    }
)
"""Every kind of name that completes."""
