"""Onsets into any supriya context: a score to be rendered, or a running server."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scorebreath.engine.onsets import Onset
from scorebreath_synthdefs.catalogue import synthdef

if TYPE_CHECKING:
    from supriya import Context

PRELOAD = 0.5
"""Seconds before its onset that a sound is read from disk."""
KEEP = 0.25
"""Seconds after its end that it is forgotten."""


def load(context: Context, instruments: Iterable[str]) -> None:
    """Give the context the instruments; to be called within a moment (`with context.at(...)`)."""
    names = sorted(set(instruments))
    if names:
        context.add_synthdefs(*(synthdef(name) for name in names))


def play(
    context: Context,
    sounds: Iterable[Onset],
    *,
    when: Callable[[float], float],
    where: Callable[[str], str],
    preload: float = PRELOAD,
) -> None:
    """Put sounds into a context that has their instruments.

    Media are read shortly before they sound and freed after, so what an engine holds does not grow with the Score.

    Args:
        context: A supriya score or server.
        sounds: What sounds, in order of time.
        when: From the Score's seconds to the context's.
        where: From the SHA-256 of media to a file the engine can read: mono, its own rate, ending with a zero.
        preload: Seconds before its onset that a file is read.
    """
    for sound in sounds:
        settings: dict[str, Any] = dict(sound.controls)
        if sound.media is None:
            with context.at(when(sound.time)):
                context.add_synth(synthdef(sound.instrument), **settings)
            continue
        with context.at(when(max(0.0, sound.time - preload))):
            buffer = context.add_buffer(file_path=Path(where(sound.media)))
        with context.at(when(sound.time)):
            context.add_synth(synthdef(sound.instrument), buffer=buffer.id_, **settings)
        with context.at(when(sound.end + KEEP)):
            context.free_buffer(buffer)
