"""The speech player."""

from __future__ import annotations

from supriya import SynthDef

from scorebreath_synthdefs.catalogue import Instrument
from scorebreath_synthdefs.graph import FREE, builder, sc


def speech(name: str, instrument: Instrument) -> SynthDef:
    """An instrument that plays one buffer once, sample for sample, and frees itself.

    `PlayBuf` holds the last sample until its block ends: the buffer must end with a zero.
    """
    with builder(instrument) as graph:
        sound = sc.PlayBuf.ar(
            channel_count=1,
            buffer_id=graph["buffer"],
            rate=sc.BufRateScale.ir(buffer_id=graph["buffer"]),
            done_action=FREE,
        )
        sc.OffsetOut.ar(bus=graph["out"], source=sound * graph["gain"])
    return graph.build(name=name)
