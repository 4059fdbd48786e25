"""What the rehearsal screen is made of: keys, a line, commands, pictures; and how text comes in."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Sequence
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.engine.live.status import Status
from scorebreath.errors import InputError
from scorebreath.live.conditions import Counts
from scorebreath.live.desk import COMMANDS
from scorebreath.live.streams.sender import Count
from scorebreath.live.viewing import BodyView, Said, View, said_at
from scorebreath_cli.performing import feeding
from scorebreath_cli.performing.drawing import PLAIN_BARS, Shown, draw, help_pages, progress
from scorebreath_cli.performing.feeding import Feeder, Whole
from scorebreath_cli.performing.keys import CONTROLS, SEQUENCES, Decoder
from scorebreath_cli.performing.line import LONGEST, MOVES, Line
from scorebreath_cli.performing.settings import endpoint
from scorebreath_cli.performing.typed import ROWS, Typed, describe, known
from tests.live.desks import ToyDesk

PATIENCE = 30.0


# Keys


@pytest.mark.parametrize(("text", "key"), SEQUENCES.items())
def test_every_sequence_is_its_key_however_it_is_cut(text: str, key: str) -> None:
    data = f"\x1b{text}".encode()
    for cut in range(1, len(data)):
        decoder = Decoder()
        assert decoder.feed(b"a" + data[:cut]) == ["a"]
        assert decoder.waiting
        assert decoder.feed(data[cut:] + b"b") == [key, "b"]


def test_an_escape_alone_is_a_key_when_nothing_follows() -> None:
    decoder = Decoder()
    assert decoder.feed(b"\x1b") == []
    assert decoder.settle() == ["escape"]
    assert not decoder.waiting
    assert decoder.feed(b"\x1b\x1b") == ["escape"]  # the second may yet be an arrow
    assert decoder.settle() == ["escape"]
    assert decoder.feed("ö\x18é".encode()) == ["ö", "panic", "é"]


@given(st.lists(st.binary(max_size=6), max_size=20))
def test_whatever_arrives_becomes_keys_that_are_known(pieces: list[bytes]) -> None:
    decoder = Decoder()
    keys = [key for piece in pieces for key in decoder.feed(piece)] + decoder.settle()
    names = {*CONTROLS.values(), *SEQUENCES.values(), "escape"}
    assert all(key in names or (len(key) == 1 and key.isprintable()) for key in keys)
    assert not decoder.waiting or len(b"".join(pieces)) > 0


# A line


def typed(line: Line, *keys: str) -> list[str]:
    return [done for key in keys if (done := line.press(key)) is not None]


def test_a_line_is_edited_and_remembered() -> None:
    line = Line()
    assert typed(line, *"helo", "left", "l", "end", "!", "enter") == ["hello!"]
    assert typed(line, *"two words", "erase-word", *"three", "home", "delete", "T", "enter") == ["Two three"]
    typed(line, *"draft")
    typed(line, "up")
    assert line.text == "Two three"
    typed(line, "up", "up")
    assert line.text == "hello!"
    typed(line, "down", "down")
    assert (line.text, line.cursor) == ("draft", 5)
    assert typed(line, "backspace", "left", "erase-behind", "enter") == ["dra"]
    assert typed(line, *"xy", "erase-before", "enter") == [""]


@given(st.lists(st.sampled_from([*MOVES, "enter", "a", " ", "/", "é"]), max_size=60))
def test_the_cursor_stays_in_the_line(keys: list[str]) -> None:
    line = Line(Typed(ToyDesk()).completions)
    for key in keys:
        line.press(key)
        assert 0 <= line.cursor <= len(line.text) <= LONGEST


def test_tab_completes_as_far_as_it_is_certain() -> None:
    line = Line(Typed(ToyDesk()).completions)
    typed(line, *"/si", "tab")
    assert line.text == "/sigh "
    typed(line, "erase-before", *"/set nose", "tab")
    assert line.text == "/set nose_share="
    typed(line, "erase-before", *"/s", "tab")
    assert line.text == "/s"
    assert {"/sigh", "/set", "/stop"} <= set(line.hints())
    typed(line, "erase-before", *"Said", "tab")
    assert (line.text, line.hints()) == ("Said", [])


# What is typed


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_of_the_desk_can_be_typed(name: str) -> None:
    desk = ToyDesk("body", "body2")
    person = Typed(desk)
    person.do(f"/{name}")
    person.do(f"/{name} body2" if name not in ROWS else f"/{name}")
    person.do("/who body2")
    person.do(f"/{name.upper()} ")
    called = [call for call in desk.calls if call[0] == "command"]
    assert called == [
        ("command", name, ""), ("command", name, "body2" if name not in ROWS else ""), ("command", name, "body2"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("line", "calls"),
    [
        ("Good evening.", [("say", "Good evening.", "")]),
        ("//etc is a folder", [("say", "/etc is a folder", "")]),
        ("   ", []),
        ("/cut Stop that!", [("cut", "Stop that!", "")]),
        ("/set nose_share=0.8", [("set", "nose_share", 0.8, "", None)]),
        ("/set nose_share 0.8", [("set", "nose_share", 0.8, "", None)]),
        ("/set nose-share 0.8 glide 2.5", [("set", "nose_share", 0.8, "", 2.5)]),
        ("/set nose-share=0.8 glide 2.5", [("set", "nose_share", 0.8, "", 2.5)]),
        ("/set breath_sound=off", [("set", "breath_sound", False, "", None)]),
        ("/reset nose_share", [("set", "nose_share", None, "", None)]),
    ],
)
def test_lines_do_what_they_say(line: str, calls: list[tuple[object, ...]]) -> None:
    desk = ToyDesk()
    assert Typed(desk).do(line) == ""
    assert desk.calls == calls


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("/sihg", "did you mean sigh"), ("/", "/help lists them"), ("/sigh body9", "body"),
        ("/set nose_share", "NAME=VALUE"), ("/set nose_share=7", "nose_share"), ("/set nosey=1", "nosey"),
        ("/set nose_share=0.5 glide long", "glide long"),
        ("/show nosey", "nosey"), ("/who nobody", "nobody"), ("/learn nose_share", "--midi"), ("/map x.toml", "--midi"),
        ("/set", "NAME=VALUE"), ("/show", "name of a parameter"), ("[broken", "without end"),
        ("/cut [broken", "without end"),
    ],
)  # fmt: skip
def test_what_is_not_understood_is_said(line: str, said: str) -> None:
    desk = ToyDesk()
    with pytest.raises(InputError) as caught:
        Typed(desk).do(line)
    assert said in str(caught.value)
    assert not desk.calls


def test_questions_are_answered() -> None:
    desk = ToyDesk("body", "body2")
    person = Typed(desk)
    desk.set("nose_share", 0.25)
    assert person.do("/show nose_share") == "nose_share = 0.25"
    assert person.do("/who") == "body, body2; you speak to everybody"
    assert person.do("/who body2") == "body, body2; you speak to body2"
    person.do("Hello.")
    assert desk.calls[-1] == ("say", "Hello.", "body2")
    assert person.do("/who *").endswith("everybody")


def test_help_has_every_command() -> None:
    listed = {usage.split()[0].removeprefix("/") for usage, _ in describe()}
    assert listed == {*known(), "/TEXT"} == {*COMMANDS, *ROWS, "/TEXT"}


@pytest.mark.parametrize(("width", "height"), [(80, 24), (40, 10), (200, 60), (20, 5)])
def test_every_command_is_on_a_page_of_the_help(width: int, height: int) -> None:
    pages = help_pages(describe(), width, height)
    assert all(len(page) <= height - 2 for page in pages[:-1]) and (len(pages) == 1) == (height == 60)
    said = " ".join(row.plain.strip() for page in pages for row in page)
    for usage, about in describe():
        assert usage in said
        assert all(word in said for word in about.split())
    seen = draw(replace(EMPTY, help=describe(), page=len(pages)), width, height)
    assert len(seen) == height and max(row.cell_len for row in seen) <= width
    assert height < 10 or any("//TEXT" in row.plain for row in seen)


def test_messages_are_seen_whole() -> None:
    long = "what is wrong with it and what would be right " * 4 + "is said to its last WORD"
    rows = draw(replace(EMPTY, troubles=["an older one", long]), 60, 24)
    assert any("WORD" in row.plain for row in rows) and any("an older one" in row.plain for row in rows)
    rows = draw(replace(EMPTY, answer=long, wrong=True), 80, 24)
    assert any("WORD" in row.plain for row in rows[-4:])


def test_moves_name_their_bodies_where_there_are_several() -> None:
    several = replace(EMPTY.view, bodies=(BODY, replace(BODY, body="body2")))
    moved = [("body,body2", "nose_share", "0.8"), ("body2", "age", "30")]
    rows = draw(replace(EMPTY, view=several, moved=moved), 80, 24)
    assert any("body,body2 nose_share 0.8, body2 age 30" in row.plain for row in rows)
    assert any("  nose_share 0.8, age 30" in row.plain for row in draw(replace(EMPTY, moved=moved), 80, 24))


# Pictures

TEXTS = st.text(max_size=120)


BODY = BodyView(body="body", doing="rests", said=None, lungs=(0.5,))
EMPTY = Shown(
    view=View(time=1.0, bodies=(BODY,), coming=(), paused=False, ending=False, over=None), counts=Counts(),
    engine=Status(
        alive=True, engine="silent", sample_rate=48000, latency=0.02, sent=99_999, late=0, late_sent=0, lost=0,
        restarts=0, waiting=0, lead_min=0.1498, lead_mean=0.15,
    ),
    latency=0.02,
)  # fmt: skip


def test_what_the_engine_does_fits_a_narrow_terminal() -> None:
    assert any("latency 20 ms" in row.plain for row in draw(EMPTY, 80, 24))


@st.composite
def shown(draw_: st.DrawFn) -> Shown:
    text = draw_(TEXTS)
    ends = sorted((draw_(st.integers(0, len(text))), draw_(st.integers(0, len(text)))))
    said = Said(id="g", text=text, onset=0.0, word=(ends[0], ends[1])) if text and draw_(st.booleans()) else None
    lungs = tuple(draw_(st.lists(st.floats(-0.5, 1.5), max_size=60)))
    bodies = [BodyView(body=f"body{n}", doing="rests", said=said, lungs=lungs) for n in range(draw_(st.integers(1, 3)))]
    line = draw_(TEXTS)
    status = Status(
        alive=draw_(st.booleans()), engine="silent", sample_rate=48000, latency=0.02, sent=draw_(st.integers(0, 9)),
        late=0, late_sent=0, lost=0, restarts=0, waiting=0, lead_min=0.1, lead_mean=0.1,
    )  # fmt: skip
    return Shown(
        view=View(
            time=draw_(st.floats(-1, 1e5)), bodies=tuple(bodies), coming=tuple(draw_(st.lists(TEXTS, max_size=5))),
            paused=False, ending=False, over=None,
        ),
        counts=Counts(late=draw_(st.integers(0, 2))), engine=status, latency=0.02,
        targets=[("vmc://127.0.0.1:39539", Count(sent=3, failed=draw_(st.integers(0, 1))))],
        moved=[("body", "nose_share", "0.8")], troubles=draw_(st.lists(TEXTS, max_size=9)), line=line,
        cursor=draw_(st.integers(0, len(line))), answer=draw_(TEXTS), unicode=draw_(st.booleans()),
        help=[("/help", "this list")] * draw_(st.sampled_from([0, 30])), typing=draw_(st.booleans()),
    )  # fmt: skip


@given(shown(), st.integers(20, 200), st.integers(5, 60))
def test_a_picture_has_its_size_and_nothing_that_a_terminal_obeys(what: Shown, width: int, height: int) -> None:
    rows = draw(what, width, height)
    assert len(rows) == height
    for row in rows:
        assert row.cell_len <= width
        assert all(character.isprintable() or character >= "\xa0" for character in row.plain), row.plain


def test_the_word_that_sounds_is_marked() -> None:
    body = BodyView(
        body="body", doing="speaks", said=Said(id="g", text="Good evening, all.", onset=0.0, word=(5, 12)), lungs=(0.5,)
    )
    view = View(time=61.0, bodies=(body,), coming=("And then?",), paused=True, ending=False, over=None)
    from scorebreath.engine.live.status import Status

    status = Status(
        alive=True, engine="silent", sample_rate=48000, latency=0.02, sent=0, late=0, late_sent=0, lost=0, restarts=0,
        waiting=0, lead_min=float("inf"), lead_mean=0.0,
    )  # fmt: skip
    rows = draw(Shown(view=view, counts=Counts(groups=2), engine=status, latency=0.02, unicode=False), 80, 24)
    spoken = next(row for row in rows if "Good" in row.plain)
    marked = [spoken.plain[span.start : span.end] for span in spoken.spans if "reverse" in str(span.style)]
    assert marked == ["evening"]
    assert "1:01" in rows[0].plain
    assert "paused" in rows[0].plain
    assert any("And then?" in row.plain for row in rows)
    lungs = next(row for row in rows if row.plain.startswith(" lungs"))
    assert PLAIN_BARS[4] in lungs.plain
    assert progress(0.5, 10.0, 33, unicode=False).plain == " " * 9 + "#########--------- 0:10"


# Text that comes in


def fed(texts: Sequence[Whole | None], desk: ToyDesk, data: bytes = b"", notes: list[str] | None = None) -> None:
    reading, writing = os.pipe()
    feeder = Feeder(texts, (notes if notes is not None else []).append, descriptor=reading)
    feeder.start(desk)
    os.write(writing, data)
    os.close(writing)
    until = time.monotonic() + PATIENCE
    while not feeder.done:
        assert time.monotonic() < until
        time.sleep(0.002)
    os.close(reading)


def test_texts_come_in_order_and_a_broken_one_holds_nobody_up() -> None:
    desk, notes = ToyDesk(), list[str]()
    texts = [Whole(name="a", text="One."), None, Whole(name="b", text="[broken"), Whole(name="c", text="Two.")]
    fed(texts, desk, "é".encode(), notes)
    assert desk.calls == [("say", "One.", ""), ("stream", "é", ""), ("end_stream", ""), ("say", "Two.", "")]
    assert notes == ["b: 1:1: a tag without end"]


def test_what_is_too_fast_waits_in_its_pipe(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(feeding, "BURST", 10)
    monkeypatch.setattr(feeding, "STEADY", 0.001)
    reading, writing = os.pipe()
    os.write(writing, b"a" * 100)
    desk = ToyDesk()
    feeder = Feeder([None], lambda _: None, descriptor=reading)
    feeder.start(desk)
    assert not threading.Event().wait(0.05)
    assert (desk.calls, feeder.done) == ([], False)  # for a day or so
    feeder.stop()
    until = time.monotonic() + PATIENCE
    while not feeder.done:
        assert time.monotonic() < until
        time.sleep(0.002)
    assert desk.calls == []
    os.close(writing)
    os.close(reading)


SSML = '\n<speak>Good evening.<break time="300ms"/> And so to bed.</speak>\n'
MARYXML = (
    '<?xml version="1.0"?><maryxml version="0.5" xmlns="http://mary.dfki.de/2002/MaryXML" xml:lang="en">'
    "<p><s><t>Good</t> <t>evening</t></s></p></maryxml>"
)


@pytest.mark.parametrize("document", [SSML, MARYXML])
@pytest.mark.parametrize("piece", [1, 7, 1_000])
def test_a_document_that_comes_in_pieces_is_said_when_it_is_whole(
    document: str, piece: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(feeding, "PIECE", piece)
    desk = ToyDesk()
    fed([None], desk, f"\ufeff{document}".encode())
    assert desk.calls == [("say", document, "")]


def test_an_endless_document_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(feeding, "BURST", 100)
    desk, notes = ToyDesk(), list[str]()
    fed([None, Whole(name="a", text="One.")], desk, b"<speak>" + b"a" * 200, notes)
    assert notes == ["<stdin>: a document of more than 100 characters"]
    assert desk.calls == [("say", "One.", "")]


@pytest.mark.parametrize("text", ["", "x", "70000", "1:2:3", "host:", ":9", "[::1", "h o:9"])
def test_what_is_no_address_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="expected PORT or HOST:PORT"):
        endpoint("--osc", text, "127.0.0.1")


def test_what_is_said_without_a_group_is_its_words() -> None:
    from tests.live.stages import Stage

    stage = Stage()
    stage.say("Good evening.")
    stage.end()
    stage.go(60.0)
    utterance = next(event for event in stage.score().events if event.type == "utterance")
    group = stage.score().groups[0]
    word = utterance.words[1]  # type: ignore[attr-defined]
    now = utterance.onset + word.onset + word.duration / 2
    said = Said(id=group.id, text="Good evening.", onset=utterance.onset, word=(5, 12))
    assert said_at(utterance, group, now) == said  # type: ignore[arg-type]
    assert said_at(utterance, None, now).text == "Good evening"  # type: ignore[arg-type]
    assert said_at(utterance, group, -1.0).word is None  # type: ignore[arg-type]
