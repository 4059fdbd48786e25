"""Which noises events make: the table of kinds, gasps, puffs, recordings, throats."""

from __future__ import annotations

import dataclasses
from functools import cache
from typing import Any, get_args, get_type_hints

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.chance import ENGINE_SEEDS
from scorebreath.engine.breaths import ROUTES, other_seed, share, throat
from scorebreath.engine.onsets import Onset, onsets
from scorebreath.equations.breath import FLOW_EXPONENT, mix_level
from scorebreath.errors import ScoreError
from scorebreath.media.store import MemoryStore
from scorebreath.score.document import MediaInfo, Person, Score
from scorebreath.score.events import Event, Expiration, Hold, Inspiration, Noise
from scorebreath.units import amplitude, decibels
from scorebreath_synthdefs import CATALOGUE, RECORDING
from tests.engine.sounding import REFERENCE_DB, STILL, babble, body, expiration, inspiration, noise, score

NOISES = st.integers(1, ENGINE_SEEDS - 1)


def heard(event: Event, made: Score | None = None) -> tuple[Onset, ...]:
    given_score = made or score([event], 20.0)
    return onsets(dataclasses.replace(given_score, events=(event,)))


def kinds(found: tuple[Onset, ...]) -> list[str]:
    return [onset.instrument.removeprefix("scorebreath_").rpartition("_")[0] for onset in found]


def hold(kind: Any = "held", sound: Noise | None = None) -> Hold:
    return Hold(
        id="hold", body="body", onset=1.0, duration=0.5, kind=kind, volume=0.5, thorax_share=0.65, motion=STILL,
        noise=sound,
    )  # fmt: skip


@pytest.mark.parametrize("event", [Inspiration, Expiration, Hold])
def test_every_kind_of_event_has_its_row(event: type[Event]) -> None:
    listed = {kind for of, kind in ROUTES if of == event.type}
    assert listed == set(get_args(get_type_hints(event)["kind"]))


TABLE = [
    ("inspiration", "speech", ["mouth", "nose"]),
    ("inspiration", "tidal", ["mouth", "nose"]),
    ("inspiration", "sigh", ["mouth", "nose"]),
    ("inspiration", "gasp", ["gasp", "nose"]),
    ("inspiration", "sniff", ["mouth", "sniff"]),
    ("expiration", "speech", ["exhale", "nose"]),
    ("expiration", "tidal", ["exhale", "nose"]),
    ("expiration", "audible", ["exhale", "nose"]),
    ("expiration", "sigh", ["sigh", "nose"]),
    ("expiration", "laugh", ["laugh", "nose"]),
]


@pytest.mark.parametrize(("of", "kind", "expected"), TABLE)
def test_kinds_of_events_sound_on_their_instruments(of: str, kind: Any, expected: list[str]) -> None:
    event: Event
    if of == "inspiration":
        event = dataclasses.replace(inspiration(0.5, noise(), mouth=0.6, nose=0.4), kind=kind)
    else:
        event = dataclasses.replace(expiration(0.5, noise()), kind=kind, sound_mouth=0.6, sound_nose=0.4)
    found = heard(event)
    assert kinds(found) == expected
    levels = [decibels(onset.controls["level"]) - REFERENCE_DB + 24 for onset in found]
    assert levels == pytest.approx([decibels(0.6), decibels(0.4) - 6])  # physiology 3.2


def test_a_held_breath_catches_and_a_rest_does_not() -> None:
    (catch,) = heard(hold("held", noise(0.002, 0.003, 0.025, level_db=-44.0)))
    assert kinds((catch,)) == ["hold"]
    assert catch.time == 1.0
    assert decibels(catch.controls["level"]) == pytest.approx(REFERENCE_DB - 44)
    assert not heard(hold("rest", noise()))
    assert not heard(hold("held"))


