"""The sound of a breath: seeded noise through a vocal tract, under a trapezoid (B10, B46; physiology 3.3, 3.4)."""

from __future__ import annotations

from math import pi
from typing import Any

from supriya import Envelope, SynthDef

from scorebreath_synthdefs.catalogue import Instrument
from scorebreath_synthdefs.graph import FREE, builder, sc
from scorebreath_synthdefs.tracts import Dip, Tract

CALIBRATION_RATE = 48000.0
"""Hz: white noise of one amplitude is louder per hertz at lower rates, so levels are referred to one."""


def breath(name: str, instrument: Instrument, tract: Tract) -> SynthDef:
    """An instrument that breathes once through `tract` and frees itself.

    The output starts on the very sample asked for (`OffsetOut`), and one seed gives one sound on every engine.
    """
    with builder(instrument) as graph:
        sc.RandID.ir(rand_id=graph["rand_id"])
        sc.RandSeed.ir(trigger=1, seed=graph["seed"])
        sound = _through(tract, sc.WhiteNoise.ar(), graph["scale"])
        shape = sc.EnvGen.ar(
            envelope=Envelope(
                amplitudes=[0, 1, 1, 0],
                durations=[graph["attack"], graph["hold"], graph["release"]],
                curves=[0, 0, 0],
            ),
            done_action=FREE,
        )
        loudness = graph["level"] * instrument.calibration * _evenness(graph["scale"])
        sc.OffsetOut.ar(bus=graph["out"], source=sound * shape * loudness)
    return graph.build(name=name)


def _through(tract: Tract, noise: Any, scale: Any) -> Any:
    parts = noise * _amplitude(tract.floor_db)
    for index, (frequency, bandwidth, gain_db) in enumerate(tract.resonances):
        band = sc.BPF.ar(source=noise, frequency=scale * frequency, reciprocal_of_q=bandwidth / frequency)
        parts = parts + band * ((-1) ** index * _amplitude(gain_db))  # neighbours meet without a notch
    sound = sc.OnePole.ar(source=parts, coefficient=_decay(2 * tract.tilt))
    for dip in tract.dips:
        sound = _dip(dip, sound, scale)
    return sc.HPF.ar(source=sound, frequency=tract.highpass)


def _dip(dip: Dip, sound: Any, scale: Any) -> Any:
    """Zeros and wider poles at one angle, normalised to gain 1 at 0 Hz."""
    cosine = (sc.SampleDur.ir() * (2 * pi * dip.frequency) * scale).cos()
    zero = _decay(scale * dip.zero_bandwidth)
    pole = _decay(scale * dip.pole_bandwidth)
    zeros = 1 - 2 * zero * cosine + zero * zero
    poles = 1 - 2 * pole * cosine + pole * pole
    unity = poles / zeros
    return sc.SOS.ar(
        source=sound,
        a_0=unity,
        a_1=unity * -2 * zero * cosine,
        a_2=unity * zero * zero,
        b_1=2 * pole * cosine,
        b_2=pole * pole * -1,
    )


def _decay(bandwidth: Any) -> Any:
    """Radius of a pole of that bandwidth in hertz, at whatever rate the engine runs."""
    return (sc.SampleDur.ir() * -pi * bandwidth).exponential()


def _evenness(scale: Any) -> Any:
    """Keeps the level when the rate or the tract's length changes: noise power goes with bandwidth over rate."""
    return (sc.SampleDur.ir() * CALIBRATION_RATE * scale).sqrt().reciprocal()


def _amplitude(db: float) -> float:
    return float(10 ** (db / 20))
