"""Which bundles an engine gets when, in simulated time."""

from __future__ import annotations

import dataclasses
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.engine.clock import OfflineClock
from scorebreath.engine.live.conductor import MARGIN, Conductor, Played
from scorebreath.engine.live.journal import Entry
from scorebreath.engine.live.layout import own_layout
from scorebreath.engine.live.link import read_message
from scorebreath.engine.live.orders import Mix
from scorebreath.engine.live.timing import AT_ONCE, EPOCH, SECOND, LiveClock
from scorebreath.engine.onsets import Onset
from scorebreath.engine.osc import Argument
from scorebreath.engine.play import KEEP
from scorebreath.score.performing import Heard
from scorebreath_synthdefs import SPEECH
from scorebreath_synthdefs.catalogue import MOVER

START, RATE, LOOKAHEAD = 1_900_000_000.25, 48000, 0.15
BREATH = "scorebreath_mouth_male"
Told = tuple[float, float, str, tuple[Argument, ...]]


class Engine:
    """Stands for an engine: remembers what it is told, at which simulated time, and for when."""

    def __init__(self, **settings: object) -> None:
        self.told: list[Told] = []
        self.now = START
        self.entries: list[Entry] = []
        self.dropped: list[Played] = []
        self.lost: list[str] = []
        self.conductor = Conductor(
            clock=LiveClock(start=START, sample_rate=RATE), layout=own_layout(2), mix=Mix(), send=self.take,
            now=lambda: self.now,
            lookahead=LOOKAHEAD, journal=self.entries.append, dropped=self.dropped.append,
            lost=lambda sound: self.lost.append(sound.event),
        )  # fmt: skip
        self.conductor.engine_began(own_layout(2), RATE)

    def take(self, tag: int, messages: object) -> None:
        assert isinstance(messages, list | tuple)
        when = math.nan if tag == AT_ONCE else tag / SECOND - EPOCH - START
        for datagram in messages:
            read = read_message(datagram)
            assert read is not None
            self.told.append((self.now - START, when, *read))

    def until(self, time: float) -> None:
        """Let time pass, waking only when the conductor asks to be woken."""
        while (following := self.conductor.pump(self.now)) is not None and following <= START + time:
            self.now = max(self.now, following)
        self.now = max(self.now, START + time)

    def of(self, address: str, name: str = "") -> list[Told]:
        return [one for one in self.told if one[2] == address and (not name or one[3][0] == name)]


def sound(time: float, length: float = 0.5, event: str = "e", instrument: str = BREATH) -> Played:
    controls = {"seed": 3.0} if instrument == BREATH else {}
    return Played(Onset(time=time, duration=length, instrument=instrument, controls=controls, event=event, body="b"))


def settings(told: Told, skip: int) -> dict[object, object]:
    return dict(zip(told[3][skip::2], told[3][skip + 1 :: 2], strict=True))


def test_sounds_are_sent_just_before_their_time_on_their_frame() -> None:
    engine = Engine()
    for time in (1.0, 2.000013, 0.5):
        engine.conductor.play(sound(time))
    engine.until(3.0)
    found = engine.of("/s_new", BREATH)
    assert [when for _, when, *_ in found] == pytest.approx([0.5, 1.0, 2.000013], abs=1 / RATE)
    assert [when - at for at, when, *_ in found] == pytest.approx([LOOKAHEAD] * 3, abs=1 / RATE)
    assert [entry.frame for entry in engine.entries] == [24000, 48000, 96001]
    assert engine.conductor.tally.sent == 3
    assert engine.conductor.tally.lead_min == pytest.approx(LOOKAHEAD)


def test_a_move_that_is_told_shortly_before_its_time_is_no_lead_of_sounds() -> None:
    engine = Engine()
    engine.conductor.play(sound(1.0))
    engine.until(2.0)
    engine.conductor.move(2.06, "b", Heard(mouth=2.0), 0.1)
    engine.until(4.0)
    tally = engine.conductor.tally
    assert (tally.sent, tally.late_sent) == (2, 0)
    assert (tally.lead_min, tally.lead_mean) == pytest.approx((LOOKAHEAD, LOOKAHEAD))


@given(st.lists(st.floats(0, 3000), max_size=20))
def test_tags_lie_on_the_frames_of_an_offline_run(times: list[float]) -> None:
    live, offline = LiveClock(start=START, sample_rate=RATE), OfflineClock(sample_rate=RATE)
    for time in times:
        since = (live.tag(time) - live.start_tag) / SECOND
        assert since == pytest.approx((live.frame(time) + 0.25) / RATE, abs=1e-8)
        assert abs(since - offline(time)) * RATE < 2.0  # which drops parts of a frame in an hour
        assert offline.frame_of(int(offline(time) * SECOND)) == live.frame(time)


