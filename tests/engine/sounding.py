"""Scores made by hand that sound, and the WAV bytes they give."""

from __future__ import annotations

import io
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scorebreath.engine.offline import render
from scorebreath.media.store import MediaStore, MemoryStore
from scorebreath.score.document import Body, MediaInfo, Person, Score, VoiceInfo
from scorebreath.score.events import (
    Cut,
    Event,
    Expiration,
    Inspiration,
    Lead,
    Level,
    Motion,
    Noise,
    Parameter,
    Pitch,
    Trapezoid,
    Utterance,
)
from scorebreath.score.performing import Heard
from scorebreath.units import snap

REFERENCE_DB = -20.0
STILL = Motion(thorax=0.0, abdomen=0.0, shoulder=0.0, neck_pitch=0.0)


def body(vital_capacity: float = 5.1) -> Body:
    return Body(
        id="body",
        voice=VoiceInfo(
            engine="tone", voice="tone", version="1", licence="CC0-1.0", sample_rate=22050, reference_db=REFERENCE_DB
        ),
        person=Person(vital_capacity=vital_capacity, resting_volume=0.35),
    )


def noise(attack: float = 0.15, hold: float = 0.27, release: float = 0.18, **other: object) -> Noise:
    settings = {"onset": 0.0, "level_db": -24.0, "seed": 12345} | other
    return Noise(
        attack=attack,
        hold=hold,
        release=release,
        duration=snap(attack + hold + release),
        **settings,  # type: ignore[arg-type]
    )


def inspiration(
    onset: float, sound: Noise | None, *, mouth: float = 1.0, nose: float = 0.0, name: str = "in"
) -> Inspiration:
    return Inspiration(
        id=f"{name}{onset}", body="body", onset=snap(onset), duration=0.6, from_volume=0.35, to_volume=0.6,
        thorax_share=0.65, motion=STILL, sound_nose=nose, sound_mouth=mouth, nostril_flare=0.0, mouth_open=0.0,
        face=Trapezoid(attack=0.1, hold=0.4, release=0.1), lead=Lead(), noise=sound,
    )  # fmt: skip


def expiration(onset: float, sound: Noise | None) -> Expiration:
    return Expiration(
        id=f"out{onset}", body="body", onset=onset, duration=1.0, kind="audible", from_volume=0.6, to_volume=0.35,
        thorax_share=0.65, motion=STILL, noise=sound,
    )  # fmt: skip


def utterance(onset: float, media: str, seconds: float, *, gain_db: float = 0.0, name: str = "say") -> Utterance:
    return Utterance(
        id=f"{name}{onset}", body="body", onset=snap(onset), duration=snap(seconds), media=media, gain_db=gain_db,
        closing="final", words=(), phones=(), pitch=Pitch(step=0.005, hertz=()), level=Level(step=0.005, db=()),
    )  # fmt: skip


def cut(onset: float, *targets: str, fade: float = 0.05) -> Cut:
    return Cut(id=f"cut{onset}", body="body", onset=snap(onset), duration=snap(fade), targets=targets, fade=snap(fade))


def move(onset: float, glide: float, **heard: float) -> Parameter:
    return Parameter(
        id=f"move{onset}", body="body", onset=snap(onset), duration=snap(glide), name="x", value=1.0, glide=snap(glide),
        heard=Heard(**heard),
    )  # fmt: skip


def score(
    events: Sequence[Event], duration: float, media: MediaStore | None = None, person: Body | None = None
) -> Score:
    names = {event.media for event in events if isinstance(event, Utterance)}
    listed = {}
    for name in names:
        assert media is not None
        sound = media.get(name)
        listed[name] = MediaInfo(
            path=f"speech/{name}.wav", frames=len(sound.samples), sample_rate=sound.sample_rate, kind="speech"
        )
    return Score(
        made_by="tests", seed=1, language="en", model="natural", text="", duration=snap(duration),
        bodies=(person or body(),), media=listed, events=tuple(events),
    )  # fmt: skip


def babble(seconds: float, rate: int, seed: int) -> NDArray[np.float32]:
    """Band-limited noise with a sharp start, as unlike itself at any other lag as speech can be."""
    rng = np.random.default_rng(seed)
    spectrum = np.fft.rfft(rng.standard_normal(int(seconds * rate)))
    spectrum[int(len(spectrum) * 0.7) :] = 0
    made = np.fft.irfft(spectrum, int(seconds * rate))
    return np.asarray(0.2 * made / np.abs(made).max(), dtype=np.float32)


def wave(made: Score, media: MediaStore | None = None, **settings: object) -> bytes:
    stream = io.BytesIO()
    render(made, media if media is not None else MemoryStore(), stream, **settings)  # type: ignore[arg-type]
    return stream.getvalue()


def samples(data: bytes) -> tuple[NDArray[np.float64], int]:
    """Samples of a mono WAV file, read by libsndfile."""
    import soundfile

    read, rate = soundfile.read(io.BytesIO(data), dtype="float64")
    return read, int(rate)
