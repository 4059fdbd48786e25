"""Norms: what is heard of the breaths, in sounds whose levels and spectra are known."""

from __future__ import annotations

import dataclasses
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scorebreath.errors import InputError
from scorebreath.report.norms import Heard, breaths_alone, listen, norms, speech_level
from scorebreath.report.norms.acoustics import SOUND
from scorebreath.report.norms.listening import core
from scorebreath.report.norms.spectrum import SEGMENT, density, spectrum
from scorebreath.report.norms.table import ROWS
from scorebreath.score.document import Score
from scorebreath.score.events import Inspiration, Noise, Utterance
from tests.curves.scores import score_of
from tests.report.people import EVEN, person

RATE = 48_000
Samples = NDArray[np.float64]
SOUNDING = [row.name for row in ROWS if row.part == SOUND]


def shaped(frames: int, low: float, high: float, seed: int) -> Samples:
    """Noise of RMS 1 between two frequencies, flat there."""
    spectrum = np.fft.rfft(np.random.default_rng(seed).standard_normal(frames))
    frequency = np.fft.rfftfreq(frames, 1 / RATE)
    spectrum[(frequency < low) | (frequency >= high)] = 0
    made = np.fft.irfft(spectrum, frames)
    return np.asarray(made / np.sqrt(np.mean(made**2)))


def sound_of(score: Score, *, breath_db: float, speech_db: float, low: float = 1000.0, high: float = 2000.0) -> Samples:
    """Breaths of band-limited noise while they are held, speech of a low tone, silence elsewhere."""
    samples = np.zeros(round(score.duration * RATE))
    for number, event in enumerate(score.events):
        if isinstance(event, Inspiration) and event.noise:
            start, stop = round(event.onset * RATE), round(event.end * RATE)
            samples[start:stop] = shaped(stop - start, low, high, number) * 10 ** (breath_db / 20)
        elif isinstance(event, Utterance):
            times = np.arange(round(event.onset * RATE), round(event.end * RATE))
            samples[times] = np.sqrt(2) * np.sin(times * 2 * np.pi * 200 / RATE) * 10 ** (speech_db / 20)
    return samples


@pytest.fixture(scope="module")
def score() -> Score:
    return person(6)


def test_the_level_of_the_breaths_is_beside_the_speech(score: Score) -> None:
    for breath, speech in ((-44.0, -20.0), (-50.0, -20.0), (-30.0, -18.0)):
        row = norms(score, sound_of(score, breath_db=breath, speech_db=speech), RATE)["breath_level"]
        assert row.n == 6
        assert row.value == pytest.approx(breath - speech, abs=0.3)
        assert str(row.verdict) == {-24.0: "within", -30.0: "outside: below", -12.0: "outside: above"}[breath - speech]


def test_the_spectrum_of_a_band_is_the_band(score: Score) -> None:
    found = norms(score, sound_of(score, breath_db=-44, speech_db=-20, low=1000, high=2000), RATE)
    assert found["centroid"].value == pytest.approx(1500, rel=0.03)
    assert found["median_frequency"].value == pytest.approx(1500, rel=0.05)
    assert found["roll_off"].value == pytest.approx(1850, rel=0.03)
    assert found["band_1_3"].value == pytest.approx(0, abs=0.1)
    for name in ("band_0_1", "band_3_6", "band_6_12"):
        assert (found[name].value or 0) < -15
    assert {str(found[name].verdict) for name in ("centroid", "median_frequency", "roll_off")} == {"within"}


def test_every_row_about_sound_has_values_where_there_is_sound(score: Score) -> None:
    silent, heard = norms(score), norms(score, sound_of(score, breath_db=-44, speech_db=-20), RATE)
    assert [silent[name].n for name in SOUNDING] == [0] * len(SOUNDING)
    assert [heard[name].n for name in SOUNDING] == [6] * len(SOUNDING)


def test_the_nose_has_a_window_of_its_own() -> None:
    bright = {"low": 1500.0, "high": 4500.0}
    verdicts = {}
    for nose, mouth in ((1.0, 0.0), (0.0, 1.0), (0.7, 0.3)):
        score = person([dataclasses.replace(EVEN, nose=nose, mouth=mouth)] * 6)
        found = norms(score, sound_of(score, breath_db=-44, speech_db=-20, **bright), RATE)
        verdicts[found.who.route] = str(found["centroid"].verdict)
    assert verdicts == {"nose": "within", "mouth": "outside: above", "both": "within"}


def test_a_file_is_heard_as_its_samples_are(score: Score, tmp_path: Path) -> None:
    samples = sound_of(score, breath_db=-44, speech_db=-20)
    path = tmp_path / "mix.wav"
    soundfile.write(path, np.stack((samples, samples), axis=1), RATE, subtype="PCM_24")
    from_file, from_samples = listen(score, path), listen(score, samples, RATE)
    assert from_file.level == pytest.approx(from_samples.level, abs=1e-3)
    assert from_file.spectra.centroid == pytest.approx(from_samples.spectra.centroid, rel=1e-3)
    assert from_file.sample_rate == RATE
    assert from_file.seconds == pytest.approx(score.duration, abs=1e-4)
    assert norms(score, from_file)["centroid"].value == norms(score, path)["centroid"].value


