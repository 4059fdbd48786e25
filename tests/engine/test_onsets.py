"""Scores as onsets, without an engine."""

from __future__ import annotations

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.chance import ENGINE_SEEDS
from scorebreath.engine.breaths import tract_scale
from scorebreath.engine.onsets import GENERATORS, onsets
from scorebreath.errors import ScoreError
from scorebreath.media.store import MemoryStore
from scorebreath.score.events import Event
from scorebreath.units import amplitude, decibels, snap
from scorebreath_synthdefs import CATALOGUE, SPEECH
from tests.engine.sounding import REFERENCE_DB, babble, body, expiration, inspiration, noise, score, utterance

GAINS = st.integers(0, 4_000_000).map(lambda value: value / 1_000_000)
BREATHS = st.lists(st.tuples(st.integers(0, 50_000_000), GAINS, GAINS), min_size=1, max_size=12)


def test_a_breath_sounds_through_mouth_and_nose() -> None:
    mouth, nose = onsets(score([inspiration(0.5, noise(onset=0.1), mouth=0.6, nose=0.4)], 2.0))
    assert (mouth.instrument, nose.instrument) == ("scorebreath_mouth_male", "scorebreath_nose_male")
    assert mouth.time == nose.time == pytest.approx(0.6)
    assert mouth.duration == pytest.approx(0.15 + 0.27 + 0.18)
    assert decibels(mouth.controls["level"]) == pytest.approx(REFERENCE_DB - 24 + decibels(0.6))
    assert decibels(nose.controls["level"]) == pytest.approx(REFERENCE_DB - 24 + decibels(0.4) - 6)  # physiology 3.2
    assert [mouth.controls[name] for name in ("attack", "hold", "release")] == [0.15, 0.27, 0.18]


def test_an_expiration_sounds_as_one() -> None:
    (out,) = onsets(score([expiration(1.0, noise(level_db=-32.0))], 2.0))
    assert (out.instrument, out.time) == ("scorebreath_exhale_male", 1.0)
    assert decibels(out.controls["level"]) == pytest.approx(REFERENCE_DB - 32)


def test_an_utterance_plays_its_media() -> None:
    store = MemoryStore()
    name = store.put(babble(0.5, 22050, 1), 22050, "speech")
    (say,) = onsets(score([utterance(0.25, name, 0.5, gain_db=-6.0)], 1.0, store))
    assert (say.instrument, say.media, say.time) == (SPEECH, name, 0.25)
    assert say.duration == pytest.approx(0.5)
    assert say.controls["gain"] == pytest.approx(amplitude(-6.0))


@pytest.mark.parametrize(
    "silent",
    [
        inspiration(0.1, None, mouth=1.0, nose=1.0),
        inspiration(0.1, noise(), mouth=0.0, nose=0.0),
        inspiration(0.1, noise(0.0, 0.0, 0.0)),
        expiration(0.1, None),
    ],
)
def test_what_is_silent_has_no_onset(silent: Event) -> None:
    assert onsets(score([silent], 1.0)) == ()


def test_zero_gain_silences_one_way_only() -> None:
    (nose,) = onsets(score([inspiration(0.1, noise(), mouth=0.0, nose=1.0)], 1.0))
    assert "nose" in nose.instrument


def test_mouth_and_nose_have_noises_of_their_own() -> None:
    for seed in (1, 2, 48271, ENGINE_SEEDS - 3, ENGINE_SEEDS - 2, ENGINE_SEEDS - 1):
        mouth, nose = onsets(score([inspiration(0.1, noise(seed=seed), mouth=0.5, nose=0.5)], 1.0))
        assert mouth.controls["seed"] == seed != nose.controls["seed"]
        assert 1 <= nose.controls["seed"] < ENGINE_SEEDS  # float32 holds it exactly


def test_overlapping_breaths_have_generators_of_their_own() -> None:
    events = [inspiration(snap(0.01 * index), noise(seed=index + 1), nose=0.5) for index in range(GENERATORS // 2)]
    used = [onset.controls["rand_id"] for onset in onsets(score(events, 2.0))]
    assert sorted(used) == list(range(GENERATORS))


def test_every_control_is_in_the_catalogue() -> None:
    store = MemoryStore()
    name = store.put(babble(0.1, 22050, 1), 22050, "speech")
    events = [inspiration(0.1, noise(), nose=0.5), expiration(0.1, noise()), utterance(0.1, name, 0.1)]
    found = onsets(score(events, 1.0, store))
    assert len(found) == 4
    for onset in found:
        assert set(onset.controls) <= set(CATALOGUE[onset.instrument].controls)


@given(BREATHS, st.integers(0, 9_000_000))
def test_moving_a_score_moves_its_onsets_and_nothing_else(breaths: list[tuple[int, float, float]], by: int) -> None:
    def moved(shift: int) -> list[tuple[float, str, dict[str, float]]]:
        events = [
            inspiration(snap((at + shift) / 1e6), noise(seed=number + 1), mouth=mouth, nose=nose, name=f"in{number}.")
            for number, (at, mouth, nose) in enumerate(breaths)
        ]
        return [(onset.time, onset.instrument, dict(onset.controls)) for onset in onsets(score(events, 100.0))]

    here, there = moved(0), moved(by)
    assert [time for time, _, _ in here] == sorted(time for time, _, _ in here)
    assert [time + by / 1e6 for time, _, _ in here] == pytest.approx([time for time, _, _ in there], abs=1e-9)
    assert [rest for _, *rest in here] == [rest for _, *rest in there]


@pytest.mark.parametrize(
    ("broken", "words"),
    [
        (noise(source="ab" * 32), "noise.source='abababababab...' must be 'synth'"),
    ],
)
def test_what_no_instrument_can_play_is_refused(broken: object, words: str) -> None:
    event = dataclasses.replace(inspiration(0.1, None), noise=broken)  # type: ignore[arg-type]
    with pytest.raises(ScoreError, match=words.replace(".", r"\.")) as caught:
        onsets(score([event], 1.0))
    assert event.id in str(caught.value)


def test_very_quiet_speech_is_next_to_silence() -> None:
    store = MemoryStore()
    name = store.put(babble(0.1, 22050, 1), 22050, "speech")
    (quiet,) = onsets(score([utterance(0.1, name, 0.1, gain_db=-200.0)], 1.0, store))
    assert quiet.controls["gain"] == pytest.approx(1e-10)


@given(st.floats(0.0, 20.0), st.floats(0.0, 20.0))
def test_smaller_lungs_have_shorter_tracts(one: float, other: float) -> None:
    assert 0.8 <= tract_scale(one) <= 1.5
    assert tract_scale(min(one, other)) >= tract_scale(max(one, other))


def test_the_tract_follows_the_body() -> None:
    (man,), (woman,) = (onsets(score([inspiration(0.1, noise())], 1.0, None, body(lungs))) for lungs in (5.1, 3.68))
    assert man.controls["scale"] == 1.0
    assert woman.controls["scale"] == pytest.approx(17.0 / 14.5, abs=0.06)  # lengths of tracts, physiology 3.4
