"""What moves ratios: one mover writes all of a body's, from what they were to what they come to."""

from __future__ import annotations

from supriya import SynthDef

from scorebreath_synthdefs.catalogue import HEARD, Instrument
from scorebreath_synthdefs.graph import FREE, builder, sc


def mover(name: str, instrument: Instrument) -> SynthDef:
    """A mover that glides, stays as long as an older one goes on, and frees itself; the buses keep what it wrote.

    Of several that write the last in the group counts: who comes later is added behind.
    """
    with builder(instrument) as graph:
        gliding = [
            sc.Line.kr(start=graph[f"{route}_from"], stop=graph[route], duration=graph["glide"]) for route in HEARD
        ]
        sc.ReplaceOut.kr(bus=graph["bus"], source=gliding)
        stay = graph["glide"] + graph["stay"]
        sc.Line.kr(start=0, stop=0, duration=stay + 4 * sc.ControlDur.ir(), done_action=FREE)
    return graph.build(name=name)
