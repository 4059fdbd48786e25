"""What live sounds go through: each body at its place between the speakers, and a limiter for all."""

from __future__ import annotations

from supriya import SynthDef

from scorebreath_synthdefs.catalogue import CEILING, LOOK_AHEAD, Instrument
from scorebreath_synthdefs.graph import builder, sc


def place(name: str, instrument: Instrument) -> SynthDef:
    """One body's bus into both sides; in the middle as loud in each as it is."""
    with builder(instrument) as graph:
        sound = sc.In.ar(bus=graph["bus"], channel_count=1)
        pan = graph["pan"].clip(-1, 1)
        left, right = (1 - pan).min(1), (1 + pan).min(1)
        sc.Out.ar(bus=graph["out"], source=[sound * left, sound * right])
    return graph.build(name=name)


def master(name: str, instrument: Instrument, channels: int, limited: bool) -> SynthDef:
    """Both sides, never above the ceiling if `limited`, into as many outputs as there are."""
    with builder(instrument) as graph:
        left, right = (sc.In.ar(bus=graph["bus"] + side, channel_count=1) for side in (0, 1))
        sides = [left, right] if channels == 2 else [(left + right) * 0.5]
        gain = sc.Lag.kr(source=graph["gain"], lag_time=0.02)
        sides = [side * gain for side in sides]
        if limited:
            sides = [sc.Limiter.ar(source=side, level=CEILING, duration=LOOK_AHEAD / 2) for side in sides]
        sc.Out.ar(bus=graph["out"], source=sides)
    return graph.build(name=name)
