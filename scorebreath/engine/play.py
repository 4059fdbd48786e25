"""Onsets into any supriya context, a score or a running server, or into the commands of an offline run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scorebreath.engine.moves import Move
from scorebreath.engine.onsets import Onset
from scorebreath_synthdefs.catalogue import MOVER, synthdef

if TYPE_CHECKING:
    from supriya import Context

    from scorebreath.engine.commands import Commands

PRELOAD = 0.5
"""Seconds before its onset that a sound is read from disk."""
KEEP = 0.25
"""Seconds after its end that it is forgotten."""
CUT_AHEAD = 0.03
"""Seconds before a cut that the sound learns of it: some of the engine's blocks, at any rate."""

Named = Callable[[str], Any]
"""From an instrument's name to what the context knows it by."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Places:
    """Where things go in a context."""

    buses: Mapping[str, int] = field(default_factory=dict)
    """first control bus of each body that can be moved"""
    movers: Any = None
    """the group of what moves, before all that sounds"""
    sounds: Any = None
    """the group of what sounds; None: all that there is"""


def load(
    context: Context | Commands,
    instruments: Iterable[str],
    *,
    buses: Mapping[str, int] | None = None,
    instrument: Named = synthdef,
) -> Places:
    """Give the context the instruments, and places; to be called within a moment (`with context.at(...)`)."""
    told: Any = context
    names = sorted({*instruments, *([MOVER] if buses else [])})
    if names:
        told.add_synthdefs(*map(instrument, names))
    if not buses:
        return Places()
    return Places(buses=buses, movers=told.add_group(), sounds=told.add_group(add_action="ADD_TO_TAIL"))


def cut_controls(sound: Onset) -> dict[str, float]:
    """What a sound that is cut is told; empty for one that is not."""
    return {} if sound.cut is None else {"cut": sound.cut.time - sound.time, "fade": sound.cut.fade}


def told_of_cut(sound: Onset) -> float:
    """When a sound that is cut is told of it, s: not before it begins."""
    assert sound.cut is not None
    return max(sound.time, sound.cut.time - CUT_AHEAD)


def play(
    context: Context | Commands,
    sounds: Iterable[Onset],
    *,
    when: Callable[[float], float],
    where: Callable[[str], str],
    moves: Iterable[Move] = (),
    places: Places | None = None,
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
        moves: What is moved meanwhile, in order of time, of bodies that have buses.
        places: What `load` gave.
        preload: Seconds before its onset that a file is read.
        instrument: From a name to what the context takes: a SynthDef, or the name itself.
    """
    told: Any = context  # the two differ in what they call an instrument
    places = places or Places()
    for move in moves:
        with told.at(when(move.time)):
            told.add_synth(
                instrument(MOVER), add_action="ADD_TO_TAIL", target_node=places.movers,
                **move.controls(places.buses[move.body]),
            )  # fmt: skip
    for sound in sounds:
        settings: dict[str, Any] = {**sound.controls}
        if sound.body in places.buses:
            settings["heard"] = float(places.buses[sound.body])
        buffer = None
        if sound.media is not None:
            with told.at(when(max(0.0, sound.time - preload))):
                buffer = told.add_buffer(file_path=Path(where(sound.media)))
                settings["buffer"] = buffer.id_
        with told.at(when(sound.time)):
            node = told.add_synth(instrument(sound.instrument), target_node=places.sounds, **settings)
        if sound.cut is not None:
            with told.at(when(told_of_cut(sound))):
                told.set_node(node, **cut_controls(sound))
        if buffer is not None:
            with told.at(when(sound.end + KEEP)):
                told.free_buffer(buffer)