def test_what_is_missing_at_the_end_is_left_out(score: Score) -> None:
    samples = sound_of(score, breath_db=-44, speech_db=-20)
    found = norms(score, samples[: len(samples) // 2], RATE)
    assert 2 <= found["breath_level"].n <= 3
    assert found["breath_level"].value is not None and abs(found["breath_level"].value + 24) < 0.5
    assert norms(score, samples[:10], RATE)["breath_level"].n == 0


def test_silence_has_a_level_and_no_spectrum(score: Score) -> None:
    samples = sound_of(score, breath_db=-44, speech_db=-20)
    for event in score.of(Inspiration):
        samples[round(event.onset * RATE) : round(event.end * RATE)] = 0
    found = norms(score, samples, RATE)
    assert (found["breath_level"].n, found["centroid"].n) == (6, 0)
    assert str(found["breath_level"].verdict) == "outside: below"


def test_without_speech_in_the_sound_its_level_is_the_score_s(score: Score) -> None:
    samples = sound_of(score, breath_db=-44, speech_db=-20)
    for event in score.of(Utterance):
        samples[round(event.onset * RATE) : round(event.end * RATE)] = 0
    told = speech_level(score)
    assert told is not None
    assert listen(score, samples, RATE).level.mean() == pytest.approx(-44 - told, abs=0.3)
    db = np.concatenate([event.level.db for event in score.of(Utterance)])
    assert told == pytest.approx(10 * np.log10(np.mean(10 ** (db / 10))))


def test_breaths_of_nobody_who_speaks_have_no_level() -> None:
    score = person(6)
    mute = dataclasses.replace(score, events=tuple(e for e in score.events if not isinstance(e, Utterance)))
    heard = listen(mute, sound_of(mute, breath_db=-44, speech_db=0), RATE)
    assert (speech_level(mute), heard.level.size, heard.spectra.centroid.size) == (None, 0, 6)


@pytest.mark.parametrize(
    ("samples", "rate"),
    [(np.zeros(10), None), (np.zeros(10), 0.0), (np.zeros((2, 2, 2)), 48_000.0), (np.full(10, np.nan), 48_000.0)],
)
def test_samples_that_are_no_sound(score: Score, samples: Samples, rate: float | None) -> None:
    with pytest.raises(InputError):
        norms(score, samples, rate)


def test_files_that_are_no_sound(score: Score, tmp_path: Path) -> None:
    (tmp_path / "no.wav").write_bytes(b"RIFFnot at all")
    for name, said in (("no.wav", "sound file"), ("none.wav", "no such file"), ("", "is a folder")):
        with pytest.raises(InputError, match=said):
            norms(score, tmp_path / name)


def test_a_low_rate_has_levels_and_no_spectra(score: Score) -> None:
    samples = sound_of(score, breath_db=-44, speech_db=-20)[::3]
    found = norms(score, samples, RATE / 3)
    assert (found["breath_level"].n, found["centroid"].n) == (6, 0)
    assert str(found["centroid"].verdict) == "too few"


def test_what_is_listened_to() -> None:
    breath = next(person(1).of(Inspiration))
    assert core(breath) == pytest.approx((breath.onset + 0.06 + 0.096, breath.onset + 0.54 - 0.144))
    assert isinstance(breath.noise, Noise)
    flowing = dataclasses.replace(breath, noise=dataclasses.replace(breath.noise, envelope="flow"))
    window = core(flowing)
    assert window is not None
    rising = (window[0] - breath.onset - 0.06) / 0.096
    assert np.sin(rising * np.pi / 2) ** 1.66 == pytest.approx(0.5)
    for other in ({"noise": None}, {"saccades": 3}, {"sound_nose": 0.0, "sound_mouth": 0.0}):
        assert core(dataclasses.replace(breath, **other)) is None


@pytest.mark.parametrize(("most", "expected"), [(400, 12), (5, 5), (1, 1)])
def test_breaths_alone_are_the_score_s_breaths(most: int, expected: int) -> None:
    score = person(12)
    alone = breaths_alone(score, most=most)
    events = list(alone.of(Inspiration))
    assert (len(events), len(alone.events), len(alone.groups)) == (expected, expected, 0)
    whole = {event.id: event for event in score.of(Inspiration)}
    for event in events:
        assert dataclasses.replace(event, onset=whole[event.id].onset, group=whole[event.id].group) == whole[event.id]
    assert all(one.end < two.onset for one, two in pairwise(events))
    assert alone.duration > events[-1].end
    assert breaths_alone(score_of([])).events == ()


def test_alone_and_in_the_mix_breaths_measure_the_same(score: Score) -> None:
    alone = breaths_alone(score)
    heard = listen(alone, sound_of(alone, breath_db=-44, speech_db=-20), RATE, speech_db=-20.0)
    assert heard.level == pytest.approx(np.full(6, -24.0), abs=1.0)
    assert isinstance(heard, Heard) and heard.alone
    assert norms(score, heard)["breath_level"].n == 6


def test_a_spectrum_is_welch_s() -> None:
    from scipy.signal import welch

    noise = np.random.default_rng(1).standard_normal(20_000)
    frequency, power = density(noise, RATE)
    there, expected = welch(noise, RATE, window=np.hanning(SEGMENT + 2)[1:-1], nperseg=SEGMENT, detrend=False)
    assert frequency == pytest.approx(there)
    inner = slice(1, -1)  # scipy doubles all but the ends
    assert power[inner] / power[inner].sum() == pytest.approx(expected[inner] / expected[inner].sum())


@pytest.mark.parametrize("rate", [24_000.0, 44_100.0, 96_000.0])
def test_the_rate_does_not_move_a_tone(rate: float) -> None:
    tone = np.sin(2 * np.pi * 2500 * np.arange(round(0.5 * rate)) / rate)
    found = spectrum([tone], rate)
    assert found.centroid[0] == pytest.approx(2500, rel=0.01)
    assert found.bands[0][1] == pytest.approx(0, abs=0.05)
