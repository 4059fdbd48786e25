"""A click that is sent out and listened for."""

from __future__ import annotations

from supriya import SynthDef

from scorebreath_synthdefs.catalogue import CLICK_LENGTH, Instrument
from scorebreath_synthdefs.graph import FREE, builder, sc


def click(name: str, instrument: Instrument) -> SynthDef:
    """A click on both outputs at the first sample, and a recording from that sample on."""
    with builder(instrument) as graph:
        sound = sc.Trig.ar(source=sc.Impulse.ar(frequency=0), duration=CLICK_LENGTH) * graph["level"]
        sc.Out.ar(bus=graph["out"], source=[sound, sound])
        heard = sc.In.ar(bus=sc.NumOutputBuses.ir(), channel_count=1)
        sc.RecordBuf.ar(buffer_id=graph["buffer"], source=[heard], loop=0, done_action=FREE)
    return graph.build(name=name)
