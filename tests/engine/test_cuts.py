"""A cut ends what sounds and prevents what would: measured in what the engines make."""

from __future__ import annotations

import shutil

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.engine.clock import BLOCK
from scorebreath.engine.onsets import onsets
from scorebreath.media.store import MemoryStore
from scorebreath.score.cutting import Ending
from scorebreath.score.events import Event, Utterance
from tests.engine.listening import Signal
from tests.engine.sounding import babble, cut, inspiration, noise, samples, score, utterance, wave

RATE = 48000
ENGINES = [
    "embedded",
    pytest.param(
        "scsynth",
        marks=[
            pytest.mark.scsynth,
            pytest.mark.skipif(shutil.which("scsynth") is None, reason="no scsynth on PATH"),
        ],
    ),
]
STORE = MemoryStore()
SPOKEN = STORE.put(babble(2.0, RATE, 3), RATE, "speech")
LONG = noise(0.1, 1.8, 0.1)


def sound(event: Event, *cuts: Event, engine: str = "embedded", duration: float = 3.0) -> Signal:
    return samples(wave(score([event, *cuts], duration, STORE), STORE, engine=engine, encoding="float32"))[0]


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("at", [0.3212345, 0.325, 0.7, 1.2345])
@pytest.mark.parametrize("fade", [0.0, 0.02, 0.25])
@pytest.mark.parametrize("what", ["breath", "speech"])
def test_what_sounds_is_the_same_until_the_cut_and_silent_after_the_fade(
    what: str, fade: float, at: float, engine: str
) -> None:
    event = inspiration(0.3001, LONG) if what == "breath" else utterance(0.3001, SPOKEN, 2.0)
    whole, short = (sound(event, *cuts, engine=engine) for cuts in ((), (cut(at, event.id, fade=fade),)))
    first, last = round(at * RATE), round((at + fade) * RATE)
    np.testing.assert_array_equal(short[: first - 1], whole[: first - 1])
    last = max(last, first + 3 * BLOCK)  # no cut is faster
    assert not short[last + 4 :].any()
    assert whole[last + 4 :].any()
    places = np.arange(first - 1, last + 4)
    sounding = np.abs(whole[places]) > 1e-3
    gain = short[places][sounding] / whole[places][sounding]
    assert np.all(np.diff(gain) < 1e-3)  # it only falls
    assert (np.abs(np.diff(gain)) / np.diff(places[sounding])).max() < 1.1 / BLOCK  # and nowhere breaks off
    straight = 1 - (places[sounding] - at * RATE) / (fade * RATE) if fade else gain
    np.testing.assert_allclose(gain, straight, atol=2 * BLOCK / (max(fade, 0.003) * RATE))


@pytest.mark.parametrize("engine", ENGINES)
def test_a_cut_sound_is_gone_from_the_engine(engine: str) -> None:
    """Nothing piles up: two hundred long breaths, each cut at once, and one that is not."""
    events: list[Event] = [inspiration(0.01 * index, LONG) for index in range(200)]
    cuts = [cut(event.onset + 0.005, event.id, fade=0.001) for event in events[:-1]]
    heard = samples(wave(score([*events, *cuts], 4.5), engine=engine))[0]
    alone = samples(wave(score(events[-1:], 4.5), engine=engine))[0]
    np.testing.assert_array_equal(heard[2 * RATE :], alone[2 * RATE :])


def test_what_would_begin_later_never_does() -> None:
    events = [inspiration(0.2, LONG), utterance(1.0, SPOKEN, 2.0), inspiration(1.5, noise(seed=3))]
    ended = cut(1.0, *(event.id for event in events), fade=0.1)
    (left,) = onsets(score([*events, ended], 4.0, STORE))
    assert (left.event, left.cut) == ("in0.2", Ending(time=1.0, fade=0.1))
    assert left.end == pytest.approx(1.1)


def test_a_cut_after_the_end_changes_not_one_bit() -> None:
    event = inspiration(0.2, noise(), nose=0.5)
    np.testing.assert_array_equal(sound(event, cut(0.9, event.id)), sound(event))


def test_only_what_is_named_is_cut() -> None:
    one, other = inspiration(0.2, LONG), utterance(0.4, SPOKEN, 2.0)
    left = onsets(score([one, other, cut(0.5, one.id)], 4.0, STORE))
    assert [(sound.event, sound.cut is None) for sound in left] == [(one.id, False), (other.id, True)]


@given(
    st.lists(st.tuples(st.integers(0, 3000), st.booleans()), min_size=1, max_size=8, unique_by=lambda one: one[0]),
    st.lists(st.tuples(st.integers(0, 4000), st.integers(0, 300)), max_size=4, unique_by=lambda one: one[0]),
)
def test_laws_of_cuts(drawn: list[tuple[int, bool]], cuts: list[tuple[int, int]]) -> None:
    """No sound begins at or after a cut of it, none goes on after its fade; uncut ones are as they were."""
    events: list[Event] = [
        utterance(ms / 1000, SPOKEN, 2.0) if speech else inspiration(ms / 1000, LONG, nose=0.5) for ms, speech in drawn
    ]
    named = tuple(event.id for event in events)
    first = min(((ms / 1000, fade / 1000) for ms, fade in cuts), default=(99.0, 0.0))
    uncut = onsets(score(events, 9.0, STORE))
    left = onsets(score([*events, *(cut(ms / 1000, *named, fade=fade / 1000) for ms, fade in cuts)], 9.0, STORE))
    assert len(left) == sum(sound.time < first[0] for sound in uncut)
    for sound, before in zip(left, uncut, strict=False):
        assert (sound.event, sound.time) == (before.event, before.time)
        assert sound.end <= max(first[0] + first[1], sound.time) + 1e-6 or sound == before
        assert (sound.cut is None) == (before.end <= first[0])


def test_speech_that_is_cut_keeps_its_media() -> None:
    event: Utterance = utterance(0.1, SPOKEN, 2.0)
    (left,) = onsets(score([event, cut(0.5, event.id)], 3.0, STORE))
    assert left.media_duration == pytest.approx(2.0)
    assert left.duration == pytest.approx(0.45)
