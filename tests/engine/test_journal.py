"""What a live engine is told is what an offline one is told, for the same frames."""

from __future__ import annotations

import io
from collections import Counter

from hypothesis import given, settings
from hypothesis import strategies as st
from supriya import OscMessage

from scorebreath.engine.clock import OfflineClock
from scorebreath.engine.commands import commands, write_commands
from scorebreath.engine.live.conductor import Conductor, Played
from scorebreath.engine.live.journal import Entry
from scorebreath.engine.live.layout import own_layout
from scorebreath.engine.live.orders import Mix
from scorebreath.engine.live.timing import LiveClock
from scorebreath.engine.moves import Move, buses, moves
from scorebreath.engine.onsets import Onset, onsets
from scorebreath.engine.segments import segments
from scorebreath.media.store import MemoryStore
from scorebreath.score.document import Score
from scorebreath.score.events import Cut, Event
from scorebreath_synthdefs.catalogue import MOVER
from tests.engine.sounding import babble, cut, inspiration, move, noise, score, utterance
from tests.engine.test_commands import bundles

RATE = 48000
STORE = MemoryStore()
SPOKEN = STORE.put(babble(0.5, 22050, 1), 22050, "speech")
Told = Counter[tuple[str, str, int]]


def offline(made: Score) -> Told:
    """What stands in the .osc file: kind, instrument, frame."""
    frames = round(made.duration * RATE)
    (segment,) = segments(onsets(made), moves=moves(made), frames=frames, sample_rate=RATE, length=1e6)
    stream = io.BytesIO()
    write_commands(stream, commands(segment, str, sample_rate=RATE, buses=buses(segment.moves)))
    clock = OfflineClock(sample_rate=RATE)
    found: Told = Counter()
    for tag, bundle in bundles(stream.getvalue()):
        for message in bundle.contents:
            assert isinstance(message, OscMessage)
            if message.address == "/s_new":
                name = str(message.contents[0])
                kind = ("move", "") if name == MOVER else ("sound", name)
                found[(*kind, clock.frame_of(tag))] += 1
            elif message.address == "/n_set":
                found["cut", "", clock.frame_of(tag)] += 1
    if moves(made):
        found["move", "", 0] -= 1  # the one that says what is in force at the beginning
    return +found


def live(made: Score, known: float) -> Told:
    """What is journalled when each event is made known so many seconds before it happens."""
    start = 1_900_000_000.0
    entries: list[Entry] = []
    now = [start - known]
    conductor = Conductor(
        clock=LiveClock(start=start, sample_rate=RATE), layout=own_layout(2), mix=Mix(), send=lambda tag, said: None,
        now=lambda: now[0], lookahead=0.15, journal=entries.append,
    )  # fmt: skip
    conductor.engine_began(own_layout(2), RATE)
    uncut = onsets(score([one for one in made.events if not isinstance(one, Cut)], made.duration, STORE))
    steps: list[tuple[float, Onset | Move | Cut]] = [(one.time, one) for one in uncut]
    steps += [(one.time, one) for one in moves(made)]
    steps += [(one.onset, one) for one in made.events if isinstance(one, Cut)]
    for time, step in sorted(steps, key=lambda one: one[0]):
        until(conductor, now, start + time - known)
        if isinstance(step, Cut):
            conductor.cut(step.onset, step.targets, step.fade)
        elif isinstance(step, Move):
            conductor.move(step.time, step.body, step.after, step.glide)
        else:
            conductor.play(Played(step))
    until(conductor, now, start + made.duration + 2)
    assert conductor.tally.late_sent == conductor.tally.lost == 0
    assert all(entry.late == 0 for entry in entries)
    taken_back = Counter((entry.event, entry.time) for entry in entries if entry.kind == "free")
    found: Told = Counter()
    for entry in entries:
        if entry.kind == "sound" and taken_back[entry.event, entry.time] > 0:
            taken_back[entry.event, entry.time] -= 1
        elif entry.kind != "free":
            found[entry.kind, entry.instrument, entry.frame] += 1
    return found


def until(conductor: Conductor, now: list[float], unix: float) -> None:
    while (following := conductor.pump(now[0])) is not None and following < unix:
        now[0] = max(now[0], following)
    now[0] = max(now[0], unix)


DRAWN = st.lists(st.tuples(st.booleans(), st.integers(400, 9000)), max_size=10, unique_by=lambda one: one[1])
CUTS = st.lists(st.tuples(st.integers(400, 9000), st.integers(0, 500)), max_size=3, unique_by=lambda one: one[0])
MOVES = st.lists(
    st.tuples(st.integers(400, 9000), st.integers(0, 900), st.floats(0, 4)), max_size=4, unique_by=lambda one: one[0]
)


@settings(deadline=None)
@given(DRAWN, CUTS, MOVES, st.sampled_from([0.75, 0.25, 0.1, 0.08]))
def test_frames_of_the_journal_are_those_of_the_file(
    drawn: list[tuple[bool, int]], cuts: list[tuple[int, int]], moved: list[tuple[int, int, float]], known: float
) -> None:
    """However short before it happens a thing is made known, as long as there is time."""
    events: list[Event] = [
        utterance(ms / 1000, SPOKEN, 0.5) if speech else inspiration(ms / 1000, noise(), nose=0.5)
        for speech, ms in drawn
    ]
    names = tuple(event.id for event in events)
    events += [cut(ms / 1000, *names, fade=fade / 1000) for ms, fade in cuts]
    events += [move(ms / 1000, glide / 1000, mouth=round(to, 3)) for ms, glide, to in moved]
    made = score(sorted(events, key=lambda event: event.onset), 12.0, STORE)
    assert live(made, known) == offline(made)
