"""Norms: the page has every row, is well-formed, and needs nothing from elsewhere."""

from __future__ import annotations

import dataclasses
import io
import re
import subprocess
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.report.norms import norms
from scorebreath.report.norms.page import write_page
from scorebreath.report.norms.plots import FOOT, HEIGHT, WIDTH, plot, ticks
from scorebreath.report.norms.row import Row
from scorebreath.report.norms.row import result as result_of
from scorebreath.report.norms.sources import SOURCES
from scorebreath.report.norms.table import ROWS
from scorebreath.score.document import Score
from scorebreath.score.events import State
from scorebreath.units import snap
from tests.curves.scores import score_of
from tests.report.people import EVEN, person, tidal, with_events
from tests.report.test_norms_sound import RATE, sound_of

XHTML = "{http://www.w3.org/1999/xhtml}"
HOSTILE = "<script>alert('x')</script> & ]]> \x00\x07\x1b \ufffe \ud800 \"quoted\" 世界"


def page(score: Score, sound: np.ndarray | None = None) -> str:
    stream = io.BytesIO()
    write_page(stream, score, norms(score, sound, RATE if sound is not None else None))
    return stream.getvalue().decode("utf-8")


def tree(text: str) -> ElementTree.Element:
    return ElementTree.fromstring(text.removeprefix("<!DOCTYPE html>"))


def varied(count: int) -> Score:
    breaths = [
        dataclasses.replace(EVEN, speech=snap(3.0 + 0.07 * n), inspiration=snap(0.4 + 0.01 * n)) for n in range(count)
    ]
    score = person(breaths, syllables=[8 + n % 17 for n in range(count)], sites=["comma", "sentence"] * (count // 2))
    return with_events(score, *tidal(snap(score.duration), 9))


def cards(root: ElementTree.Element) -> dict[str, ElementTree.Element]:
    return {card.attrib["id"]: card for card in root.iter(f"{XHTML}article")}


@pytest.mark.parametrize("count", [0, 1, 6, 40])
def test_the_page_has_every_row(count: int) -> None:
    score = varied(count) if count > 1 else person(1) if count else score_of([])
    found = norms(score)
    shown = cards(tree(page(score)))
    assert list(shown) == [row.name for row in ROWS]
    for result in found.results:
        card = shown[result.row.name]
        text = " ".join("".join(card.itertext()).split())
        assert result.row.title in text and result.row.measured in text and str(result.verdict) in text
        assert card.attrib["class"] == result.verdict.word.replace(" ", "-")
        for each in result.compared:
            assert SOURCES[each.figure.source].short in text
            assert each.figure.note in text


def test_a_row_with_values_has_a_picture() -> None:
    score = varied(40)
    sound = sound_of(score, breath_db=-44, speech_db=-20)
    shown = cards(tree(page(score, sound)))
    for result in norms(score, sound, RATE).results:
        pictures = [each for each in shown[result.row.name].iter() if each.tag.endswith("svg")]
        assert len(pictures) == (1 if result.n else 0), result.row.name
    drawn = shown["group_speech"]
    names = [each.attrib.get("class") for each in drawn.iter() if each.tag.endswith(("rect", "path"))]
    assert {"value", "band", "band other", "limit", "median", "spread", "axis"} <= set(names)


def test_pictures_stay_in_their_frames() -> None:
    score = varied(40)
    for card in cards(tree(page(score))).values():
        for shape in card.iter():
            if shape.tag.endswith("rect"):
                x, y, wide, high = (float(shape.attrib[name]) for name in ("x", "y", "width", "height"))
                assert x >= -0.1 and x + wide <= WIDTH + 2 and y >= 0 and y + high <= max(HEIGHT, FOOT) + 40
            if shape.tag.endswith("circle"):
                assert 0 <= float(shape.attrib["cx"]) <= WIDTH and 0 <= float(shape.attrib["cy"]) <= HEIGHT


def test_the_histogram_counts_every_breath() -> None:
    score = varied(40)
    bars = [
        float(shape.attrib["height"])
        for shape in cards(tree(page(score)))["syllables"].iter()
        if shape.tag.endswith("rect") and shape.attrib["class"] == "value"
    ]
    syllables = norms(score).values["syllables"]
    assert 3 <= len(bars) <= len(np.unique(syllables))
    few = cards(tree(page(varied(6))))["syllables"]
    assert sum(shape.attrib.get("class") == "value" for shape in few.iter()) == 6


def test_the_page_needs_nothing_from_elsewhere() -> None:
    text = page(varied(12))
    assert not re.search(r"https?://(?!www\.w3\.org/1999/xhtml)", text)
    assert not re.search(r"<(script|link|img|iframe|object)|@import|url\(|\bon\w+=", text)
    assert "prefers-color-scheme: dark" in text and "color-scheme: light dark" in text


def test_sources_that_are_cited_are_listed_and_linked() -> None:
    root = tree(page(varied(12)))
    targets = {each.attrib["id"] for each in root.iter() if "id" in each.attrib}
    links = {each.attrib["href"].removeprefix("#") for each in root.iter(f"{XHTML}a")}
    assert links and links <= targets
    listed = {each.removeprefix("source-") for each in targets if each.startswith("source-")}
    assert listed == {link.removeprefix("source-") for link in links if link.startswith("source-")}


def test_any_text_is_only_text() -> None:
    score = dataclasses.replace(person(12), text=HOSTILE + " " * 2000)
    state = State(id="s", body="body", onset=0.0, duration=1.0, name=HOSTILE, start=0.0, target=1.0, ramp=0.0)
    root = tree(page(with_events(score, state)))
    assert not list(root.iter(f"{XHTML}script"))
    title = root.find(f"{XHTML}head/{XHTML}title")
    assert title is not None and "<script>alert('x')</script> & ]]>" in (title.text or "")


def test_what_is_outside_is_said_at_the_top() -> None:
    fast = [dataclasses.replace(EVEN, speech=1.0)] * 12
    text = page(person(fast))
    assert "<h2>Outside</h2>" in text and "<a href='#group_speech'>" in text
    assert "mean 1.00 is below 3.3 to 4.8 s" in text
    good = person([dataclasses.replace(EVEN, speech=snap(4.0 + (n % 5 - 2) * 0.8)) for n in range(20)])
    assert norms(good)["group_speech"].verdict.word == "within"


def test_equal_scores_give_equal_pages() -> None:
    assert page(varied(12)) == page(varied(12))


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e6))
def test_ticks_are_few_round_and_within(low: float, span: float) -> None:
    high = low + span
    if high - low < 1e-9 * max(abs(low), 1.0) * 1e4:
        return
    found = ticks(low, high)
    assert 2 <= len(found) <= 7
    steps = np.diff(found)
    assert np.all(steps > 0) and np.allclose(steps, steps[0], rtol=1e-3, atol=2e-9)
    slack = 1e-6 * span + 1e-9
    assert low - slack <= found[0] and found[-1] <= high + slack


