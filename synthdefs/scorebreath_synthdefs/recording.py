"""The player of recorded breaths (B43-B46)."""

from __future__ import annotations

from supriya import SynthDef

from scorebreath_synthdefs.catalogue import Instrument
from scorebreath_synthdefs.envelope import Envelope
from scorebreath_synthdefs.graph import builder, sc
from scorebreath_synthdefs.touch import touched


def recording(name: str, instrument: Instrument) -> SynthDef:
    """An instrument that plays a buffer from `start` on under an envelope, and frees itself.

    It begins on a whole frame, so nothing is interpolated; a buffer that ends before the envelope begins again.
    """
    with builder(instrument) as graph:
        envelope = Envelope(graph)
        sound = sc.PlayBuf.ar(
            channel_count=1,
            buffer_id=graph["buffer"],
            rate=sc.BufRateScale.ir(buffer_id=graph["buffer"]),
            start_position=(sc.BufSampleRate.ir(buffer_id=graph["buffer"]) * graph["start"]).round(1),
            loop=1,
        )
        loudness = graph["level"] * instrument.calibration * envelope.evenness()
        sc.OffsetOut.ar(bus=graph["out"], source=touched(sound * envelope.amplitude() * loudness, graph, "mouth"))
    return graph.build(name=name)