def test_what_comes_too_late() -> None:
    """Speech is said all the same, late; breaths are not heard; nothing is for the past."""
    engine = Engine()
    engine.until(2.0)
    engine.conductor.play(sound(1.9, 0.5, "breath"))
    engine.conductor.play(sound(1.9, 0.5, "said", SPEECH))
    engine.conductor.play(sound(1.0, 0.5, "over", SPEECH))
    engine.conductor.move(1.5, "b", Heard(mouth=2.0), 0.1)
    engine.until(4.0)
    (said,) = engine.of("/s_new", SPEECH)
    assert said[1] == pytest.approx(2.0 + MARGIN, abs=1 / RATE)
    assert not engine.of("/s_new", BREATH)
    (moved,) = engine.of("/s_new", MOVER)
    assert moved[1] == pytest.approx(2.0 + MARGIN, abs=1 / RATE)
    assert (engine.conductor.tally.lost, engine.conductor.tally.late_sent) == (2, 2)
    assert sorted(engine.lost) == ["breath", "over"]
    assert [entry.late for entry in engine.entries if entry.kind == "sound"] == pytest.approx([0.1 + MARGIN])
    assert len(engine.dropped) == 3


def test_a_cut_ends_what_sounds_and_prevents_what_waits() -> None:
    engine = Engine()
    for time, event in ((1.0, "a"), (1.4, "b"), (1.2, "c")):
        engine.conductor.play(sound(time, 2.0, event))
    engine.until(1.1)  # c is sent and has not begun, b waits
    engine.conductor.cut(1.2, ["a", "b", "c", "nobody"], 0.1)
    engine.conductor.play(sound(1.3, 0.5, "a"))
    engine.until(6.0)
    first, third = engine.of("/s_new", BREATH)
    (ended,) = engine.of("/n_set")
    assert ended[3][0] == first[3][1]
    assert settings(ended, 1) == {"cut": pytest.approx(0.2), "fade": pytest.approx(0.1)}
    assert ended[0] < ended[1] < 1.2
    (freed,) = engine.of("/n_free")
    assert (freed[1], freed[3]) == (third[1], (third[3][1],))  # at the very tag at which it would begin
    assert [entry.kind for entry in engine.entries] == ["sound", "sound", "free", "cut"]
    assert not engine.conductor.here


def test_a_cut_that_comes_too_late_ends_it_now() -> None:
    engine = Engine()
    engine.conductor.play(sound(1.0, 3.0, "a"))
    engine.until(2.0)
    engine.conductor.cut(1.5, ["a"], 0.1)
    engine.until(2.5)
    (ended,) = engine.of("/n_set")
    assert ended[1] == pytest.approx(2.0 + MARGIN, abs=1e-4)
    assert settings(ended, 1)["cut"] == pytest.approx(1.0 + MARGIN + 0.01)
    assert engine.conductor.tally.late_sent == 1


def test_panic_is_silence_at_once() -> None:
    engine = Engine()
    engine.conductor.play(sound(1.0, 3.0, "a"))
    engine.conductor.play(sound(1.3, 3.0, "b"))
    engine.conductor.play(sound(2.0, 3.0, "c"))
    engine.until(1.2)
    engine.conductor.panic()
    engine.until(9.0)
    assert len(engine.of("/s_new", BREATH)) == 2
    (all_freed,) = engine.of("/g_freeAll")
    assert math.isnan(all_freed[1])
    (freed,) = engine.of("/n_free")
    assert freed[1] == pytest.approx(1.3, abs=1 / RATE)
    assert not engine.conductor.here
    assert engine.conductor.waiting == 0


def test_a_hush_fades_what_sounds_and_drops_the_rest() -> None:
    """And what comes later under the same name is heard."""
    engine = Engine()
    for time, event in ((1.0, "a"), (1.3, "b"), (2.0, "c")):
        engine.conductor.play(sound(time, 3.0, event))
    engine.until(1.2)
    engine.conductor.hush(0.1)
    engine.until(3.0)
    engine.conductor.play(sound(4.0, 0.5, "c"))
    engine.until(9.0)
    (ended,) = engine.of("/n_set")
    assert settings(ended, 1) == {"cut": pytest.approx(0.25), "fade": pytest.approx(0.1)}
    (freed,) = engine.of("/n_free")
    assert freed[1] == pytest.approx(1.3, abs=1 / RATE)
    assert [when for _, when, *_ in engine.of("/s_new", BREATH)] == pytest.approx([1.0, 1.3, 4.0], abs=1 / RATE)


