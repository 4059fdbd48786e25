"""What an engine is told: the onsets, in order, with media that come and go."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from supriya import OscBundle, OscMessage, Score

from scorebreath.engine.clock import OfflineClock
from scorebreath.engine.commands import commands, write_commands
from scorebreath.engine.moves import buses, moves
from scorebreath.engine.onsets import onsets
from scorebreath.engine.play import KEEP, PRELOAD, load, play
from scorebreath.engine.segments import segments
from scorebreath.media.store import MemoryStore
from scorebreath_synthdefs import SPEECH
from tests.engine.sounding import babble, cut, inspiration, move, noise, score, utterance

RATE = 48000


def bundles(data: bytes) -> Iterator[tuple[int, OscBundle]]:
    stream = io.BytesIO(data)
    while head := stream.read(4):
        datagram = stream.read(struct.unpack(">i", head)[0])
        assert datagram[:8] == b"#bundle\0"
        yield struct.unpack(">Q", datagram[8:16])[0], OscBundle.from_datagram(datagram)


@pytest.fixture(scope="module")
def told() -> list[tuple[float, OscMessage]]:
    store = MemoryStore()
    names = [store.put(babble(0.5, 22050, seed), 22050, "speech") for seed in (1, 2)]
    events = [
        inspiration(0.25, noise(), nose=0.5),
        utterance(1.0, names[0], 0.5),
        utterance(3.0, names[1], 0.5),
        utterance(5.0, names[0], 0.5),
    ]
    (segment,) = segments(onsets(score(events, 6.0, store)), frames=6 * RATE, sample_rate=RATE)
    stream = io.BytesIO()
    made = commands(segment, {name: f"{index}.wav" for index, name in enumerate(names)}.__getitem__, sample_rate=RATE)
    write_commands(stream, made)
    read = list(bundles(stream.getvalue()))
    tags = [tag for tag, _ in read]
    assert tags == sorted(set(tags))
    return [
        (tag / 2**32, message) for tag, bundle in read for message in bundle.contents if isinstance(message, OscMessage)
    ]


def of(told: list[tuple[float, OscMessage]], address: str) -> list[tuple[float, tuple[object, ...]]]:
    return [(time, message.contents) for time, message in told if message.address == address]


def test_it_begins_with_the_instruments_and_ends_with_silence(told: list[tuple[float, OscMessage]]) -> None:
    assert told[0][0] == 0.0
    assert told[0][1].address == "/d_recv"
    assert told[-1][1].address == "/g_freeAll"
    assert told[-1][0] == pytest.approx(6.0, abs=1e-5)
    assert len(of(told, "/d_recv")) == 1


def test_every_onset_is_a_sound_at_its_time(told: list[tuple[float, OscMessage]]) -> None:
    found = [(time, str(contents[0])) for time, contents in of(told, "/s_new")]
    times = [0.25, 0.25, 1.0, 3.0, 5.0]
    assert [time for time, _ in found] == pytest.approx(times, abs=1 / RATE)
    assert [name for _, name in found] == ["scorebreath_mouth_male", "scorebreath_nose_male", *[SPEECH] * 3]


def test_media_are_read_before_and_freed_after(told: list[tuple[float, OscMessage]]) -> None:
    read, freed = of(told, "/b_allocRead"), of(told, "/b_free")
    assert [contents[1] for _, contents in read] == ["0.wav", "1.wav", "0.wav"]
    assert [time for time, _ in read] == pytest.approx([1.0 - PRELOAD, 3.0 - PRELOAD, 5.0 - PRELOAD], abs=1 / RATE)
    assert [time for time, _ in freed] == pytest.approx([1.5 + KEEP, 3.5 + KEEP, 5.5 + KEEP], abs=1 / RATE)
    assert [contents[0] for _, contents in read] == [contents[0] for _, contents in freed]
    sounding = [contents for _, contents in of(told, "/s_new") if contents[0] == SPEECH]
    for (_, (buffer, *_)), contents in zip(read, sounding, strict=True):
        settings = dict(zip(contents[4::2], contents[5::2], strict=True))
        assert settings.get("buffer", 0.0) == buffer


def test_nothing_is_done_after_the_end() -> None:
    """Speech that is cut by the end of the score is forgotten with it: the engine need not go on."""
    store = MemoryStore()
    name = store.put(babble(5.0, 22050, 1), 22050, "speech")
    (segment,) = segments(onsets(score([utterance(0.5, name, 5.0)], 1.0, store)), frames=RATE, sample_rate=RATE)
    stream = io.BytesIO()
    write_commands(stream, commands(segment, str, sample_rate=RATE))
    tag, last = list(bundles(stream.getvalue()))[-1]
    assert tag / 2**32 == pytest.approx(1.0, abs=1e-5)
    assert [message.address for message in last.contents if isinstance(message, OscMessage)] == [
        "/b_free",
        "/g_freeAll",
    ]


def test_equal_scores_are_told_in_equal_bytes() -> None:
    sounds = onsets(score([inspiration(0.25, noise(), nose=0.5)], 1.0))
    (segment,) = segments(sounds, frames=RATE, sample_rate=RATE)
    one, other = io.BytesIO(), io.BytesIO()
    for stream in (one, other):
        write_commands(stream, commands(segment, str, sample_rate=RATE))
    assert one.getvalue() == other.getvalue()


DRAWN = st.lists(
    st.tuples(st.booleans(), st.integers(100, 20_000), st.floats(0, 1)), max_size=12, unique_by=lambda one: one[1]
)
"""Whether it is speech, when (ms), and its nose's share."""
CUTS = st.lists(st.tuples(st.integers(100, 20_000), st.integers(0, 500)), max_size=3, unique_by=lambda one: one[0])
"""When everything is cut (ms), and its fade (ms)."""
MOVES = st.lists(
    st.tuples(st.integers(0, 20_000), st.integers(0, 900), st.floats(0, 4)), max_size=4, unique_by=lambda one: one[0]
)
"""When gains are moved (ms), in what time (ms), where to."""


