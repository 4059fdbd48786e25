"""What the rendered file holds: the right sounds at the right times at the right levels, the same every time."""

from __future__ import annotations

import io
import itertools
import shutil
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import resample_poly

from scorebreath.engine.offline import render
from scorebreath.equations.breath import mix_level
from scorebreath.media.store import MemoryStore
from scorebreath.score.document import Score
from scorebreath.score.events import Event
from scorebreath.units import frame_count, snap
from tests.engine.listening import Shape, Signal, breath_onset, lag, level_db, whitened, within
from tests.engine.sounding import REFERENCE_DB, babble, expiration, inspiration, noise, samples, score, utterance, wave

BREATHS = 60
MOUTH, NOSE = 0.65, 0.35
needs_scsynth = pytest.mark.skipif(shutil.which("scsynth") is None, reason="no scsynth on PATH")


@dataclass(frozen=True)
class Performance:
    score: Score
    media: MemoryStore
    breaths: tuple[Shape, ...]
    speech: tuple[tuple[float, NDArray[np.float32]], ...]
    data: bytes
    signal: Signal
    rate: int


@pytest.fixture(scope="module")
def performance() -> Performance:
    """Sixty breaths of all shapes and levels; after every fifth, speech at 22.05 kHz."""
    rng = np.random.default_rng(20)
    media, time = MemoryStore(), 0.1
    events: list[Event] = []
    breaths, speech = [], []
    for index in range(BREATHS):
        onset = snap(time + float(rng.uniform(0, 0.1)))
        attack, hold, release = (snap(float(rng.uniform(*span))) for span in ((0.06, 0.3), (0.1, 0.4), (0.06, 0.3)))
        level = snap(float(rng.uniform(-30, -14)))
        sound = noise(attack, hold, release, seed=int(rng.integers(1, 2**24)), level_db=level)
        events.append(inspiration(onset, sound, mouth=MOUTH, nose=NOSE))
        breaths.append(Shape(onset=onset, attack=attack, hold=hold, release=release))
        time = onset + attack + hold + release + 0.1
        if index % 5 == 0:
            said = babble(float(rng.uniform(0.2, 0.9)), 22050, index)
            speech.append((snap(time), said))
            events.append(utterance(time, media.put(said, 22050, "speech"), len(said) / 22050))
            time += len(said) / 22050 + 0.1
    made = score(events, time + 0.123456, media)
    data = wave(made, media)
    signal, rate = samples(data)
    return Performance(made, media, tuple(breaths), tuple(speech), data, signal, rate)


def errors(heard: Performance, shift: float = 0.0) -> NDArray[np.float64]:
    """Seconds by which breaths start later than a Score shifted by so much says."""
    expected = [Shape(onset=s.onset + shift, attack=s.attack, hold=s.hold, release=s.release) for s in heard.breaths]
    return np.array([breath_onset(heard.signal, heard.rate, shape) - shape.onset for shape in expected])


def acceptable(late: NDArray[np.float64]) -> bool:
    return bool(np.all(np.abs(late) < 1e-3) and abs(late.mean()) < 2e-4)


def test_breaths_start_when_the_score_says(performance: Performance) -> None:
    late = errors(performance)
    assert len(late) == BREATHS
    assert acceptable(late), f"mean {late.mean() * 1e3:.3f} ms, worst {np.abs(late).max() * 1e3:.3f} ms"


@pytest.mark.parametrize("shift", [-0.002, 0.002])
def test_the_same_check_refuses_a_score_that_is_2_ms_off(performance: Performance, shift: float) -> None:
    late = errors(performance, shift)
    assert not acceptable(late)
    assert np.all(np.abs(late) > 1e-3)


def test_breaths_rise_hold_and_fall_as_the_score_says(performance: Performance) -> None:
    """Power in tenths of attack, hold and release, whitened and averaged over all breaths, is the trapezoid's."""
    found = np.zeros((BREATHS, 30))
    for row, shape in zip(found, performance.breaths, strict=True):
        start, rate = shape.onset, performance.rate
        edges = np.cumsum([start, *[shape.attack / 10] * 10, *[shape.hold / 10] * 10, *[shape.release / 10] * 10])
        hold = within(performance.signal, rate, start + shape.attack, shape.hold)
        sound = whitened(within(performance.signal, rate, start, edges[-1] - start), hold)
        places = ((edges - start) * rate).astype(int)
        row[:] = [np.mean(sound[a:b] ** 2) for a, b in itertools.pairwise(places)]
    found /= found[:, 10:20].mean(axis=1, keepdims=True)
    tenths = np.arange(10)
    rise = ((tenths + 1) ** 3 - tenths**3) / 300  # mean of t^2 over each tenth
    np.testing.assert_allclose(found.mean(axis=0), [*rise, *[1.0] * 10, *rise[::-1]], rtol=0.1, atol=0.01)


def test_speech_starts_on_the_sample(performance: Performance) -> None:
    assert len(performance.speech) == BREATHS // 5
    for onset, said in performance.speech:
        template = resample_poly(said.astype(np.float64), 320, 147)  # not the resampler under test
        assert abs(lag(performance.signal, template, round(onset * performance.rate))) <= 1


def test_speech_is_played_whole_and_unchanged(performance: Performance) -> None:
    for onset, said in performance.speech:
        first = frame_count(onset, performance.rate)
        template = resample_poly(said.astype(np.float64), 320, 147)
        inner = slice(200, len(template) - 200)  # resamplers differ at hard edges
        played = performance.signal[first : first + len(template)]
        assert level_db(played[inner] - template[inner]) < level_db(template) - 50
        assert np.abs(performance.signal[first + len(template) + 1 :][:2000]).max() == 0.0  # no sample is held


