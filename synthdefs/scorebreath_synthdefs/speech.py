"""The speech player."""

from __future__ import annotations

from supriya import SynthDef

from scorebreath_synthdefs.catalogue import Instrument
from scorebreath_synthdefs.graph import FREE, builder, sc
from scorebreath_synthdefs.touch import touched


def speech(name: str, instrument: Instrument) -> SynthDef:
    """An instrument that plays one buffer once from `start` on, sample for sample, and frees itself.

    `PlayBuf` holds the last sample until its block ends: the buffer must end with a zero.
    """
    with builder(instrument) as graph:
        sound = sc.PlayBuf.ar(
            channel_count=1,
            buffer_id=graph["buffer"],
            rate=sc.BufRateScale.ir(buffer_id=graph["buffer"]),
            start_position=(sc.BufSampleRate.ir(buffer_id=graph["buffer"]) * graph["start"]).round(1),
            done_action=FREE,
        )
        sc.OffsetOut.ar(bus=graph["out"], source=touched(sound * graph["gain"], graph, "speech"))
    return graph.build(name=name)
