"""What an engine is told live, as OSC messages."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from scorebreath.engine.live.layout import Layout
from scorebreath.engine.moves import Move
from scorebreath.engine.onsets import Onset
from scorebreath.engine.osc import Argument, message
from scorebreath.score.performing import Heard
from scorebreath_synthdefs.catalogue import ALL, HEARD, MOVER, PLACE, master_name
from scorebreath_synthdefs.compiled import compiled

_HEAD, _TAIL = 0, 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Mix:
    """How sounds leave the engine."""

    channels: int = 2
    """1 or 2"""
    out: int = 0
    """first output"""
    limited: bool = True
    """peaks are held below -1 dB, 20 ms late"""
    gain: float = 1.0
    """amplitude"""
    pans: Mapping[str, float] = field(default_factory=dict)
    """-1..1 of bodies that are not in the middle"""


def instrument(name: str) -> bytes:
    """An instrument of the catalogue, one a message: a datagram has a size."""
    return message("/d_recv", compiled(name))


def synth(name: str, node: int, action: int, target: int, controls: Mapping[str, float]) -> bytes:
    """A new node; controls at their defaults are left out."""
    row = ALL[name].controls
    said: list[Argument] = []
    for key, value in sorted(controls.items()):
        if value != row[key].default:
            said += [key, float(value)]
    return message("/s_new", name, node, action, target, *said)


def sound(onset: Onset, node: int, layout: Layout, body: int, buffer: int | None) -> bytes:
    """A sound of a body."""
    controls = {**onset.controls, "out": float(layout.audio(body)), "heard": float(layout.control(body))}
    if buffer is not None:
        controls["buffer"] = float(buffer)
    return synth(onset.instrument, node, _HEAD, layout.sounds, controls)


def mover(move: Move, node: int, layout: Layout, body: int) -> bytes:
    """A move of a body's ratios."""
    return synth(MOVER, node, _TAIL, layout.movers, move.controls(layout.control(body)))


def controls(node: int, said: Mapping[str, float]) -> bytes:
    """Controls of a node."""
    return message("/n_set", node, *(part for key, value in sorted(said.items()) for part in (key, float(value))))


def stage(layout: Layout, mix: Mix) -> Iterable[bytes]:
    """Our groups and the master, in an engine that has none of ours."""
    yield message("/g_new", layout.root, _TAIL, 0)
    for group in (layout.movers, layout.sounds, layout.mixing):
        yield message("/g_new", group, _TAIL, layout.root)
    settings = {"bus": float(layout.mix), "out": float(mix.out), "gain": mix.gain}
    yield synth(master_name(mix.channels, mix.limited), layout.master, _TAIL, layout.mixing, settings)


def body(layout: Layout, number: int, pan: float, heard: Heard) -> Iterable[bytes]:
    """A body between the speakers, with ratios in force."""
    values = [float(getattr(heard, route)) for route in HEARD]
    yield message("/c_setn", layout.control(number), len(values), *values)
    settings = {"bus": float(layout.audio(number)), "out": float(layout.mix), "pan": pan}
    yield synth(PLACE, layout.place(number), _HEAD, layout.mixing, settings)
