"""Long scores in pieces: nothing is lost, nothing is cut through, and nobody hears it."""

from __future__ import annotations

from functools import partial

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.engine import offline
from scorebreath.engine.clock import BLOCK
from scorebreath.engine.onsets import Onset
from scorebreath.engine.segments import segments
from scorebreath.media.store import MemoryStore
from scorebreath.score.events import Event
from tests.engine.sounding import babble, inspiration, noise, score, utterance, wave

RATE = 16000


def sounds(places: list[tuple[float, float]]) -> list[Onset]:
    made = [Onset(time=time, duration=length, instrument="x", controls={}, event="e") for time, length in places]
    return sorted(made, key=lambda sound: sound.time)


PLACES = st.lists(st.tuples(st.floats(0, 90), st.floats(0.001, 20)), max_size=20).map(sounds)


@given(PLACES, st.integers(0, 100 * RATE), st.floats(0.01, 200))
def test_pieces_tile_the_whole_and_hold_whole_sounds(given_sounds: list[Onset], frames: int, length: float) -> None:
    heard = [sound for sound in given_sounds if int(sound.time * RATE + 0.5) < frames]
    pieces = list(segments(heard, frames=frames, sample_rate=RATE, length=length))
    assert [piece.start for piece in pieces] == [0, *(p.start + p.frames for p in pieces)][: len(pieces)]
    assert sum(piece.frames for piece in pieces) == frames
    assert [sound for piece in pieces for sound in piece.sounds] == heard
    for number, piece in enumerate(pieces):
        assert piece.start % BLOCK == 0
        last = number == len(pieces) - 1
        for sound in piece.sounds:
            assert int(sound.time * RATE + 0.5) >= piece.start
            assert last or sound.end * RATE < piece.start + piece.frames


@given(PLACES)
def test_overlap_counts_what_is_there_at_once(given_sounds: list[Onset]) -> None:
    (piece,) = segments(given_sounds, frames=RATE * 200, sample_rate=RATE, length=1e6)
    most = max((sum(o.time <= s.time <= o.end for o in given_sounds) for s in given_sounds), default=0)
    assert piece.overlap >= most
    assert piece.overlap <= len(given_sounds)


def test_a_long_silence_is_a_piece_without_sounds_or_engine() -> None:
    pieces = list(segments(sounds([(0, 1), (900, 1)]), frames=RATE * 2000, sample_rate=RATE))
    assert [len(piece.sounds) for piece in pieces] == [1, 1, 0]
    assert pieces[0].frames < 2 * RATE


def test_pieces_sound_as_the_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    store = MemoryStore()
    name = store.put(babble(0.7, 22050, 3), 22050, "speech")
    events: list[Event] = []
    for index in range(6):
        events.append(inspiration(1.7 * index + 0.1, noise(seed=index + 1), nose=0.5))
        events.append(utterance(1.7 * index + 0.8, name, 0.7))
    made = score(events, 11.000001, store)
    whole = wave(made, store)
    runs: list[int] = []
    in_pieces = partial(segments, length=1.5)

    def counted(*args: object, **settings: object) -> object:
        pieces = list(in_pieces(*args, **settings))  # type: ignore[arg-type]
        runs.append(len(pieces))
        return pieces

    monkeypatch.setattr(offline, "segments", counted)
    assert wave(made, store) == whole
    assert runs == [7]  # a breath group each, and the silence at the end