def test_the_envelope_and_the_brightness_go_along() -> None:
    straight, flowing = noise(), noise(envelope="flow", brightness=1.1)
    (one,), (other,) = heard(inspiration(0.1, straight)), heard(inspiration(0.1, flowing))
    assert (one.controls["exponent"], one.controls["brightness"]) == (0.0, 1.0)
    assert (other.controls["exponent"], other.controls["brightness"]) == (FLOW_EXPONENT, 1.1)


def test_saccades_repeat_the_noise_and_shorten_it() -> None:
    whole = dataclasses.replace(inspiration(2.0, noise(0.1, 0.1, 0.04, onset=0.06, envelope="flow")), duration=0.3)
    broken = heard(dataclasses.replace(whole, saccades=3))
    assert [onset.time for onset in broken] == pytest.approx([2.0 + 0.1 * k + 0.02 for k in range(3)])
    for onset in broken:
        assert onset.duration == pytest.approx(0.08)
        assert [onset.controls[ramp] for ramp in ("attack", "hold", "release")] == pytest.approx(
            [0.1 / 3, 0.1 / 3, 0.04 / 3]
        )
        assert onset.controls["level"] == heard(whole)[0].controls["level"]
    assert len({onset.controls["seed"] for onset in broken}) == 3


def test_a_laugh_puffs_at_its_onsets() -> None:
    laugh = dataclasses.replace(
        expiration(3.0, noise(0.01, 0.02, 0.08, onset=0.005)), kind="laugh", puffs=(0.0, 0.217, 0.435, 0.652)
    )
    found = heard(laugh)
    assert [onset.time for onset in found] == pytest.approx([3.005, 3.222, 3.44, 3.657])
    assert kinds(found) == ["laugh"] * 4
    assert [onset.duration for onset in found] == pytest.approx([0.11] * 4)
    assert len({onset.controls["seed"] for onset in found}) == 4


@given(NOISES)
def test_seeds_stay_in_range_and_differ(seed: int) -> None:
    following = [seed]
    for _ in range(20):
        following.append(other_seed(following[-1]))
    assert all(1 <= one < ENGINE_SEEDS for one in following)
    assert 0 <= share(seed) < 1


@given(NOISES)
def test_all_that_sounds_of_one_event_has_seeds_of_its_own(seed: int) -> None:
    event = dataclasses.replace(inspiration(0.5, noise(seed=seed), mouth=0.5, nose=0.5), saccades=4)
    seeds = [onset.controls["seed"] for onset in heard(event)]
    assert seeds[0] == seed
    assert len(seeds) == 8
    assert len(set(seeds)) > 6  # two of sixteen million may meet


@pytest.mark.parametrize(
    ("length", "speaker", "scale"),
    [
        (17.0, "male", 1.0),
        (18.5, "male", 17 / 18.5),
        (15.9, "male", 17 / 15.9),
        (15.5, "female", 14.5 / 15.5),
        (14.5, "female", 1.0),
        (12.5, "child", 12 / 12.5),
        (9.0, "child", 12 / 9),
    ],
)
def test_the_vocal_tract_chooses_the_speaker(length: float, speaker: str, scale: float) -> None:
    person = Person(vital_capacity=4.0, resting_volume=0.35, vocal_tract=length)
    assert throat(person).speaker == speaker
    assert throat(person).scale == pytest.approx(scale)
    (onset,) = onsets(score([inspiration(0.1, noise())], 1.0, None, dataclasses.replace(body(), person=person)))
    assert onset.instrument == f"scorebreath_mouth_{speaker}"
    assert onset.controls["scale"] == pytest.approx(scale)


@cache
def recorded(seconds: float = 5.0, kind: Any = "breath") -> tuple[Score, str, MemoryStore]:
    store = MemoryStore()
    name = store.put(babble(seconds, 44100, 3) if seconds else babble(0.1, 44100, 3)[:0], 44100, kind)
    info = MediaInfo(path=f"breath/{name}.wav", frames=int(seconds * 44100), sample_rate=44100, kind=kind)
    return dataclasses.replace(score([], 20.0), media={name: info}), name, store


