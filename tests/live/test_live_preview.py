"""The live preview: what its server serves, and which words go with a picture."""

from __future__ import annotations

import dataclasses
import json
import re
import urllib.request
from functools import cache
from itertools import pairwise

import pytest
from websockets.sync.client import connect

from scorebreath.curves.curve_set import curves
from scorebreath.errors import EnvironmentFailure
from scorebreath.live.ledger import Ledger
from scorebreath.live.preview import SCRIPTS, open_preview, preview_routes, said_by, said_in
from scorebreath.live.streams.lines import line
from scorebreath.media.store import MemoryStore
from scorebreath.pipeline import compile_text
from scorebreath.report import figure
from scorebreath.score.document import Score
from scorebreath.score.events import Cut, Utterance
from scorebreath.speech.tone.voice import ToneVoice
from tests.live.pictures import picture

HOSTILE = "</title><script>document.title='taken'</script> {{figure}} <b onclick=x> '\"& \u2028"
TEXT = "Rain, at first. Then, after a while, it clears over the 23 hills, and nobody says a word. How strange!"


@cache
def spoken() -> Score:
    return compile_text(TEXT, voice=ToneVoice(), media=MemoryStore())


def test_the_page_asks_its_own_server_alone() -> None:
    routes = {path: content.decode() for path, (_, content) in preview_routes("x").items()}
    page = routes["/"]
    asked = set(re.findall(r'(?:src|href)="([^"]*)"', page))
    assert asked == {"data:,", *routes} - {"/"}
    assert not re.search(r"https?:|//[a-z]+\.|@import|url\((?!#)", "".join(routes.values()))
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)
    assert policy
    allowed = dict(each.split(" ", 1) for each in policy[1].split("; "))
    assert allowed.pop("default-src") == "'none'"
    assert {word for each in allowed.values() for word in each.split()} == {"'self'", "'none'", "data:"}
    assert "unsafe" not in page
    assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\b", routes["/preview.js"])
    assert not re.search(r'<script(?! src="/preview.js">)|<style| style=| on[a-z]+=', page), (
        "the policy would refuse it"
    )


def test_the_figure_is_that_of_the_report() -> None:
    routes = {path: content.decode() for path, (_, content) in preview_routes().items()}
    assert figure.drawing() in routes["/"]
    assert figure.style() in routes["/preview.css"]
    assert figure.script() in routes["/preview.js"]
    found = re.match(r"const CHANNELS = (\[.*?\]);\n", routes["/preview.js"])
    assert found
    assert tuple(json.loads(found[1])) == figure.CHANNELS
    assert set(figure.CHANNELS) <= set(curves(spoken()).channels)
    assert len(SCRIPTS) == len(set(SCRIPTS))


def test_a_title_is_only_text() -> None:
    page = preview_routes(HOSTILE)["/"][1].decode()
    assert page.count("<script") == 1
    assert "<b onclick" not in page
    assert page.count("&lt;b onclick=x&gt;") == 2
    assert page.count("{{figure}}") == 2, "a part is not looked at again"


def test_a_preview_is_served_and_gets_pictures_with_words() -> None:
    said = said_in(spoken())
    utterance = next(iter(spoken().of(Utterance, "body")))
    server, stream = open_preview(title="An evening", said=said)
    try:
        address = stream.target.name
        assert address == f"http://127.0.0.1:{server.port}/"
        for path, (media, content) in preview_routes("An evening").items():
            with urllib.request.urlopen(address + path[1:], timeout=20) as answer:
                assert (answer.read(), answer.headers["content-type"]) == (content, media)
        with connect(f"ws://127.0.0.1:{server.port}/pictures", open_timeout=20) as listening:
            speaks, rests = picture(utterance.onset + 0.1), picture(0.0)
            got: list[str] = []
            while not got:  # until the server knows of us
                stream.target.send(speaks)
                try:
                    got.append(str(listening.recv(0.05)))
                except TimeoutError:
                    continue
            while (last := json.loads(got[-1]))["time"] != 0.0:
                stream.target.send(rests)
                got.append(str(listening.recv(20)))
            told = json.loads(got[0])
            assert told.pop("said")["text"] == spoken().groups[0].text
            assert told == json.loads(line(speaks))
            assert last == json.loads(line(rests)), "who says nothing has no words"
        with pytest.raises(EnvironmentFailure, match=f"port {server.port} at 127"):
            open_preview(server.port)
    finally:
        stream.target.close()
    with pytest.raises(OSError, match="ended"):
        server.publish("body", "a")


def test_the_words_of_a_score_are_marked_one_after_the_other() -> None:
    score = spoken()
    said = said_in(score)
    marked: list[str] = []
    for utterance in score.of(Utterance, "body"):
        group = next(each for each in score.groups if each.id == utterance.group)
        for word in utterance.words:
            now = said("body", utterance.onset + word.onset + word.duration / 2)
            assert now is not None and now.text == group.text
            marked.append(now.text[slice(*now.word)] if now.word else "")
    written = re.findall(r"\w+", TEXT)
    kept = [word for word, after in pairwise([*marked, ""]) if word != after]
    assert [re.sub(r"\W", "", word) for word in kept] == written
    assert said("body", -1.0) is None and said("body", score.duration) is None
    assert said("nobody", 2.0) is None


def test_what_is_said_now_is_what_the_score_says() -> None:
    """Of a performance that goes on, an utterance cut off in its middle, and others before they began."""
    score = spoken()
    utterances = list(score.of(Utterance, "body"))
    assert len(utterances) > 1
    time = utterances[0].onset + 0.8
    cut = Cut(
        id="stop", body="body", onset=time, duration=0.02, fade=0.02, origin="performer", rule="test",
        targets=tuple(each.id for each in utterances),
    )  # fmt: skip
    whole = dataclasses.replace(score, events=(*score.events, cut))
    ledger = Ledger(dataclasses.replace(score, text="", groups=(), events=(), media={}, duration=0.0))
    ledger.text(score.text)
    for group in score.groups:
        ledger.group(group, score.media)
    ledger.events(score.events, now=0.0)
    for cuts, expected in ((), said_in(score)), ((cut,), said_in(whole)):
        ledger.events(cuts, now=0.0)
        said = said_by(ledger)
        times = [score.duration * step / 300 for step in range(301)]
        found = [said("body", each) for each in times]
        assert found == [expected("body", each) for each in times]
        speaking = [each for each, now in zip(times, found, strict=True) if now]
        assert speaking and (max(speaking) < time) == bool(cuts)
