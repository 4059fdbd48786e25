"""The sound of a breath: seeded noise through a vocal tract, under an envelope (B10, B46; physiology 3.3, 3.4)."""

from __future__ import annotations

from math import pi
from typing import Any

from supriya import SynthDef

from scorebreath_synthdefs.catalogue import Instrument, Route
from scorebreath_synthdefs.envelope import Envelope
from scorebreath_synthdefs.graph import builder, sc
from scorebreath_synthdefs.loudness import CALIBRATION_RATE, law
from scorebreath_synthdefs.touch import ratio, touched
from scorebreath_synthdefs.tracts import Dip, Tract

_HIGHEST = 0.45
"""Share of the sample rate above which no resonance goes: it would not be stable."""
_DARKEST, _BRIGHTEST = 0.25, 4.0
"""However far a breath's own brightness and a performer's hand go together."""


def breath(name: str, instrument: Instrument, tract: Tract, route: Route) -> SynthDef:
    """An instrument that breathes once through `tract` and frees itself.

    The output starts on the very sample asked for (`OffsetOut`), and one seed gives one sound on every engine. Its
    level is the same however bright it is moved.
    """
    with builder(instrument) as graph:
        sc.RandID.ir(rand_id=graph["rand_id"])
        sc.RandSeed.ir(trigger=1, seed=graph["seed"])
        envelope = Envelope(graph)
        glide = envelope.glide(tract.glide)
        brightness = (graph["brightness"] * ratio(graph, "brightness")).clip(_DARKEST, _BRIGHTEST)
        sound = _through(tract, sc.WhiteNoise.ar(), graph["scale"], brightness, glide)
        loudness = graph["level"] * instrument.calibration * _evenness(graph["scale"]) * envelope.evenness()
        moved = _moved(tract, graph["scale"], brightness, glide)
        sounding = sound * envelope.amplitude() * (loudness * moved)
        sc.OffsetOut.ar(bus=graph["out"], source=touched(sounding, graph, route))
    return graph.build(name=name)


def _through(tract: Tract, noise: Any, scale: Any, brightness: Any, glide: Any) -> Any:
    parts = noise * _amplitude(tract.floor_db)
    size = scale * brightness
    highest = sc.SampleRate.ir() * _HIGHEST
    for index, (frequency, bandwidth, gain_db) in enumerate(tract.resonances):
        moved = size * frequency * glide if index < tract.gliding else size * frequency
        band = sc.BPF.ar(source=noise, frequency=moved.min(highest), reciprocal_of_q=bandwidth / frequency)
        parts = parts + band * ((-1) ** index * _amplitude(gain_db))  # neighbours meet without a notch
    sound = sc.OnePole.ar(source=parts, coefficient=_decay(brightness * (2 * tract.tilt) * glide))
    for dip in tract.dips:
        sound = _dip(dip, sound, size)
    return sc.HPF.ar(source=sound, frequency=tract.highpass)


def _dip(dip: Dip, sound: Any, size: Any) -> Any:
    """Zeros and wider poles at one angle, normalised to gain 1 at 0 Hz."""
    cosine = (sc.SampleDur.ir() * (2 * pi * dip.frequency) * size).cos()
    zero = _decay(size * dip.zero_bandwidth)
    pole = _decay(size * dip.pole_bandwidth)
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


def _moved(tract: Tract, scale: Any, brightness: Any, glide: Any) -> Any:
    """Takes back what else scale, brightness and glide do to the level; 1 where nothing is moved."""
    by = law(tract)
    x, y = scale.log(), brightness.log()
    exponent = x * (x * by.scale2 + y * by.both + by.scale) + y * (y * by.bright2 + by.bright)
    return (exponent * -1 - glide.log() * by.glide).exponential()


def _amplitude(db: float) -> float:
    return float(10 ** (db / 20))