@settings(max_examples=40, deadline=None)
@given(DRAWN, CUTS, MOVES)
def test_it_is_what_supriya_would_write(
    drawn: list[tuple[bool, int, float]], cuts: list[tuple[int, int]], moved: list[tuple[int, int, float]]
) -> None:
    """A supriya score that plays the same sounds, cuts and moves gives the same bytes."""
    store = MemoryStore()
    name = store.put(babble(0.5, 22050, 1), 22050, "speech")
    events = [
        utterance(ms / 1000, name, 0.5) if speech else inspiration(ms / 1000, noise(), nose=round(nose, 2))
        for speech, ms, nose in drawn
    ]
    names = tuple(event.id for event in events)
    ends = [cut(ms / 1000, *names, fade=fade / 1000) for ms, fade in cuts]
    louder = [move(ms / 1000, glide / 1000, mouth=round(to, 3)) for ms, glide, to in moved]
    made = score(sorted([*events, *ends, *louder], key=lambda event: event.onset), 21.0, store)
    (segment,) = segments(onsets(made), moves=moves(made), frames=21 * RATE, sample_rate=RATE)
    ours, theirs = io.BytesIO(), io.BytesIO()
    write_commands(ours, commands(segment, str, sample_rate=RATE, buses=buses(segment.moves)))
    clock = OfflineClock(sample_rate=RATE)
    reference = Score(input_bus_channel_count=0, output_bus_channel_count=1, buffer_count=len(segment.sounds) + 1)
    with reference.at(0.0):
        places = load(reference, (sound.instrument for sound in segment.sounds), buses=buses(segment.moves))
    play(reference, segment.sounds, moves=segment.moves, places=places, when=clock, where=str)
    with reference.at(clock.of_frame(segment.frames)):
        reference.free_group_children(reference.root_node)
    for datagram in reference.iterate_datagrams():
        theirs.write(struct.pack(">i", len(datagram)) + datagram)
    assert ours.getvalue() == theirs.getvalue()


class Moments:
    """A context that only remembers when it was asked."""

    def __init__(self) -> None:
        self.asked: list[tuple[str, float]] = []
        self.now = -1.0

    def at(self, seconds: float) -> Moments:
        self.now = seconds
        return self

    def __enter__(self) -> Moments:
        return self

    def __exit__(self, *_: object) -> None:
        self.now = -1.0

    def add_buffer(self, **_: object) -> Moments:
        self.asked.append(("read", self.now))
        return self

    id_ = 7

    def add_synth(self, *_: object, **__: object) -> None:
        self.asked.append(("sound", self.now))

    def free_buffer(self, _: object) -> None:
        self.asked.append(("free", self.now))


def test_any_context_can_play_at_any_clock() -> None:
    """A live server takes the same onsets, at its own time, with its own head start."""
    store = MemoryStore()
    name = store.put(babble(0.5, 22050, 1), 22050, "speech")
    sounds = onsets(score([utterance(1.0, name, 0.5)], 2.0, store))
    live = Moments()
    play(live, sounds, when=lambda time: 1000.0 + time, where=str, preload=0.9)  # type: ignore[arg-type]
    assert [what for what, _ in live.asked] == ["read", "sound", "free"]
    assert [time for _, time in live.asked] == pytest.approx([1000.1, 1001.0, 1001.5 + KEEP])
