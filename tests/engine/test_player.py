"""A finished Score played live, in simulated time and once in real time."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from threading import Event as Flag

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.engine.live.making import sounder_named
from scorebreath.engine.live.sounder import Sounder
from scorebreath.engine.live.status import Status
from scorebreath.engine.moves import AS_WRITTEN, moves
from scorebreath.engine.onsets import Onset, onsets
from scorebreath.engine.player import AHEAD, LEAD, Pace, play_score, seek, seek_moves
from scorebreath.errors import InputError
from scorebreath.media.store import MediaStore, MemoryStore
from scorebreath.score.document import Score
from scorebreath.score.events import Event
from scorebreath.score.performing import Heard
from tests.engine.sounding import babble, cut, inspiration, move, noise, score, utterance

STORE = MemoryStore()
SPOKEN = STORE.put(babble(1.0, 22050, 1), 22050, "speech")


class Heard_:  # noqa: N801
    """Stands for a sounder, with a clock that `wait` moves."""

    latency = output_latency = 0.0
    sample_rate = 48000
    start_unix = 1000.0

    def __init__(self) -> None:
        self.now = 1005.0
        self.sounds: list[tuple[float, Onset]] = []
        self.moves: list[tuple[float, str, Heard, float]] = []
        self.hushed: list[float] = []
        self.pace = Pace(now=lambda: self.now, wait=self.wait)

    def wait(self, seconds: float) -> None:
        self.now += seconds

    def begin(self, start_unix: float) -> None:
        raise AssertionError("somebody else's clock")

    def play(self, sounds: Sequence[Onset], media: MediaStore) -> None:
        self.sounds += [(self.now - self.start_unix, sound) for sound in sounds]

    def cut(self, time: float, targets: Iterable[str], fade: float) -> None:
        raise AssertionError("cuts of a score are known before")

    def hush(self, fade: float) -> None:
        self.hushed.append(fade)

    def move(self, time: float, body: str, heard: Heard, glide: float) -> None:
        self.moves.append((time, body, heard, glide))

    def panic(self) -> None:
        raise AssertionError("nobody is in a panic")

    def pan(self, body: str, pan: float) -> None:
        raise AssertionError("nobody moves")

    def status(self) -> Status:
        raise AssertionError("nobody asks")

    def close(self) -> None:
        raise AssertionError("it stays open")


def made(count: int = 10) -> Score:
    events: list[Event] = []
    for number in range(count):
        events.append(inspiration(2.0 * number + 0.1, noise()))
        events.append(utterance(2.0 * number + 0.8, SPOKEN, 1.0))
    return score([*events, move(5.0, 2.0, mouth=3.0)], 2.0 * count + 0.123456, STORE)


def test_every_sound_is_given_once_a_little_ahead() -> None:
    heard, asked = Heard_(), made()
    told: list[float] = []
    assert play_score(asked, STORE, heard, pace=heard.pace, on_time=told.append)
    begin = 5.0 + LEAD
    assert [sound.time - begin for _, sound in heard.sounds] == pytest.approx([one.time for one in onsets(asked)])
    assert all(0 < sound.time - at <= AHEAD for at, sound in heard.sounds)
    assert heard.now - heard.start_unix >= begin + asked.duration
    assert told == sorted(told)
    assert told[-1] == pytest.approx(asked.duration, abs=0.1)
    assert [one[0] - begin for one in heard.moves] == pytest.approx([0.0, 5.0])
    assert heard.moves[1][2:] == (Heard(mouth=3.0), 2.0)


def test_a_sounder_is_what_it_wants() -> None:
    sounder: Sounder = Heard_()
    assert sounder.sample_rate == 48000


@given(st.floats(0, 20.1))
def test_seeking_resumes_speech_and_skips_breaths(start: float) -> None:
    heard, asked = Heard_(), made()
    assert play_score(asked, STORE, heard, start=start, pace=heard.pace)
    begin = 5.0 + LEAD - start
    expected = [one for sound in onsets(asked) if (one := seek(sound, start)) is not None]
    assert [one.event for _, one in heard.sounds] == [one.event for one in expected]
    for _, sound in heard.sounds:
        original = next(one for one in onsets(asked) if one.event == sound.event and one.instrument == sound.instrument)
        assert sound.time - begin >= start - 1e-6
        assert sound.end - begin == pytest.approx(original.end)
        inside = sound.time - begin - original.time
        assert sound.controls.get("start", 0.0) == pytest.approx(inside, abs=1e-6)
        assert inside == pytest.approx(0.0, abs=1e-6) or sound.media is not None


def test_seeking_into_a_glide_goes_on_with_it() -> None:
    found = list(seek_moves(moves(made()), 6.0))
    assert [(one.glide, one.after.mouth) for one in found] == [(0.0, 2.0), (pytest.approx(1.0), 3.0)]
    assert next(iter(seek_moves(moves(made()), 0.0))).after == AS_WRITTEN
    assert [one.after.mouth for one in seek_moves(moves(made()), 8.0)] == [3.0]


def test_a_loop_has_no_gap_and_ends_when_it_is_stopped() -> None:
    heard, asked, stopped = Heard_(), made(3), Flag()
    told: list[float] = []

    def watch(time: float) -> None:
        told.append(time)
        if heard.now > 1005.0 + LEAD + 2.5 * asked.duration:
            stopped.set()

    assert not play_score(asked, STORE, heard, start=1.0, loop=True, stopped=stopped, pace=heard.pace, on_time=watch)
    rounds = [[sound for _, sound in heard.sounds if sound.event.endswith(f"~{number}")] for number in (1, 2)]
    begin = 5.0 + LEAD - 1.0
    for number, found in enumerate(rounds, 1):
        times = [one.time - begin - number * asked.duration for one in found]
        assert times == pytest.approx([one.time for one in onsets(asked)][: len(times)])
    assert len(rounds[0]) == len(onsets(asked))
    assert all(sound.time > at for at, sound in heard.sounds)
    assert len(heard.hushed) == 1
    assert all(0 <= time <= asked.duration for time in told)


def test_a_stop_ends_what_sounds_and_it_can_be_played_again() -> None:
    stopped = Flag()

    def enough(time: float) -> None:
        if time > 0.6:
            stopped.set()

    asked = score([utterance(0.1, SPOKEN, 1.0), utterance(1.2, SPOKEN, 1.0)], 2.3, STORE)
    with sounder_named("silent") as sounder:
        assert not play_score(asked, STORE, sounder, stopped=stopped, on_time=enough)
        assert sounder.status().waiting == 0
        stopped.clear()
        before = sounder.status()
        assert play_score(asked, STORE, sounder)
        after = sounder.status()
    assert before.sent <= 2  # the first utterance, and its end
    assert after.sent - before.sent in {2, 3}
    assert after.lost == 0


def test_cuts_of_the_score_are_played() -> None:
    heard, said = Heard_(), utterance(0.5, SPOKEN, 1.0)
    assert play_score(score([said, cut(1.0, said.id)], 2.0, STORE), STORE, heard, pace=heard.pace)
    ((_, sound),) = heard.sounds
    assert sound.cut is not None
    assert sound.cut.time - sound.time == pytest.approx(0.5)


@pytest.mark.parametrize("start", [-0.1, 20.2, float("nan")])
def test_a_start_beyond_the_score_is_refused(start: float) -> None:
    with pytest.raises(InputError, match="start="):
        play_score(made(), STORE, Heard_(), start=start)


def test_it_plays_in_real_time() -> None:
    asked = score([inspiration(0.1, noise(0.05, 0.1, 0.05)), utterance(0.3, SPOKEN, 1.0)], 1.4, STORE)
    with sounder_named("silent") as sounder:
        assert play_score(asked, STORE, sounder)
        status = sounder.status()
    assert (status.sent, status.lost, status.late_sent) == (2, 0, 0)
