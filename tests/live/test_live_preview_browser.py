"""The live preview in a browser, in real time: what is drawn is what was streamed, and nothing ends it for good."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from scorebreath.curves.curve_set import CurveSet, curves
from scorebreath.live.preview import open_preview, said_in
from scorebreath.live.streams.sender import Sender
from scorebreath.live.streams.websocket import PictureServer
from scorebreath.report.figure import CHANNELS
from tests.curves.scores import Breath, build
from tests.live.browsing import Page, browsing
from tests.live.test_live_preview import HOSTILE, spoken

pytestmark = pytest.mark.browser
NAMES = {"body": HOSTILE, "body2": "Grace"}
LIVE = "scorebreath.state === 'live' && scorebreath.bodies().length === %d && scorebreath.bodies().every(b => b.pose)"
FULL = 21.0
"""How far the chest of the drawing goes at 1, without gain."""

FRAMES = """(async () => {
  const frames = [], spread = () => {
    const values = frames.map(frame => frame[0].pose.thorax);
    return Math.max(...values) - Math.min(...values);
  };
  while (frames.length < 60 || spread() < .05) {
    await new Promise(requestAnimationFrame);
    frames.push(scorebreath.bodies().map(({body, time, between, pose}) => {
      const card = document.querySelector(`[data-body="${body}"]`);
      return {body, time, between, pose, torso: card.querySelector("[id$=torso]").getAttribute("d")};
    }));
  }
  return {frames, gain: scorebreath.gain};
})()"""


def expected(shown: CurveSet, drawn: dict[str, Any], rate: int) -> dict[str, float]:
    """What a straight line between the two pictures next to the time that was drawn gives."""
    exact = [round(each * rate) / rate for each in drawn["between"]]
    before, after = shown.sample(exact, CHANNELS)
    share = (drawn["time"] - drawn["between"][0]) / ((drawn["between"][1] - drawn["between"][0]) or 1.0)
    return dict(zip(CHANNELS, (before + share * (after - before)).tolist(), strict=True))


@pytest.fixture(scope="module")
def opened(chromium: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browsing(chromium, tmp_path_factory.mktemp("profile")) as page:
        yield page


@pytest.fixture
def page(opened: Page) -> Page:
    opened.go("data:text/html,")
    opened.complaints.clear()
    opened.requested.clear()
    return opened


@contextmanager
def playing(shown: Mapping[str, CurveSet], port: int = 0) -> Iterator[tuple[str, PictureServer]]:
    """A performance in real time, over and over: the page's address, and its server."""
    lasting, begin = spoken().duration, time.time()
    said = said_in(spoken())
    server, stream = open_preview(port, title=HOSTILE, said=lambda _, now: said("body", now))
    sender = Sender(
        lambda: shown, clock=lambda: (time.time() - begin) % lasting,
        start=lambda: begin + lasting * ((time.time() - begin) // lasting), streams=[stream], rate=60, names=NAMES,
    )  # fmt: skip
    sender.start()
    try:
        yield stream.target.name, server
    finally:
        sender.stop()


@pytest.fixture(scope="module")
def ada() -> CurveSet:
    return curves(spoken())


@pytest.fixture(scope="module")
def grace() -> CurveSet:
    return curves(build([Breath(speech=1.0, to_volume=0.7)] * 8))


def test_what_is_drawn_is_what_was_streamed(page: Page, ada: CurveSet, grace: CurveSet) -> None:
    shown = {"body": ada, "body2": grace}
    with playing(shown) as (address, _):
        page.go(address)
        page.until(LIVE % 2)
        told = page.ask(FRAMES)
    outlines: dict[str, set[str]] = {body: set() for body in shown}
    for frame in told["frames"]:
        assert [each["body"] for each in frame] == ["body", "body2"]
        for drawn in frame:
            body, pose = drawn["body"], drawn["pose"]
            assert pose == pytest.approx(expected(shown[body], drawn, 60), abs=2e-5), (body, drawn["time"])
            chest = FULL * pose["thorax"] * told["gain"]
            numbers = [float(each) for each in drawn["torso"].split() if each[-1].isdigit()]
            points = list(pairwise(numbers))
            nearest = min(abs(x - 250 - chest) + abs(y - 322 + 0.3 * chest) for x, y in points)
            assert nearest < 0.02, "the chest does not stand out as far as the curve says"
            outlines[body].add(drawn["torso"])
    assert all(len(found) > 5 for found in outlines.values()), "the figure stands still"
    assert not outlines["body"] & outlines["body2"]
    assert page.complaints == []


def test_between_two_pictures_the_figure_goes_on(page: Page, ada: CurveSet) -> None:
    """At ten pictures a second it is drawn at times that no picture has, and stands where the curve is."""
    begin = time.time()
    _, stream = open_preview()
    sender = Sender(lambda: {"body": ada}, clock=lambda: time.time() - begin, start=begin, streams=[stream], rate=10)
    sender.start()
    try:
        page.go(f"{stream.target.name}?delay=0.5")
        page.until(LIVE % 1)
        told = page.ask(FRAMES)
    finally:
        sender.stop()
    drawn = [frame[0] for frame in told["frames"]]
    between = [each for each in drawn if each["between"][0] < each["time"] < each["between"][1]]
    assert len(between) > 10, "it stands still from picture to picture"
    for each in between:
        assert each["pose"] == pytest.approx(expected(ada, each, 10), abs=2e-5)


def test_names_and_words_are_only_text(page: Page, ada: CurveSet, grace: CurveSet) -> None:
    with playing({"body": ada, "body2": grace}) as (address, server):
        page.go(address)
        page.until(LIVE % 2)
        heads = "Array.from(document.querySelectorAll('.card h2'), each => each.textContent)"
        assert page.ask(heads) == [HOSTILE, "Grace"]
        assert page.ask("document.title === document.querySelector('h1').textContent")
        assert page.ask("document.title") != "taken"
        assert page.ask("document.querySelectorAll('b').length + document.scripts.length") == 1
        page.until("document.querySelector('.said .now').textContent !== ''")
        text, word = page.ask("['.said', '.now'].map(name => document.querySelector(name).textContent)")
        assert text in [group.text for group in spoken().groups] and word in text
        telling = {"text": HOSTILE + "𝄞 and more", "word": [len(HOSTILE), len(HOSTILE) + 1]}
        page.ask(f"say(cards.get('body'), {json.dumps(telling)})")
        parts = "Array.from(document.querySelectorAll('.said')[0].children, each => each.textContent)"
        assert page.ask(f"say(cards.get('body'), {json.dumps(telling)}), {parts}") == [HOSTILE, "𝄞", " and more"]
    host = f"//127.0.0.1:{server.port}/"
    assert page.complaints == []
    assert page.requested and all(host in each or each.startswith("data:") for each in page.requested)


def test_it_comes_back_when_the_server_does(page: Page, ada: CurveSet, grace: CurveSet) -> None:
    with playing({"body": ada}) as (address, server):
        page.go(address)
        page.until(LIVE % 1)
        port = server.port
    page.until("scorebreath.state === 'lost' && document.getElementById('state').textContent.includes('trying again')")
    assert page.ask("getComputedStyle(document.querySelector('.card')).filter") != "none", "it looks alive"
    unix = page.ask("scorebreath.bodies()[0].unix")
    with playing({"body": ada, "body2": grace}, port) as _:
        page.until(LIVE % 2)
        page.until(f"scorebreath.bodies().every(each => each.unix > {unix})")
        before = page.ask("scorebreath.bodies()[0].time")
        page.until(f"scorebreath.bodies()[0].time !== {before}")
    refused = [each for each in page.complaints if "WebSocket" not in each]
    assert refused == [], "only that nobody was there is said"


def test_a_body_that_left_leaves_the_stage(page: Page, ada: CurveSet, grace: CurveSet) -> None:
    shown = {"body": ada, "body2": grace}
    with playing(shown) as (address, _):
        page.go(address)
        page.until(LIVE % 2)
        del shown["body2"]
        later = "{const old = performance.now.bind(performance); performance.now = () => old() + %d;}"
        page.ask(later % 3000)
        page.until("document.querySelectorAll('.card.gone').length === 1")
        page.ask(later % 9000)
        page.until(LIVE % 1)
        assert page.ask("document.querySelectorAll('.card').length") == 1
        shown.clear()
        page.until("scorebreath.state === 'waiting'")
        shown["body2"] = grace
        page.until("scorebreath.bodies().some(each => each.body === 'body2' && each.pose)")
    assert page.complaints == []


def test_one_body_alone_can_be_asked_for(page: Page, ada: CurveSet, grace: CurveSet) -> None:
    with playing({"body": ada, "body2": grace}) as (address, _):
        page.go(f"{address}?body=body2&delay=9")
        page.until(LIVE % 1)
        assert page.ask("scorebreath.bodies().map(each => each.body)") == ["body2"]
        assert page.ask("scorebreath.delay") == 2.0
        page.go(f"{address}?delay=never")
        assert page.ask("scorebreath.delay") == 0.05


RUBBISH = (
    "", "null", "[]", "{", "7", '"x"', '{"schema":"scorebreath.picture/1"}',
    '{"schema":"scorebreath.picture/2","body":"body","unix":1,"time":1,"channels":{}}',
    '{"schema":"scorebreath.picture/1","body":{"a":1},"unix":1,"time":1,"channels":{}}',
    '{"schema":"scorebreath.picture/1","body":"body","unix":"now","time":1,"channels":{}}',
)  # fmt: skip


def test_what_is_no_picture_is_left_alone(page: Page) -> None:
    server, stream = open_preview()
    try:
        page.go(stream.target.name)
        page.until("scorebreath.state === 'waiting'")
        assert page.ask(f"{json.dumps(RUBBISH)}.map(understood)") == [None] * len(RUBBISH)
        sparse = {"schema": "scorebreath.picture/1", "body": "odd", "unix": time.time(), "time": 0, "said": [1],
                  "channels": {"thorax": "wide", "lung_volume": 0.5}}  # fmt: skip
        page.ask("window.seen = 0; addEventListener('error', () => { seen += 1; })")
        for rubbish in RUBBISH:
            server.publish("body", rubbish)
        server.publish("odd", json.dumps(sparse))
        page.until(LIVE % 1)
        pose = page.ask("scorebreath.bodies()[0].pose")
        assert (pose["thorax"], pose["lung_volume"], pose["speech_level"]) == (0, 0.5, -80)
        assert page.ask("document.querySelectorAll('.card').length + seen") == 1
    finally:
        stream.target.close()


@pytest.fixture
def quiet(page: Page) -> Iterator[Page]:
    """A page that hears nothing, for its functions."""
    _, stream = open_preview()
    try:
        page.go(stream.target.name)
        yield page
    finally:
        stream.target.close()


def clocked(page: Page, heard: list[tuple[float, float]], asked: list[float], delay: float = 0.05) -> list[float]:
    """What the page's clock shows at wall times, having heard of pictures at wall times, by their Unix times."""
    script = """((heard, asked) => {
      let wall = 0;
      const clock = makeClock(%g, () => wall), told = [];
      for (const [at, unix] of [...heard.map(([a, b]) => [a, b]), ...asked.map(a => [a, null])].sort((a, b) => a[0] - b[0])) {
        wall = at;
        if (unix === null) told.push(clock.now()); else clock.heard(unix);
      }
      return told;
    })(%s, %s)"""  # noqa: E501
    found: list[float] = page.ask(script % (delay, json.dumps(heard), json.dumps(asked)))
    return found


@pytest.mark.parametrize(
    ("early", "lag"),
    [(0.0, 0.0), (-0.02, 0.02), (0.5, 0.0), (5.0, 0.0), (3600.0, -3600.0), (-3600.0, 3600.0)],
    ids=["on time", "late", "sent ahead", "sent far ahead", "a clock ahead", "a clock behind"],
)
def test_pictures_are_shown_when_they_are_heard(quiet: Page, early: float, lag: float) -> None:
    heard = [(1000 + i / 60, 1000 + i / 60 + early) for i in range(600)]
    shown = clocked(quiet, heard, [1005.005, 1009.005])
    assert shown == pytest.approx([1005.005 - lag - 0.05, 1009.005 - lag - 0.05], abs=1e-6)


def test_late_pictures_slow_the_clock_down_and_never_turn_it_back(quiet: Page) -> None:
    late = [(1000 + i / 60, 1000 + i / 60 - (0.0 if i < 300 else 0.3)) for i in range(1200)]
    asked = [1000 + i / 50 for i in range(1, 1000)]
    shown = clocked(quiet, late, asked)
    steps = np.diff(shown)
    assert steps.min() >= 0.9 / 50 - 1e-6 and steps.max() <= 1.1 / 50 + 1e-6
    assert asked[0] - shown[0] == pytest.approx(0.05, abs=1e-6)
    assert asked[-1] - shown[-1] == pytest.approx(0.35, abs=1e-6)


def rowed(page: Page, pictures: list[tuple[float, float, float]], asked: list[float]) -> list[Any]:
    """Time and thorax that are shown at Unix times, of pictures with unix, time and thorax."""
    script = """((pictures, asked) => {
      const row = makeRow(), still = Object.fromEntries(CHANNELS.map(name => [name, 0]));
      for (const [unix, time, thorax] of pictures) row.add({unix, time, pose: {...still, thorax}});
      return asked.map(unix => { const shown = row.at(unix); return shown && [shown.time, shown.pose.thorax]; });
    })(%s, %s)"""
    found: list[Any] = page.ask(script % (json.dumps(pictures), json.dumps(asked)))
    return found


def test_a_row_of_pictures_is_a_line_without_guesses(quiet: Page) -> None:
    row = [(10.0, 0.0, 0.0), (10.1, 0.1, 1.0), (10.2, 0.2, 0.0), (10.6, 0.6, 1.0), (10.7, 5.0, 0.0)]
    asked = [9.9, 10.0, 10.05, 10.125, 10.2, 10.5, 10.6, 10.65, 10.7, 99.0]
    expected = [None, (0, 0), (0.05, 0.5), (0.125, 0.75), (0.2, 0), (0.2, 0), (0.6, 1), (0.6, 1), (5, 0), (5, 0)]
    for found, wanted in zip(rowed(quiet, row, asked), expected, strict=True):
        assert (found is None) == (wanted is None)
        assert wanted is None or found == pytest.approx(list(wanted), abs=1e-9)


def test_pictures_sent_ahead_are_replaced_by_those_of_another_place(quiet: Page) -> None:
    ahead = [(10 + i / 10, i / 10, 0.0) for i in range(10)]
    behind = [(10.35 + i / 10, 7 + i / 10, 1.0) for i in range(3)]
    shown = rowed(quiet, ahead + behind, [10.2, 10.33, 10.4, 10.9])
    assert shown == [pytest.approx(each) for each in ([0.2, 0], [0.3, 0], [7.05, 1], [7.2, 1])]


def test_what_nobody_looks_at_does_not_pile_up(quiet: Page) -> None:
    many = [(i / 60, i / 60, 1.0) for i in range(20_000)]
    assert rowed(quiet, many, [0.0, 20_000 / 60]) == [None, pytest.approx([19_999 / 60, 1])]