def test_an_engine_that_dies_and_comes_back() -> None:
    """What had not begun begins; what sounded and what came due meanwhile is lost; ratios are as they were."""
    engine = Engine()
    engine.conductor.move(0.5, "b", Heard(mouth=0.5), 0.1)
    for time, event in ((1.0, "sounding"), (1.3, "sent"), (1.6, "in the hole"), (2.5, "later")):
        engine.conductor.play(sound(time, 0.5, event))
    engine.until(1.2)
    engine.conductor.engine_ended(engine.now)
    told = len(engine.told)
    engine.until(1.8)
    assert len(engine.told) == told
    engine.conductor.engine_began(own_layout(2), RATE)
    engine.until(5.0)
    again = [one for one in engine.told[told:] if one[2] == "/s_new" and one[3][0] == BREATH]
    assert [when for _, when, *_ in again] == pytest.approx([2.5], abs=1 / RATE)
    (ratios,) = [one[3] for one in engine.told[told:] if one[2] == "/c_setn"]
    assert ratios[2:] == (1.0, 0.5, 1.0, 1.0)
    assert engine.conductor.tally.lost == 3
    assert len(engine.dropped) == 4


def test_what_was_sent_but_had_not_begun_is_sent_again() -> None:
    engine = Engine()
    engine.conductor.play(sound(1.0))
    engine.until(0.9)
    engine.conductor.engine_ended(engine.now)
    engine.conductor.engine_began(own_layout(2), RATE)
    engine.until(2.0)
    assert [when for _, when, *_ in engine.of("/s_new", BREATH)] == pytest.approx([1.0, 1.0], abs=1 / RATE)
    assert engine.conductor.tally.lost == 0


def test_a_pan_holds_for_whoever_comes_later() -> None:
    engine = Engine()
    engine.conductor.pan("b", -0.5)
    places = engine.of("/s_new", "scorebreath_place")
    assert settings(places[0], 4)["out"] == 2.0
    (panned,) = engine.of("/n_set")
    assert settings(panned, 1) == {"pan": -0.5}
    engine.conductor.engine_ended(engine.now)
    engine.conductor.engine_began(own_layout(2), RATE)
    assert settings(engine.of("/s_new", "scorebreath_place")[-1], 4)["pan"] == -0.5


DRAWN = st.lists(
    st.tuples(st.sampled_from(["play", "say", "cut", "move", "wait", "panic", "die", "return"]), st.floats(-0.5, 3.0),
              st.integers(0, 4)),
    max_size=40,
)  # fmt: skip


@given(DRAWN)
def test_nothing_is_ever_sent_for_the_past_and_nothing_is_forgotten(drawn: list[tuple[str, float, int]]) -> None:
    engine = Engine()
    given_sounds = 0
    for what, span, number in drawn:
        now = engine.now - START
        if what in {"play", "say"}:
            given_sounds += 1
            instrument = SPEECH if what == "say" else BREATH
            engine.conductor.play(sound(max(0.0, now + span), 0.7, f"e{number}", instrument))
        elif what == "cut":
            engine.conductor.cut(max(0.0, now + span), [f"e{number}"], 0.05)
        elif what == "move":
            engine.conductor.move(max(0.0, now + span), "b", Heard(mouth=float(number)), 0.2)
        elif what == "panic":
            engine.conductor.panic()
        elif what == "die" and engine.conductor.alive:
            engine.conductor.engine_ended(engine.now)
        elif what == "return" and not engine.conductor.alive:
            engine.conductor.engine_began(own_layout(2), RATE)
        else:
            engine.until(now + abs(span))
    engine.until(engine.now - START + 10)
    timed = [(at, when) for at, when, *_ in engine.told if not math.isnan(when)]
    assert all(when >= at + MARGIN - 1.1 / RATE for at, when in timed)
    assert len(engine.dropped) == given_sounds
    assert engine.conductor.waiting == 0
    nodes = [one[3][1] for one in engine.of("/s_new") if one[3][0] in {BREATH, SPEECH}]
    assert len(nodes) == len(set(nodes))
    freed = [one[3][0] for one in (*engine.of("/n_free"), *engine.of("/n_set"))]
    assert set(freed) <= set(nodes)


def test_a_sound_is_kept_until_it_is_surely_over() -> None:
    engine = Engine()
    played = sound(1.0, 0.5)
    engine.conductor.play(played)
    engine.until(1.5 + KEEP - 0.01)
    assert engine.dropped == []
    engine.until(1.5 + KEEP + 0.01)
    assert engine.dropped == [played]


def test_an_entry_is_a_line_of_json() -> None:
    engine = Engine()
    engine.conductor.play(sound(1.0))
    engine.until(1.0)
    (entry,) = engine.entries
    line = dataclasses.replace(entry, lead=0.15).line()
    tag = f"{LiveClock(start=START, sample_rate=RATE).tag(1.0):016x}"
    assert line == (
        '{"kind": "sound", "event": "e", "instrument": "scorebreath_mouth_male", "time": 1.0, "frame": 48000, '
        f'"tag": "{tag}", "lead": 0.15, "late": 0.0}}'
    )
