"""Which breath noises an event makes: what sounds through mouth and nose, how often, how long, from which seed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from scorebreath.chance import ENGINE_SEEDS
from scorebreath.equations.breath import NOSE_BELOW_MOUTH_DB, mix_level
from scorebreath.score.document import Person
from scorebreath.score.events import Expiration, Hold, Inspiration, Noise
from scorebreath.units import amplitude
from scorebreath_synthdefs.tracts import LENGTHS, Kind, Speaker, nearest

Breathing = Inspiration | Expiration | Hold
SYNTH = "synth"
"""`Noise.source` of what is not recorded."""
_SPEAKER: Speaker = "male"
_SPEAKER_CAPACITY = 5.1  # L, of the man whose tract the table gives (physiology 2.1)
_PRIME = ENGINE_SEEDS - 3
_HEIGHT_POWER = 2.73  # vital capacity grows with height to this power (GLI 2022, physiology 2.1)


class Routes(NamedTuple):
    """Kinds of instrument that an event sounds on."""

    mouth: Kind | None
    nose: Kind | None


_INSPIRED, _EXPIRED = Routes("mouth", "nose"), Routes("exhale", "nose")
SILENT = Routes(None, None)
ROUTES: Mapping[tuple[str, str], Routes] = {
    (Inspiration.type, "speech"): _INSPIRED,
    (Inspiration.type, "tidal"): _INSPIRED,
    (Inspiration.type, "sigh"): _INSPIRED,
    (Inspiration.type, "gasp"): Routes("gasp", "nose"),
    (Inspiration.type, "sniff"): Routes("mouth", "sniff"),
    (Expiration.type, "speech"): _EXPIRED,
    (Expiration.type, "tidal"): _EXPIRED,
    (Expiration.type, "audible"): _EXPIRED,
    (Expiration.type, "sigh"): Routes("sigh", "nose"),
    (Expiration.type, "laugh"): Routes("laugh", "nose"),
    (Hold.type, "held"): Routes("hold", None),
    (Hold.type, "rest"): SILENT,
}
"""By type and kind of event."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sounding:
    """A noise that is heard once through one way."""

    onset: float
    """s from the event's onset"""
    length: float
    """of the noise, relative to what the event says"""
    kind: Kind | None
    """of instrument; None: a recording"""
    gain: float
    """amplitude, above 0"""
    seed: int
    """1..2^24-1"""
    source: str = SYNTH
    """SHA-256 of the recording, if it is one"""


class Throat(NamedTuple):
    """Whose vocal tract sounds."""

    speaker: Speaker
    scale: float
    """length of the speaker's tract over this one's"""


def throat(person: Person) -> Throat:
    """The nearest speaker of the table, made as long as the person's vocal tract; without one, a man of such lungs."""
    if person.vocal_tract is None:
        return Throat(_SPEAKER, tract_scale(person.vital_capacity))
    speaker = nearest(person.vocal_tract)
    return Throat(speaker, LENGTHS[speaker] / person.vocal_tract)


def tract_scale(vital_capacity: float) -> float:
    r"""How much shorter a body's vocal tract is than the table's, from its lungs: both follow its height.

    :math:`(5.1 / VC)^{1/2.73}`, within 0.8..1.5; a woman of 3.7 L has 1.12 (17.0 cm / 14.5 cm is 1.17), a child of ten
    years 1.37 (physiology 2.1, 3.4).

    Args:
        vital_capacity: L, above 0.

    >>> tract_scale(5.1), round(tract_scale(3.68), 2), round(tract_scale(2.18), 2)
    (1.0, 1.13, 1.37)
    """
    return float(min(1.5, max(0.8, (_SPEAKER_CAPACITY / max(vital_capacity, 0.01)) ** (1 / _HEIGHT_POWER))))


def soundings(event: Breathing, noise: Noise) -> Iterator[Sounding]:
    """Every time an event's noise is heard: through mouth and nose at once, in each gasp and each puff.

    Mouth and nose have gains of their own (B10, B31, B32); at equal flow the nose is 6 dB below the mouth (physiology
    3.2). One recording of both sounds once, as loud as both together. Gains of 0 make no sound.
    """
    ways = tuple(_ways(event, noise))
    seed = noise.seed
    for onset, length in _repeats(event):
        seeds = seed, other_seed(seed)
        for way in ways:
            yield Sounding(
                onset=onset + noise.onset * length,
                length=length,
                kind=way.kind if way.source == SYNTH else None,
                gain=way.gain,
                seed=seeds[way.nasal],
                source=way.source,
            )
        seed = other_seed(seeds[1])


class _Way(NamedTuple):
    kind: Kind | None
    gain: float
    nasal: bool
    source: str


def _ways(event: Breathing, noise: Noise) -> Iterator[_Way]:
    """The ways an event's noise takes, as far as anything is heard there."""
    mouth, nose = (1.0, 0.0) if isinstance(event, Hold) else (event.sound_mouth, event.sound_nose)
    routes = ROUTES[event.type, event.kind]
    through_nose = noise.source_nose or noise.source
    if noise.source == through_nose != SYNTH:
        if routes != SILENT and mouth + nose > 0:
            yield _Way(None, amplitude(mix_level(mouth, nose)), False, noise.source)
        return
    if routes.mouth is not None and mouth > 0:
        yield _Way(routes.mouth, mouth, False, noise.source)
    if routes.nose is not None and nose > 0:
        yield _Way(routes.nose, nose * amplitude(-NOSE_BELOW_MOUTH_DB), True, through_nose)


def _repeats(event: Breathing) -> Iterator[tuple[float, float]]:
    """Where in the event each sounding begins, and how long it is relative to what the noise says."""
    if isinstance(event, Inspiration) and event.saccades > 1:
        for number in range(event.saccades):
            yield event.duration * number / event.saccades, 1.0 / event.saccades
    elif isinstance(event, Expiration) and event.puffs:
        for puff in event.puffs:
            yield puff, 1.0
    else:
        yield 0.0, 1.0


def other_seed(seed: int) -> int:
    """Another seed, for what sounds beside or after: equal noises would add as amplitudes.

    >>> other_seed(7)
    337898
    """
    return seed * 48271 % _PRIME + 1


def share(seed: int) -> float:
    """A number in 0..1 that goes with a seed.

    >>> round(share(7), 3)
    0.069
    """
    return other_seed(other_seed(other_seed(seed))) / ENGINE_SEEDS
