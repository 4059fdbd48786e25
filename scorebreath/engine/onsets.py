"""What sounds when: a Score as a list of onsets, without any engine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from scorebreath.chance import ENGINE_SEEDS
from scorebreath.equations.breath import NOSE_BELOW_MOUTH_DB
from scorebreath.errors import ScoreError, shortened
from scorebreath.score.document import Body, Score
from scorebreath.score.events import Event, Expiration, Inspiration, Noise, Utterance
from scorebreath.units import amplitude
from scorebreath_synthdefs.catalogue import SPEECH, breath_name
from scorebreath_synthdefs.tracts import Route, Speaker

GENERATORS = 64
"""Random generators of an engine; breaths that overlap must not share one."""
QUIETEST_DB, LOUDEST_DB = -300.0, 100.0
_SPEAKER: Speaker = "male"
_SPEAKER_CAPACITY = 5.1  # L, of the man whose tract the table gives (physiology 2.1)
_HEIGHT_POWER = 2.73  # vital capacity grows with height to this power (GLI 2022, physiology 2.1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Onset:
    """One sound: which instrument starts when, and how it is set."""

    time: float
    """s from the Score's start"""
    duration: float
    """s until it is silent"""
    instrument: str
    """name in the catalogue of instruments"""
    controls: Mapping[str, float]
    media: str | None = None
    """SHA-256 of what it plays"""
    event: str
    """id of the event it belongs to"""

    @property
    def end(self) -> float:
        """Seconds from the Score's start."""
        return self.time + self.duration


def onsets(score: Score) -> tuple[Onset, ...]:
    """Everything in the Score that sounds, in order of time.

    An inspiration sounds through mouth and nose at once, each with its own gain (B10, B31, B32); at equal flow the
    nose is 6 dB below the mouth (physiology 3.2). Gains of 0 and breaths of no length make no sound.

    Raises:
        ScoreError: A level, a seed or a source that no instrument can play.
    """
    bodies = {body.id: body for body in score.bodies}
    found = sorted(
        (onset for event in score.events for onset in _of(event, score, bodies[event.body])),
        key=lambda onset: onset.time,
    )
    breaths = 0
    for index, onset in enumerate(found):
        if "seed" in onset.controls:
            found[index] = replace(onset, controls={**onset.controls, "rand_id": float(breaths % GENERATORS)})
            breaths += 1
    return tuple(found)


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


def _of(event: Event, score: Score, body: Body) -> Iterator[Onset]:
    if isinstance(event, Utterance):
        media = score.media[event.media]
        yield Onset(
            time=event.onset,
            duration=media.frames / media.sample_rate,
            instrument=SPEECH,
            controls={"gain": _amplitude(event, "gain_db", event.gain_db)},
            media=event.media,
            event=event.id,
        )
    elif isinstance(event, Inspiration) and event.noise is not None:
        yield from _breath(event, event.noise, body, route="mouth", gain=event.sound_mouth)
        below = -NOSE_BELOW_MOUTH_DB
        yield from _breath(event, event.noise, body, route="nose", gain=event.sound_nose, below_db=below)
    elif isinstance(event, Expiration) and event.noise is not None:
        yield from _breath(event, event.noise, body, route="exhale", gain=1.0)


def _breath(
    event: Event, noise: Noise, body: Body, *, route: Route, gain: float, below_db: float = 0.0
) -> Iterator[Onset]:
    length = noise.attack + noise.hold + noise.release
    if gain <= 0 or length <= 0:
        return
    if noise.source != "synth":
        raise ScoreError(
            f"event {event.id!r}: noise.source={shortened(noise.source)!r} must be 'synth' in this version"
        )
    level = _amplitude(event, "noise.level_db", body.voice.reference_db + noise.level_db + below_db)
    yield Onset(
        time=event.onset + noise.onset,
        duration=length,
        instrument=breath_name(route, _SPEAKER),
        controls={
            "level": gain * level,
            "attack": noise.attack,
            "hold": noise.hold,
            "release": noise.release,
            "seed": float(noise.seed if route != "nose" else _other_seed(noise.seed)),
            "scale": tract_scale(body.person.vital_capacity),
        },
        event=event.id,
    )


def _other_seed(seed: int) -> int:
    """A seed for the nose: its noise must not be the mouth's, or the two would add as amplitudes."""
    return seed * 48271 % (ENGINE_SEEDS - 3) + 1  # 2^24 - 3 is a prime


def _amplitude(event: Event, name: str, db: float) -> float:
    if not db <= LOUDEST_DB:
        raise ScoreError(f"event {event.id!r}: {name} gives {db:g} dB re full scale; at most {LOUDEST_DB:g}")
    return amplitude(db) if db >= QUIETEST_DB else 0.0