def test_a_recording_sounds_once_as_loud_as_mouth_and_nose() -> None:
    made, name, _ = recorded()
    event = inspiration(0.5, noise(source=name, envelope="flow", brightness=1.2), mouth=0.65, nose=0.35)
    (onset,) = heard(event, made)
    assert (onset.instrument, onset.media, onset.media_duration) == (RECORDING, name, 5.0)
    assert onset.duration == pytest.approx(0.6)
    assert onset.controls["level"] == pytest.approx(amplitude(REFERENCE_DB - 24 + mix_level(0.65, 0.35)))
    assert set(onset.controls) <= set(CATALOGUE[RECORDING].controls)
    assert onset.controls["exponent"] == FLOW_EXPONENT


def test_mouth_and_nose_may_have_recordings_of_their_own() -> None:
    made, mouth, _ = recorded()
    other, nose, _ = recorded(4.0)
    both = dataclasses.replace(made, media={**made.media, **other.media})
    found = heard(inspiration(0.5, noise(source=mouth, source_nose=nose), mouth=0.65, nose=0.35), both)
    assert [(onset.instrument, onset.media, onset.media_duration) for onset in found] == [
        (RECORDING, mouth, 5.0),
        (RECORDING, nose, 4.0),
    ]
    levels = [decibels(onset.controls["level"]) for onset in found]
    assert levels == pytest.approx([REFERENCE_DB - 24 + decibels(0.65), REFERENCE_DB - 30 + decibels(0.35)])
    half = heard(inspiration(0.5, noise(source_nose=nose), mouth=0.65, nose=0.35), both)
    assert [onset.instrument for onset in half] == ["scorebreath_mouth_male", RECORDING]


@given(NOISES)
def test_a_recording_begins_where_enough_of_it_is_left(seed: int) -> None:
    made, name, _ = recorded()
    (onset,) = heard(inspiration(0.5, noise(seed=seed, source=name)), made)
    assert 0 <= onset.controls["start"] <= 5.0 - 0.6


def test_seeds_begin_recordings_all_over() -> None:
    made, name, _ = recorded()
    starts = [
        heard(inspiration(0.5, noise(seed=seed, source=name)), made)[0].controls["start"] for seed in range(1, 41)
    ]
    assert len(set(starts)) == 40
    assert min(starts) < 0.5
    assert max(starts) > 3.9


def test_a_short_recording_begins_at_its_start() -> None:
    made, name, _ = recorded(0.4)
    (onset,) = heard(inspiration(0.5, noise(source=name)), made)
    assert (onset.controls["start"], onset.media_duration) == (0.0, 0.4)
    assert onset.duration == pytest.approx(0.6)


def test_gasps_and_puffs_of_a_recording_begin_in_different_places() -> None:
    made, name, _ = recorded()
    event = dataclasses.replace(inspiration(0.5, noise(source=name)), saccades=3)
    assert len({onset.controls["start"] for onset in heard(event, made)}) == 3


def test_a_recording_no_one_lets_through_is_silent() -> None:
    made, name, _ = recorded()
    assert not heard(inspiration(0.5, noise(source=name), mouth=0.0, nose=0.0), made)
    assert not heard(hold("rest", noise(source=name)), made)


@pytest.mark.parametrize(
    ("seconds", "kind", "words"),
    [(1.0, "speech", "must be the recording of a breath, not 44100 frames of speech"), (0.0, "breath", "not 0 frames")],
)
def test_what_is_no_recording_of_a_breath_is_refused(seconds: float, kind: str, words: str) -> None:
    made, name, _ = recorded(seconds, kind)
    with pytest.raises(ScoreError, match=words) as caught:
        heard(inspiration(0.5, noise(source=name)), made)
    assert "event 'in0.5': noise.source=" in str(caught.value)
