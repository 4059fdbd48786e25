"""Instruments played by themselves, many seeds in a row."""

from __future__ import annotations

import io
from functools import cache
from math import ceil

import numpy as np

from scorebreath.engine.offline import render_sounds
from scorebreath.engine.onsets import Onset
from scorebreath.media.store import MemoryStore
from scorebreath_synthdefs import CATALOGUE, RECORDING, RECORDING_DB, SPEECH
from tests.engine.listening import Signal
from tests.engine.sounding import samples

LEVEL = 0.05
FLOW = 1.66
RAMPS = ("attack", "hold", "release")
STORE = MemoryStore()


def recorded(seconds: float = 2.0, rate: int = 48000, seed: int = 5) -> str:
    """Name of a recorded breath in the store, as loud as recordings are kept."""
    made = np.random.default_rng(seed).standard_normal(int(seconds * rate))
    made *= 10 ** (RECORDING_DB / 20) / np.sqrt(np.mean(made**2))
    return STORE.put(made.astype(np.float32), rate, "breath")


def length_of(name: str, **controls: float) -> float:
    """Seconds of a breath with these controls, the others at their defaults."""
    row = CATALOGUE[name].controls
    return sum(controls.get(ramp, row[ramp].default) for ramp in RAMPS)


def onset(name: str, time: float, seed: int = 1, *, media_seconds: float = 2.0, **controls: float) -> Onset:
    """An onset of any instrument; players are given something to play."""
    given = {"level": LEVEL, "seed": float(seed), "rand_id": float(seed % 64)} | controls
    if name not in {SPEECH, RECORDING}:
        return Onset(time=time, duration=length_of(name, **controls), instrument=name, controls=given, event="e")
    media = recorded(media_seconds)
    length = len(STORE.get(media).samples) / 48000
    if name == SPEECH:
        return Onset(
            time=time, duration=length, instrument=name, controls={"gain": 0.5}, media=media, media_duration=length,
            event="e",
        )  # fmt: skip
    given = {key: value for key, value in given.items() if key in CATALOGUE[name].controls}
    given.setdefault("start", seed * 0.0137 % 1.0)
    return Onset(
        time=time, duration=length_of(name, **controls), instrument=name, controls=given, media=media,
        media_duration=length, event="e",
    )  # fmt: skip


def played(sounds: list[Onset], duration: float, rate: int = 48000, engine: str = "embedded") -> Signal:
    """What an engine makes of them."""
    stream = io.BytesIO()
    render_sounds(sounds, STORE, stream, duration=duration, sample_rate=rate, encoding="float32", engine=engine)
    return samples(stream.getvalue())[0]


@cache
def several(name: str, seeds: int = 16, rate: int = 48000, **controls: float) -> Signal:
    """The same breath from several seeds: (seeds, frames), from its onset to its end."""
    length = length_of(name, **controls)
    step = ceil((length + 0.1) * 1000) / 1000  # whole frames at all common rates
    sounds = [onset(name, step * index, 1000 + index, **controls) for index in range(seeds)]
    frames = round(step * rate)
    whole = played(sounds, step * seeds, rate)
    return whole.reshape(seeds, frames)[:, : int(length * rate)]
