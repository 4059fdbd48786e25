"""A performance is rendered again: the same sounds on the same frames, cut where they were cut."""

from __future__ import annotations

import io
import struct
from collections.abc import Callable

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scorebreath.engine.commands import commands, write_commands
from scorebreath.engine.live.timing import LiveClock
from scorebreath.engine.offline import render
from scorebreath.engine.onsets import Onset, onsets
from scorebreath.engine.segments import segments
from scorebreath.live.console import Console
from scorebreath.score.cutting import endings
from scorebreath.score.events import Utterance
from scorebreath.signal.resample import resample
from scorebreath.units import frame_count
from tests.live.stages import Stage

RATE = 48000


@pytest.fixture(scope="module")
def stage() -> Stage:
    """A scripted performance, with everything that can be done to a sound."""
    stage = Stage(step=0.02)
    desk = Console(stage.performance)
    desk.say("It was late. The road went on and on through the hills, and nobody said a word for an hour.")
    orders: tuple[tuple[float, Callable[[], None]], ...] = (
        (2.0, lambda: desk.set("speaking_loudness", 50.0, glide=0.2)),
        (3.2, lambda: desk.command("sigh")),
        (6.0, lambda: desk.set("nose_share", 0.9)),
        (9.0, lambda: desk.say("No, listen to me for once.", cut_in=True)),
        (13.0, lambda: desk.command("laugh")),
    )
    for time, order in orders:
        stage.go(time)
        order()
    desk.command("end")
    stage.go(1000.0)
    return stage


@pytest.fixture(scope="module")
def mix(stage: Stage) -> NDArray[np.float64]:
    """The take's sound."""
    stream = io.BytesIO()
    render(stage.score(), stage.media, stream, sample_rate=RATE)
    samples, rate = soundfile.read(io.BytesIO(stream.getvalue()))
    assert rate == RATE
    return np.asarray(samples, dtype=np.float64)


def told_offline(stage: Stage) -> dict[str, list[float]]:
    """Time tags of the .osc that an offline run reads, s, by instrument."""
    score = stage.score()
    frames = frame_count(score.duration, RATE)
    (segment,) = segments(onsets(score), frames=frames, sample_rate=RATE, length=1e6)
    stream = io.BytesIO()
    write_commands(stream, commands(segment, lambda name: name, sample_rate=RATE))
    data, at = stream.getvalue(), 0
    found: dict[str, list[float]] = {}
    while at < len(data):
        (size,) = struct.unpack_from(">i", data, at)
        bundle, at = data[at + 4 : at + 4 + size], at + 4 + size
        (tag,) = struct.unpack_from(">Q", bundle, 8)
        place = 16
        while place < size:
            (length,) = struct.unpack_from(">i", bundle, place)
            message = bundle[place + 4 : place + 4 + length]
            place += 4 + length
            if message.startswith(b"/s_new\0"):
                name = message.split(b",", 1)[1].split(b"\0", 1)[1].lstrip(b"\0").split(b"\0", 1)[0].decode()
                found.setdefault(name, []).append(tag / 2**32)
    return found


def test_tags_of_the_journal_are_those_of_the_offline_run(stage: Stage) -> None:
    score = stage.score()
    ends = endings(score.events)
    clock = LiveClock(start=1_700_000_000.0, sample_rate=RATE)
    live: dict[str, list[float]] = {}
    for call in stage.sounder.calls:
        if call.kind == "play" and isinstance(call.what, Onset) and call.what.duration > 0:
            event = call.what.event
            if event in ends and call.time >= ends[event].time:
                continue  # taken back before it began
            tag = clock.tag(call.what.time) - clock.start_tag
            live.setdefault(call.what.instrument, []).append(tag / 2**32)
    offline = told_offline(stage)
    heard = {name: times for name, times in offline.items() if name in live}
    assert set(heard) == set(live)
    for name, times in heard.items():
        frames = [np.floor(np.array(sorted(one)) * RATE + 1e-3).astype(int) for one in (times, live[name])]
        assert np.array_equal(frames[0], frames[1]), name
        assert np.abs(np.array(sorted(times)) - np.array(sorted(live[name]))).max() < 0.5 / RATE


def test_speech_begins_on_its_frame(stage: Stage, mix: NDArray[np.float64]) -> None:
    score = stage.score()
    ends = endings(score.events)
    count = 0
    for said in score.of(Utterance):
        if said.id in ends and ends[said.id].prevents(said):
            continue
        sound = stage.media.get(said.media)
        wanted = resample(sound.samples, sound.sample_rate, RATE).astype(np.float64)
        frame = frame_count(said.onset, RATE)
        length = min(len(wanted), 12_000, len(mix) - frame)
        scores = [
            float(np.dot(mix[frame + lag : frame + lag + length], wanted[:length])) for lag in range(-4, 5)
            if frame + lag >= 0
        ]  # fmt: skip
        assert abs(int(np.argmax(scores)) - 4) <= 1, said.id
        count += 1
    assert count >= 4


def test_speech_ends_where_it_is_cut(stage: Stage, mix: NDArray[np.float64]) -> None:
    score = stage.score()
    ends = endings(score.events)
    broken = [e for e in score.of(Utterance) if e.id in ends and ends[e.id].shortens(e)]
    assert broken
    for said in broken:
        cut = ends[said.id]
        after = mix[frame_count(cut.time + cut.fade + 0.02, RATE) : frame_count(cut.time + cut.fade + 0.05, RATE)]
        before = mix[frame_count(cut.time - 0.2, RATE) : frame_count(cut.time, RATE)]
        assert np.abs(before).max() > 0.01
        assert np.sqrt(np.mean(after**2)) < 0.15 * np.sqrt(np.mean(before**2))
