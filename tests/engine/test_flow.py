"""Rendered breaths follow the air: louder and brighter with the flow, in gasps, in puffs, from recordings."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from math import log2

import numpy as np
import pytest

from scorebreath.curves.levels import breath_level
from scorebreath.equations.breath import brightness, flow_level
from scorebreath.equations.shapes import flow_envelope
from scorebreath.media.store import MemoryStore
from scorebreath.score.document import MediaInfo, Score
from scorebreath.score.events import Expiration, Hold, Inspiration
from scorebreath.units import snap
from tests.engine.listening import Signal, level_db
from tests.engine.sounding import REFERENCE_DB, STILL, expiration, inspiration, noise, samples, score, wave

FLOWS = (0.5, 0.6, 0.7, 0.85, 1.0, 1.25, 1.5, 1.75, 2.0)
RATE = 48000
ATTACK, RELEASE = 0.24, 0.36  # a flow that is highest at 0.40 of 0.6 s (physiology 3.3)
STEP = 0.7


def breaths(flow: float, *, mouth: float = 0.65, nose: float = 0.35, seeds: int = 16) -> Signal:
    """Rendered inspirations at a flow: (seeds, frames), each from its onset to its end."""
    events = [
        inspiration(
            snap(STEP * index),
            noise(
                ATTACK, 0.0, RELEASE, envelope="flow", seed=7000 + 31 * index,
                level_db=snap(-24.0 + flow_level(flow, 1.0, 1.66)), brightness=snap(brightness(flow, 1.0)),
            ),
            mouth=mouth, nose=nose,
        )
        for index in range(seeds)
    ]  # fmt: skip
    return cut(wave(score(events, STEP * seeds)), seeds)


def cut(data: bytes, seeds: int, step: float = STEP) -> Signal:
    signal, rate = samples(data)
    assert rate == RATE
    return signal.reshape(seeds, round(step * rate))[:, : round((ATTACK + RELEASE) * RATE)]


def loud(sound: Signal) -> float:
    """Level of the loud part, dB."""
    gain = flow_envelope(np.arange(sound.shape[1]) / RATE, ATTACK, 0.0, RELEASE, 1.66)
    return level_db(sound[:, gain >= 0.5])


def centroid(sound: Signal) -> float:
    """Hz, within 0.1..12 kHz, of the mean power."""
    power = np.mean(np.abs(np.fft.rfft(sound * np.hanning(sound.shape[1]))) ** 2, axis=0)
    frequency = np.fft.rfftfreq(sound.shape[1], 1 / RATE)
    heard = (frequency >= 100) & (frequency <= 12000)
    return float((frequency * power)[heard].sum() / power[heard].sum())


def test_level_follows_the_flow_to_the_power_of_1_66() -> None:
    """Within 1.5 dB over half to twice the flow: in fact within half a dB of 10 dB an octave of flow."""
    found = {flow: loud(breaths(flow)) for flow in FLOWS}
    for flow, level in found.items():
        expected = 20 * 1.66 * np.log10(flow)
        assert level - found[1.0] == pytest.approx(expected, abs=0.75)
    octaves = [log2(flow) for flow in FLOWS]
    assert np.polyfit(octaves, list(found.values()), 1)[0] == pytest.approx(10.0, abs=0.3)


@pytest.mark.parametrize(("mouth", "nose"), [(1.0, 0.0), (0.65, 0.35), (0.0, 1.0)])
def test_the_centroid_rises_with_the_flow(mouth: float, nose: float) -> None:
    found = [centroid(breaths(flow, mouth=mouth, nose=nose)) for flow in (0.5, 0.7, 1.0, 1.5, 2.0)]
    assert found == sorted(found)
    assert found[-1] > 1.15 * found[0]


def test_the_centroid_rises_with_the_share_of_the_nose() -> None:
    found = [centroid(breaths(1.0, mouth=1 - share, nose=share)) for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
    assert found == sorted(found)
    assert found[-1] > found[0] + 500


def test_the_same_flow_through_the_nose_is_softer() -> None:
    assert loud(breaths(1.0, mouth=0, nose=1)) - loud(breaths(1.0, mouth=1, nose=0)) == pytest.approx(-6.0, abs=0.5)


def bursts(data: bytes, quiet_db: float = -70.0) -> list[float]:
    """Onsets of what sounds after at least 20 ms of silence, s."""
    signal, rate = samples(data)
    sounding = np.flatnonzero(np.abs(signal) > 10 ** (quiet_db / 20))
    return [float(sounding[0]) / rate, *(sounding[1:][np.diff(sounding) > 0.02 * rate] / rate)]


def test_laughter_puffs_at_4_6_a_second() -> None:
    """Filippelli 2001: 4.6 +- 1.1 Hz; every puff begins within a few ms of where the Score says."""
    puffs = tuple(snap(number / 4.6) for number in range(6))
    sound = noise(0.015, 0.025, 0.085, envelope="flow", level_db=0.0)
    laugh = dataclasses.replace(expiration(0.3, sound), kind="laugh", duration=1.4, puffs=puffs)
    found = bursts(wave(score([laugh], 2.0)))
    assert found == pytest.approx([0.3 + puff for puff in puffs], abs=0.003)
    assert (len(found) - 1) / (found[-1] - found[0]) == pytest.approx(4.6, abs=0.05)


def test_saccades_are_heard_one_by_one() -> None:
    sniffs = dataclasses.replace(
        inspiration(0.2, noise(0.3, 0.1, 0.2, onset=0.0, level_db=0.0), mouth=0, nose=1),
        kind="sniff", duration=0.9, saccades=3,
    )  # fmt: skip
    assert bursts(wave(score([sniffs], 1.5))) == pytest.approx([0.2, 0.5, 0.8], abs=0.004)


def test_the_catch_of_the_throat_is_a_short_click() -> None:
    sound = noise(0.002, 0.003, 0.025, level_db=-44.0)
    held = Hold(
        id="hold", body="body", onset=0.5, duration=0.5, kind="held", volume=0.5, thorax_share=0.65, motion=STILL,
        noise=sound,
    )  # fmt: skip
    signal, rate = samples(wave(score([held], 1.2)))
    heard = np.flatnonzero(signal)
    assert 0.5 <= heard[0] / rate < 0.502
    assert heard[-1] / rate <= 0.5301


def recorded(events: Sequence[Inspiration | Expiration], seconds: float) -> tuple[Score, MemoryStore]:
    """A Score whose noises all play one recording, -20 dB RMS, at 44.1 kHz."""
    made = np.random.default_rng(8).standard_normal(5 * 44100)
    store = MemoryStore()
    name = store.put((0.1 * made / made.std()).astype(np.float32), 44100, "breath")
    played = []
    for event in events:
        assert event.noise is not None
        played.append(dataclasses.replace(event, noise=dataclasses.replace(event.noise, source=name)))
    info = MediaInfo(path=f"breath/{name}.wav", frames=5 * 44100, sample_rate=44100, kind="breath")
    return dataclasses.replace(score([], seconds), media={name: info}, events=tuple(played)), store


def test_recordings_have_the_level_the_score_says() -> None:
    sounds = [noise(ATTACK, 0.0, RELEASE, envelope="flow", seed=100 + index) for index in range(12)]
    events = [inspiration(snap(STEP * index), sound) for index, sound in enumerate(sounds)]
    made, store = recorded(events, STEP * 12)
    found = cut(wave(made, store), 12)
    assert loud(found) == pytest.approx(REFERENCE_DB - 24, abs=0.5)
    alike = np.asarray(np.corrcoef(found))[np.triu_indices(12, 1)]
    assert np.abs(alike).max() < 0.3  # every seed begins elsewhere


def test_one_recording_serves_more_puffs_than_an_engine_has_buffers() -> None:
    """Read anew for each puff, freed after each: as many as you like."""
    puffs = tuple(snap(0.2 * number) for number in range(1100))
    laugh = dataclasses.replace(expiration(0.0, noise(0.02, 0.05, 0.05)), kind="laugh", duration=221.0, puffs=puffs)
    made, store = recorded([laugh], 221.0)
    signal, rate = samples(wave(made, store, sample_rate=44100))
    levels = [level_db(signal[int((puff + 0.02) * rate) :][: rate // 20]) for puff in puffs]
    assert np.mean(levels) == pytest.approx(REFERENCE_DB - 24, abs=0.5)
    assert min(levels) > REFERENCE_DB - 24 - 4


def test_the_curve_of_the_breaths_level_is_the_level_of_the_sound() -> None:
    """Sound and curve come from the same events by the same equations: the mean power of many seeds."""
    seeds, step = 24, 2.5
    loudness: list[Signal] = []
    for index in range(seeds):
        follows = {"envelope": "flow", "seed": 900 + 37 * index}
        events = [
            inspiration(0.2, noise(ATTACK, 0.0, RELEASE, level_db=-24.0, **follows), mouth=0.65, nose=0.35),
            dataclasses.replace(
                inspiration(1.0, noise(0.1, 0.1, 0.3, level_db=-20.0, seed=900 + index), nose=1.0, mouth=0.0),
                kind="sniff", saccades=2,
            ),
            dataclasses.replace(
                expiration(1.7, noise(0.03, 0.03, 0.06, level_db=-16.0, **follows)),
                kind="laugh", duration=0.6, puffs=(0.0, 0.25),
            ),
        ]  # fmt: skip
        made = score(events, step)
        loudness.append(samples(wave(made, sample_rate=16000))[0] ** 2)
    block = 80  # 5 ms
    found = 10 * np.log10(np.mean(loudness, axis=0).reshape(-1, block).mean(axis=1) + 1e-14) - REFERENCE_DB
    middles = (np.arange(len(found)) + 0.5) * block / 16000
    said = breath_level(made, "body").sample(middles)
    clear = (said > -45) & (np.roll(said, 1) > -45) & (np.roll(said, -1) > -45)
    assert clear.sum() > 200
    assert abs(np.mean(found[clear] - said[clear])) < 0.5
    assert np.abs(found[clear] - said[clear]).max() < 4.0  # 24 seeds of 5 ms