@pytest.mark.parametrize("duration", [0.0, 0.000001, 0.5, 0.777777, 1.0, 1.000011])
@pytest.mark.parametrize("rate", [16000, 44100, 48000])
def test_the_file_has_exactly_the_frames_of_the_score(duration: float, rate: int) -> None:
    """Also where it ends in the middle of a breath."""
    signal, found = samples(wave(score([inspiration(0.2, noise(), nose=0.5)], duration), sample_rate=rate))
    assert (len(signal), found) == (frame_count(duration, rate), rate)


def test_a_score_without_sounds_is_silence() -> None:
    signal, _ = samples(wave(score([], 0.25)))
    assert len(signal) == 12000
    assert not signal.any()


def test_sounds_beyond_the_end_are_left_out() -> None:
    made = [inspiration(0.1, noise()), inspiration(1.0, noise(seed=5)), inspiration(7.0, noise(seed=6))]
    assert wave(score(made, 1.0)) == wave(score(made[:1], 1.0))


def test_two_runs_give_the_same_bytes(performance: Performance) -> None:
    assert wave(performance.score, performance.media) == performance.data


def test_another_seed_is_another_noise() -> None:
    one, other = (samples(wave(score([inspiration(0.0, noise(seed=seed))], 0.6)))[0] for seed in (7, 8))
    assert abs(np.corrcoef(one, other)[0, 1]) < 0.1


def test_a_breath_sounds_the_same_wherever_it_stands() -> None:
    """Nothing that plays before or beside it touches its noise."""
    alone, _ = samples(wave(score([inspiration(0.0, noise(seed=7))], 0.6)))
    crowd = [inspiration(snap(0.05 * index), noise(seed=100 + index), name="other") for index in range(20)]
    full, _ = samples(wave(score([*crowd, inspiration(0.5, noise(seed=7))], 2.0)))
    others, _ = samples(wave(score(crowd, 2.0)))
    np.testing.assert_allclose((full - others)[24000 : 24000 + len(alone)], alone, atol=3e-7)  # three roundings


@needs_scsynth
@pytest.mark.scsynth
def test_engines_agree(performance: Performance) -> None:
    other, _ = samples(wave(performance.score, performance.media, engine="scsynth"))
    assert level_db(performance.signal - other + 1e-12) < level_db(performance.signal) - 40


def test_a_breath_at_the_defaults_is_24_db_below_speech() -> None:
    """The level over the hold, mouth and nose together (physiology 3.2); `level_db` is that of a unit gain."""
    level = snap(-24.0 - mix_level(MOUTH, NOSE))
    found = []
    for seed in range(1, 13):
        breath = inspiration(0.0, noise(seed=seed * 999, level_db=level), mouth=MOUTH, nose=NOSE)
        signal, rate = samples(wave(score([breath], 0.6)))
        found.append(level_db(within(signal, rate, 0.15, 0.27)) - REFERENCE_DB)
    assert np.all(np.abs(np.array(found) + 24) < 3.0)
    assert np.mean(found) == pytest.approx(-24.0, abs=0.5)


def test_an_expiration_has_the_level_the_score_says() -> None:
    signal, rate = samples(wave(score([expiration(0.0, noise(0.1, 2.0, 0.1, level_db=-32.0))], 2.3)))
    assert level_db(within(signal, rate, 0.1, 2.0)) == pytest.approx(REFERENCE_DB - 32.0, abs=0.5)


def test_the_gain_of_an_utterance_is_in_decibels() -> None:
    store = MemoryStore()
    name = store.put(babble(0.5, 48000, 2), 48000, "speech")
    loud, soft = (samples(wave(score([utterance(0.0, name, 0.5, gain_db=g)], 0.5, store), store))[0] for g in (0, -20))
    np.testing.assert_allclose(soft, loud * 0.1, atol=2e-7)
    np.testing.assert_allclose(loud, store.get(name).samples, atol=1e-7)  # at the engine's rate nothing is resampled


def test_peaks_are_limited_after_rendering() -> None:
    store = MemoryStore()
    name = store.put(babble(0.5, 48000, 2) * 5, 48000, "speech")
    stream = io.BytesIO()
    done = render(score([utterance(0.1, name, 0.5, gain_db=3.0)], 0.7, store), store, stream)
    signal, _ = samples(stream.getvalue())
    assert done.peak_db == pytest.approx(3.0, abs=0.1)
    assert done.limited_db == pytest.approx(4.0, abs=0.1)
    assert 20 * np.log10(np.abs(signal).max()) == pytest.approx(-1.0, abs=0.01)


def test_progress_rises_to_the_end() -> None:
    told: list[tuple[str, float]] = []
    events = [inspiration(0.1, noise()), inspiration(400.0, noise(seed=2))]
    render(score(events, 401.0), MemoryStore(), io.BytesIO(), on_progress=lambda *what: told.append(what))
    shares = [share for _, share in told]
    assert {stage for stage, _ in told} == {"sound"}
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1.0)


def test_the_report_names_the_engine() -> None:
    done = render(score([inspiration(0.1, noise(), nose=0.5)], 1.0), MemoryStore(), io.BytesIO())
    assert done.engine.startswith("embedded (nanosynth ")
    assert (done.frames, done.sample_rate, done.sounds, done.limited_db) == (48000, 48000, 2, 0.0)
