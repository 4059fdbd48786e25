"""The hub: exact times, no bursts, and no target that disturbs another."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from websockets.sync.client import ClientConnection, connect

from scorebreath.curves.curve_set import CurveSet, curves
from scorebreath.curves.rigs.table import rig_named
from scorebreath.errors import InputError
from scorebreath.live.picture import Picture, Stream
from scorebreath.live.streams.addresses import open_stream
from scorebreath.live.streams.lines import LineTarget
from scorebreath.live.streams.livelink import packet
from scorebreath.live.streams.sender import AHEAD, LONGEST_WAIT, SAID_AGAIN, Sender
from scorebreath.live.streams.websocket import PictureServer, WebSocketTarget
from tests.curves.faces import only
from tests.live.pictures import START, named, picture, whole
from tests.live.sockets import port, receiver

BODIES = {"body": whole(), "body2": named("body2")}


@contextmanager
def serving() -> Iterator[tuple[PictureServer, ClientConnection]]:
    """A WebSocket server and somebody who listens."""
    server = PictureServer(port=0)
    try:
        with connect(f"ws://127.0.0.1:{server.port}", open_timeout=20, max_queue=None) as listening:
            yield server, listening
    finally:
        server.close()


@dataclass
class Keeper:
    """A target that keeps what it gets, or fails while it is told to."""

    name: str = "keeper"
    got: list[Picture] = field(default_factory=list)
    tried: int = 0
    fails: Exception | None = None
    closed: int = 0

    def send(self, picture: Picture) -> None:
        self.tried += 1
        if self.fails is not None:
            raise self.fails
        self.got.append(picture)

    def close(self) -> None:
        self.closed += 1
        if self.fails is not None:
            raise self.fails


def sender(*streams: Stream, bodies: Mapping[str, CurveSet] | None = None, **options: Any) -> Sender:
    return Sender(
        lambda: {"body": whole()} if bodies is None else bodies, lambda: 0.0, START, streams, **options
    )  # fmt: skip


def numbers(keeper: Keeper) -> list[int]:
    return [picture.number for picture in keeper.got]


@pytest.mark.parametrize("rate", [24, 60, 90, Fraction(30000, 1001), 29.97])
def test_what_is_streamed_is_what_is_sampled_offline(rate: Fraction | float) -> None:
    keeper = Keeper()
    hub = sender(Stream(target=keeper), rate=rate)
    for step in range(2000):
        hub.tick(step * 0.00137)
    exact = Fraction(rate).limit_denominator(1_000_000)
    times = np.arange(len(keeper.got)) * exact.denominator / exact.numerator
    assert [picture.time for picture in keeper.got] == times.tolist()
    assert len(times) == int(1999 * 0.00137 * float(rate)) + 1
    offline = whole().sample(times)
    assert np.array_equal([list(picture.channels.values()) for picture in keeper.got], offline)
    rig = rig_named("arkit")
    shown = [list(picture.rig("arkit").values()) for picture in keeper.got[:20]]
    assert np.array_equal(shown, rig.sample(whole(), times[:20]))


@given(steps=st.lists(st.floats(0, 0.2), max_size=60), rate=st.sampled_from([10.0, 30.0, 59.94, 60.0]))
@settings(deadline=None, max_examples=50)
def test_a_clock_that_stumbles_costs_pictures_and_never_makes_a_burst(steps: list[float], rate: float) -> None:
    keeper = Keeper()
    hub, now = sender(Stream(target=keeper), rate=rate), 0.0
    sent = hub.tick(0.0)
    for step in steps:
        now += step
        count = hub.tick(now)
        assert count in (0, 1)
        sent += count
        assert keeper.got[-1].time <= now < hub.time(keeper.got[-1].number + 1)
    (count_of,) = hub.counts
    found = numbers(keeper)
    assert found == sorted(set(found)) and sent == len(found) == count_of.sent
    assert count_of.skipped == found[-1] + 1 - len(found)


def test_pictures_go_when_they_are_heard_or_earlier_by_the_lead() -> None:
    plain, early = Keeper(), Keeper()
    late = sender(Stream(target=plain), rate=10, latency=0.25)
    soon = sender(Stream(target=early), rate=10, latency=0.25, lead=0.375)
    for step in range(20):
        late.tick(step / 20)
        soon.tick(step / 20)
    assert plain.got[-1].time == 0.7 and early.got[-1].time == 1.0
    assert numbers(plain)[0] == 0 and numbers(early)[0] == 1
    assert [picture.unix - picture.time for picture in plain.got] == pytest.approx([START + 0.25] * len(plain.got))


def test_nothing_is_sent_before_the_performance() -> None:
    keeper = Keeper()
    hub = sender(Stream(target=keeper))
    assert hub.tick(-0.5) == 0 == hub.tick(-0.001) and hub.tick(0.0) == 1


@pytest.mark.parametrize("rate", [7, 24, 25, 30, 60, 100])
def test_a_target_may_have_fewer_pictures(rate: int) -> None:
    all_of_them, fewer = Keeper(), Keeper()
    hub = sender(Stream(target=all_of_them), Stream(target=fewer, rate=rate))
    for number in range(601):
        hub.tick(hub.time(number))
    assert len(all_of_them.got) == 601 and len(fewer.got) == min(rate, 60) * 10 + 1
    gaps = np.diff(numbers(fewer))
    assert gaps.max() - gaps.min() <= 1
    assert [count.skipped for count in hub.counts] == [0, 0]


def test_bodies_go_where_they_are_wanted_under_their_names() -> None:
    everybody, first, second, nobody = Keeper(), Keeper(), Keeper(), Keeper()
    hub = sender(
        Stream(target=everybody), Stream(target=first, body=""), Stream(target=second, body="body2"),
        Stream(target=nobody, body="body3"), bodies=BODIES, names={"body2": "Ada"},
    )  # fmt: skip
    assert hub.tick(0.0) == 4
    assert [(each.body, each.name) for each in everybody.got] == [("body", "scorebreath"), ("body2", "Ada")]
    assert [each.body for each in first.got + second.got] == ["body", "body2"] and not nobody.got
    assert sender(Stream(target=everybody), bodies=BODIES).tick(0.0) == 2
    assert everybody.got[-1].name == "scorebreath-body2"


@pytest.mark.parametrize("error", [OSError(101, "Network is unreachable"), ValueError("a bug of its own")])
def test_a_target_in_trouble_is_said_once_spared_and_tried_again(error: Exception) -> None:
    said: list[tuple[str, str]] = []
    good, bad = Keeper("good"), Keeper("bad", fails=error)
    hub = sender(Stream(target=bad), Stream(target=good), on_trouble=lambda name, what: said.append((name, what)))
    for number in range(400):
        hub.tick(hub.time(number))
    assert len(said) == 1 and said[0][0] == "bad" and str(error) in said[0][1]
    assert numbers(good) == list(range(400))
    failed, spared = hub.counts[0].failed, hub.counts[0].skipped
    assert bad.tried == failed and failed + spared == 400
    assert 400 / LONGEST_WAIT < failed < 20
    bad.fails = None
    for number in range(400, 400 + LONGEST_WAIT + 60):
        hub.tick(hub.time(number))
    assert numbers(bad) == list(range(bad.got[0].number, 400 + LONGEST_WAIT + 60))
    assert bad.got[0].number <= 400 + LONGEST_WAIT and len(said) == 1


def test_a_target_that_comes_and_goes_is_not_said_again_and_again() -> None:
    said: list[str] = []
    shaky = Keeper()
    hub = sender(Stream(target=shaky), on_trouble=lambda name, what: said.append(what))
    for number in range(SAID_AGAIN * 2 + 100):
        shaky.fails = OSError("full") if number % 10 < 2 else None
        hub.tick(hub.time(number))
    assert 2 <= len(said) <= 3


def test_a_jump_of_the_clock_goes_on_from_there() -> None:
    keeper = Keeper()
    hub = sender(Stream(target=keeper), rate=10)
    for now in (5.0, 5.1, 5.05, 5.2, 1.0, 1.1):
        hub.tick(now)
    assert numbers(keeper) == [50, 51, 52, 10, 11] and hub.counts[0].skipped == 0


def test_curves_that_cannot_be_had_are_said_once_and_asked_for_again() -> None:
    said: list[tuple[str, str]] = []
    given: list[Mapping[str, CurveSet]] = []

    def had() -> Mapping[str, CurveSet]:
        return given[0]

    keeper = Keeper()
    hub = Sender(
        had,
        lambda: 0.0,
        lambda: START,
        [Stream(target=keeper)],
        on_trouble=lambda name, what: said.append((name, what)),
    )
    assert [hub.tick(number / 60) for number in range(3)] == [0, 0, 0]
    assert len(said) == 1 and said[0][0] == "curves"
    given.append(BODIES)
    assert hub.tick(1.0) == 2


@pytest.mark.parametrize("options", [{"rate": 0.0}, {"rate": 1001}, {"lead": 6.0}, {"lead": float("nan")}])
def test_wrong_numbers_are_refused(options: dict[str, float]) -> None:
    with pytest.raises(InputError):
        sender(Stream(target=Keeper()), bodies=BODIES, **options)


@pytest.mark.parametrize("rate", [0.0, -1.0, float("nan"), 2000.0])
def test_wrong_rates_of_targets_are_refused(rate: float) -> None:
    with pytest.raises(InputError, match="keeper: rate="):
        sender(Stream(target=Keeper(), rate=rate))


def test_the_thread_sends_and_closes_everything() -> None:
    reached = threading.Event()
    now = [0.0]

    def clock() -> float:
        now[0] += 0.01
        return now[0]

    class Waiter(Keeper):
        def send(self, picture: Picture) -> None:
            super().send(picture)
            if len(self.got) >= 20:
                reached.set()

    said: list[str] = []
    waiter, broken = Waiter(), Keeper("broken", fails=OSError("gone"))
    trouble: Callable[[str, str], None] = lambda name, what: said.append(f"{name}: {what}")  # noqa: E731
    hub = Sender(
        lambda: BODIES, clock, START, [Stream(target=broken), Stream(target=waiter, body="body")], on_trouble=trouble
    )
    hub.start()
    with pytest.raises(InputError, match="once"):
        hub.start()
    assert reached.wait(30.0)
    hub.stop()
    seen = len(waiter.got)
    assert numbers(waiter) == sorted(set(numbers(waiter)))
    assert waiter.closed == 1 == broken.closed
    assert said == ["broken: gone", "broken: cannot be closed: gone"]
    assert len(waiter.got) == seen == hub.counts[1].sent


def test_curves_that_change_are_shown_at_once() -> None:
    keeper = Keeper()
    still = curves(only())
    shown = {"body": still}
    hub = sender(Stream(target=keeper), bodies=shown)
    for number in range(40):
        shown["body"] = (still, whole())[number % 7 == 3 or number > 20]
        hub.tick(hub.time(number))
    for number, shot in enumerate(keeper.got):
        valid = whole() if number % 7 == 3 or number > 20 else still
        assert list(shot.channels.values()) == valid.sample([number / 60])[0].tolist()
        assert list(shot.rig("oculus").values()) == rig_named("oculus").sample(valid, [number / 60])[0].tolist()
    assert len(keeper.got) == 40


def test_curves_that_stay_are_worked_out_ahead() -> None:
    keeper = Keeper()
    hub = sender(Stream(target=keeper))
    for number in range(41):
        hub.tick(hub.time(number))
    assert len({id(picture.strip) for picture in keeper.got}) == 1 + 40 // AHEAD


def test_receivers_that_go_away_in_the_middle_disturb_nobody() -> None:
    said: list[str] = []
    read, write = os.pipe()
    pipe = LineTarget("pipe", os.fdopen(write, "wb", buffering=0))
    with receiver() as stays, receiver() as goes, serving() as (server, listening):
        streams = [
            Stream(target=pipe),
            open_stream(f"vmc://127.0.0.1:{port(goes)}"),
            Stream(target=WebSocketTarget("ws", server)),
            open_stream(f"livelink://127.0.0.1:{port(stays)}"),
        ]
        hub = sender(*streams, on_trouble=lambda name, what: said.append(name))
        for number in range(200):
            if number == 50:
                os.close(read)
                goes.close()
                listening.close()
            hub.tick(hub.time(number))
            assert stays.recv(2000)[1:] == packet(picture(number / 60))[1:]
        hub.stop()
    assert said == ["pipe"]
    assert [count.sent for count in hub.counts[1:]] == [200] * 3 and 0 < hub.counts[0].sent < 200
