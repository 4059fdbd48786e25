"""What an engine prints when something went wrong; it often ends with status 0 all the same."""

from __future__ import annotations

import signal
from collections.abc import Iterable

SIGNS: tuple[tuple[str, str], ...] = (
    ("not installed", "it lacks a unit generator"),
    ("exception in GraphDef_Recv", "it cannot read an instrument"),
    ("could not be opened", "it cannot read a sound file"),
    ("Command not found", "it does not know a command"),
    ("SynthDef not found", "it does not have an instrument"),
    ("no buffer data", "a sound was played before it was read"),
    ("real time memory", "too many sounds at once"),
    ("too many nodes", "too many sounds at once"),
    ("alloc failed", "it is out of memory"),
    ("out-of-order", "sounds are out of order"),
    ("OSC packet", "it cannot read its commands"),
    ("command file empty", "it cannot read its commands"),
    ("terminate called", "it crashed"),
    ("FAILURE IN SERVER", "a command failed"),
    ("exception", "it threw an exception"),
    ("ERROR", "it reports an error"),
)
"""Words in the engine's output and what they mean, the most telling first."""

_HARMLESS = ("dlopen", "LoadLibrary", "GetProcAddress", "scsynth_plug")
"""A third party's plug-in that does not load; if we need it, `not installed` follows."""
_SHOWN = 8


def failure(lines: Iterable[str]) -> tuple[str, tuple[str, ...]] | None:
    """What failed and the engine's words about it, or None.

    >>> failure(["nextOSCPacket 0.5", "FAILURE IN SERVER /s_new SynthDef not found"])
    ('it does not have an instrument', ('FAILURE IN SERVER /s_new SynthDef not found',))
    """
    telling = [line for line in lines if _sign(line) is not None and not any(word in line for word in _HARMLESS)]
    if not telling:
        return None
    _, meaning = min(sign for line in telling if (sign := _sign(line)) is not None)
    return meaning, words(telling)


def words(lines: Iterable[str]) -> tuple[str, ...]:
    """A few different lines of what the engine said, in order."""
    different = list(dict.fromkeys(line.strip() for line in lines if line.strip()))
    if len(different) <= _SHOWN:
        return tuple(different)
    return (*different[:_SHOWN], f"... and {len(different) - _SHOWN} more")


def ending(status: int) -> str:
    """How a process ended, in words.

    >>> ending(3), ending(-6)
    ('ended with status 3', 'was ended by SIGABRT')
    """
    if status >= 0:
        return f"ended with status {status}"
    try:
        return f"was ended by {signal.Signals(-status).name}"
    except ValueError:
        return f"was ended by signal {-status}"


def _sign(line: str) -> tuple[int, str] | None:
    return next(((rank, meaning) for rank, (word, meaning) in enumerate(SIGNS) if word in line), None)
