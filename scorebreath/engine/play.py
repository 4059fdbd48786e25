"""Onsets into any supriya context, a score or a running server, or into the commands of an offline run."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scorebreath.engine.onsets import Onset
from scorebreath_synthdefs.catalogue import synthdef

if TYPE_CHECKING:
    from supriya import Context

    from scorebreath.engine.commands import Commands

PRELOAD = 0.5
"""Seconds before its onset that a sound is read from disk."""
KEEP = 0.25
"""Seconds after its end that it is forgotten."""


Named = Callable[[str], Any]
"""From an instrument's name to what the context knows it by."""


def load(context: Context | Commands, instruments: Iterable[str], *, instrument: Named = synthdef) -> None:
    """Give the context the instruments; to be called within a moment (`with context.at(...)`)."""
    names = sorted(set(instruments))
    if names:
        context.add_synthdefs(*map(instrument, names))


def play(
    context: Context | Commands,
    sounds: Iterable[Onset],
    *,
    when: Callable[[float], float],
    where: Callable[[str], str],
    preload: float = PRELOAD,
    instrument: Named = synthdef,
) -> None:
    """Put sounds into a context that has their instruments.

    Media are read shortly before they sound and freed after, so what an engine holds does not grow with the Score.

    Args:
        context: A supriya score or server, or an offline run's commands.
        sounds: What sounds, in order of time.
        when: From the Score's seconds to the context's.
        where: From the SHA-256 of media to a file the engine can read: mono, its own rate, ending with a zero.
        preload: Seconds before its onset that a file is read.
        instrument: From a name to what the context takes: a SynthDef, or the name itself.
    """
    told: Any = context  # the two differ in what they call an instrument
    for sound in sounds:
        settings: dict[str, Any] = dict(sound.controls)
        if sound.media is None:
            with told.at(when(sound.time)):
                told.add_synth(instrument(sound.instrument), **settings)
            continue
        with told.at(when(max(0.0, sound.time - preload))):
            buffer = told.add_buffer(file_path=Path(where(sound.media)))
        with told.at(when(sound.time)):
            told.add_synth(instrument(sound.instrument), buffer=buffer.id_, **settings)
        with told.at(when(sound.end + KEEP)):
            told.free_buffer(buffer)