@pytest.mark.browser
def test_a_browser_shows_every_row(chromium: str, tmp_path: Path) -> None:
    file = tmp_path / "norms.html"
    file.write_text(page(varied(40)), encoding="utf-8")
    command = [
        chromium, "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run",
        f"--user-data-dir={tmp_path / 'profile'}", "--dump-dom", file.as_uri(),
    ]  # fmt: skip
    dom = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True).stdout
    assert len(re.findall(r"<article ", dom)) == len(ROWS)
    assert len(re.findall(r"<svg ", dom)) > 20


@settings(max_examples=150, deadline=None)
@given(st.sampled_from(ROWS), st.data())
def test_any_values_can_be_drawn(row: Row, data: st.DataObject) -> None:
    """Also numbers that no body has: huge, equal to the last bit, or nearly so."""
    numbers = st.floats(-1e9, 1e9) | st.sampled_from([0.0, 1.0, 1e9, 1e9 - 1e-7, -1e9, 1e-9])
    count = data.draw(st.integers(1, 60))
    if row.kind == "relation":
        values = np.array(data.draw(st.lists(st.tuples(numbers, numbers), min_size=count, max_size=count)))
    elif row.kind in ("share", "sites"):
        top = len(row.labels) - 1 if row.labels else 1
        values = np.array(data.draw(st.lists(st.integers(0, top), min_size=count, max_size=count)), dtype=np.float64)
    else:
        values = np.array(data.draw(st.lists(numbers, min_size=count, max_size=count)))
    material = SimpleNamespace(who=norms(person(1)).who)
    drawn = plot(result_of(dataclasses.replace(row, measure=lambda _: values), material))  # type: ignore[arg-type]
    if drawn:
        assert not re.search(r"nan|inf", drawn.partition(">")[2])
        ElementTree.fromstring(drawn)
