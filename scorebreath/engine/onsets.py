"""What sounds when: a Score as a list of onsets, without any engine."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from scorebreath.engine.breaths import SYNTH, Breathing, Sounding, share, soundings, throat
from scorebreath.equations.breath import FLOW_EXPONENT
from scorebreath.errors import ScoreError, shortened
from scorebreath.score.cutting import Ending, endings
from scorebreath.score.document import Body, MediaInfo, Score
from scorebreath.score.events import Event, Expiration, Hold, Inspiration, Noise, Utterance
from scorebreath.units import amplitude
from scorebreath_synthdefs.catalogue import RECORDING, SPEECH, breath_name

GENERATORS = 64
"""Random generators of an engine; breaths that overlap must not share one."""
QUIETEST_DB, LOUDEST_DB = -300.0, 100.0


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
    media_duration: float = 0.0
    """s that those media last"""
    event: str
    """id of the event it belongs to"""
    body: str = ""
    """whose it is"""
    cut: Ending | None = None
    """where it ends before its own end; `duration` is as long as it is heard then"""

    @property
    def end(self) -> float:
        """Seconds from the Score's start."""
        return self.time + self.duration


def onsets(score: Score) -> tuple[Onset, ...]:
    """Everything in the Score that sounds, in order of time.

    What breathing events sound like is told by `engine.breaths`; breaths of no length make no sound. Of an event that
    is cut, what would begin then or later never does, and what sounds fades out.

    Raises:
        ScoreError: A level or a source that no instrument can play.
    """
    bodies = {body.id: body for body in score.bodies}
    ends = endings(score.events)
    found = sorted(
        (onset for event in score.events for onset in sounds_of(event, score.media, bodies[event.body])),
        key=lambda onset: onset.time,
    )
    return numbered(left for onset in found if (left := left_of(onset, ends.get(onset.event))) is not None)


def numbered(sounds: Iterable[Onset], before: int = 0) -> tuple[Onset, ...]:
    """Sounds whose noises have a random generator each.

    Args:
        sounds: In order of time.
        before: How many noises there were.
    """
    found: list[Onset] = []
    for onset in sounds:
        if "seed" in onset.controls:
            found.append(replace(onset, controls={**onset.controls, "rand_id": float(before % GENERATORS)}))
            before += 1
        else:
            found.append(onset)
    return tuple(found)


def left_of(sound: Onset, ending: Ending | None) -> Onset | None:
    """What a cut leaves of a sound: all, a beginning that fades out, or nothing."""
    if ending is None or ending.time >= sound.end:
        return sound
    if ending.time <= sound.time:
        return None
    until = min(sound.end, ending.time + ending.fade)
    return replace(sound, cut=ending, duration=until - sound.time)


def sounds_of(event: Event, media: Mapping[str, MediaInfo], body: Body) -> Iterator[Onset]:
    """What one event sounds like, uncut, in no order.

    Raises:
        ScoreError: A level or a source that no instrument can play.
    """
    if isinstance(event, Utterance):
        length = _seconds(media[event.media])
        yield Onset(
            time=event.onset,
            duration=length,
            instrument=SPEECH,
            controls={"gain": _amplitude(event, "gain_db", event.gain_db)},
            media=event.media,
            media_duration=length,
            event=event.id,
            body=event.body,
        )
    elif isinstance(event, Inspiration | Expiration | Hold) and event.noise is not None and event.noise.duration > 0:
        for sounding in soundings(event, event.noise):
            yield _breath(event, event.noise, sounding, media, body)


def _breath(event: Breathing, noise: Noise, sounding: Sounding, media: Mapping[str, MediaInfo], body: Body) -> Onset:
    level = _amplitude(event, "noise.level_db", body.voice.reference_db + noise.level_db)
    made = Onset(
        time=event.onset + sounding.onset,
        duration=sounding.length * (noise.attack + noise.hold + noise.release),
        instrument=RECORDING,
        controls={
            "level": level * sounding.gain,
            "attack": sounding.length * noise.attack,
            "hold": sounding.length * noise.hold,
            "release": sounding.length * noise.release,
            "exponent": FLOW_EXPONENT if noise.envelope == "flow" else 0.0,
        },
        event=event.id,
        body=event.body,
    )
    if sounding.kind is None:
        return _recorded(made, sounding, media)
    speaker, scale = throat(body.person)
    own = {"seed": float(sounding.seed), "scale": scale, "brightness": noise.brightness}
    return replace(made, instrument=breath_name(sounding.kind, speaker), controls={**made.controls, **own})


def _recorded(made: Onset, sounding: Sounding, media: Mapping[str, MediaInfo]) -> Onset:
    """A recording begins anywhere that leaves enough of it; where there is not enough, it begins again."""
    found = media.get(sounding.source)
    place = f"event {made.event!r}: noise.source={shortened(sounding.source)!r}"
    if found is None:
        raise ScoreError(f"{place} must be {SYNTH!r} or media that the score lists")
    if found.kind != "breath" or not found.frames:
        raise ScoreError(f"{place} must be the recording of a breath, not {found.frames} frames of {found.kind}")
    length = _seconds(found)
    start = max(0.0, length - made.duration) * share(sounding.seed)
    return replace(made, controls={**made.controls, "start": start}, media=sounding.source, media_duration=length)


def _seconds(media: MediaInfo) -> float:
    return media.frames / media.sample_rate


def _amplitude(event: Event, name: str, db: float) -> float:
    if not db <= LOUDEST_DB:
        raise ScoreError(f"event {event.id!r}: {name} gives {db:g} dB re full scale; at most {LOUDEST_DB:g}")
    return amplitude(db) if db >= QUIETEST_DB else 0.0
