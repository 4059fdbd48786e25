"""The preview in a browser: its figure stands as the curves say, at any time asked for."""

from __future__ import annotations

import dataclasses
import html as markup
import json
import re
import subprocess
from itertools import pairwise
from pathlib import Path

import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.report import preview
from scorebreath.score.document import Score
from scorebreath.score.events import Inspiration, Utterance
from tests.curves.acts import breathe_in
from tests.curves.scores import Breath, build
from tests.report.test_preview import HOSTILE, page

pytestmark = pytest.mark.browser
QUIET = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--no-first-run", "--virtual-time-budget=2000", "--dump-dom",
)  # fmt: skip


def dump(chromium: str, folder: Path, file: Path, time: float, *more: str) -> str:
    command = [chromium, *QUIET, *more, f"--user-data-dir={folder / 'profile'}", f"{file.as_uri()}#t={time}"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    return done.stdout


def figure(dom: str) -> dict[str, float]:
    tag = re.search(r'<svg id="figure"[^>]*>', dom)
    assert tag
    return {name.replace("-", "_"): float(value) for name, value in re.findall(r'data-([a-z-]+)="([-0-9.]+)"', tag[0])}


@pytest.fixture(scope="module")
def score() -> Score:
    return build([Breath(speech=2.0, to_volume=0.6), Breath(profile="sine", lead_mouth=0.08, text=HOSTILE)])


def test_the_figure_moves_by_the_curves(chromium: str, tmp_path: Path, score: Score) -> None:
    file = tmp_path / "preview.html"
    file.write_text(page(score), encoding="utf-8")
    outlines = set()
    for time in (0.4, 1.5, 3.2):  # breathing in, speaking, breathing in again
        dom = dump(chromium, tmp_path, file, time)
        shown = figure(dom)
        assert shown["time"] == time
        expected = curves(score).sample([time], preview.CHANNELS)[0]
        for name, value in zip(preview.CHANNELS, expected, strict=True):
            loose = 0.2 if name.endswith("_level") or name == "airflow" else 2e-4
            assert shown[name] == pytest.approx(value, abs=loose), (name, time)
        torso = re.search(r'<path id="torso"[^>]* d="([^"]*)"', dom)
        jaw = re.search(r'<g id="jaw" transform="rotate\(([-0-9.]+)', dom)
        assert torso and jaw
        outlines.add(torso[1])
        assert (float(jaw[1]) > 0) == (shown["mouth_open"] > 0 or shown["speech_level"] > -26)
        assert f'data-sound="{score.duration:.6f}"' in dom, "the browser could not decode the sound"
    assert len(outlines) == 3


def test_hostile_text_is_only_text_in_a_browser(chromium: str, tmp_path: Path, score: Score) -> None:
    file = tmp_path / "preview.html"
    file.write_text(page(score), encoding="utf-8")
    dom = dump(chromium, tmp_path, file, 0.0)
    assert "<title>taken</title>" not in dom
    section = re.search(r'<section id="transcript"[^>]*>(.*?)</section>', dom, re.DOTALL)
    assert section
    text = markup.unescape(re.sub(r"<[^>]*>", "", section[1]))
    assert text == score.text.strip()


SCROLLED = """<script>
const box = document.getElementById("transcript"), told = [];
for (const t of %s) {
  window.scorebreath.pose(t);
  const all = [...box.querySelectorAll("[data-onset]")].filter(span => Number(span.dataset.onset) <= t + 1e-9);
  const last = all.length ? all[all.length - 1].getBoundingClientRect() : box.getBoundingClientRect();
  const frame = box.getBoundingClientRect();
  told.push([all.length, box.scrollTop, last.top >= frame.top && last.bottom <= frame.bottom || !all.length,
    box.querySelectorAll(".now").length]);
}
document.body.dataset.told = JSON.stringify(told);
</script>"""


def test_the_transcript_follows_also_where_nothing_is_said(chromium: str, tmp_path: Path) -> None:
    """Opened or sought to a time between a word and the next, it shows the last word said."""
    score = build([Breath(before=0.3)] * 60, tail=3.0)
    between = [
        score.duration - 1.0,
        0.05,
        *(event.onset - 0.1 for event in list(score.of(Inspiration, "body"))[20:60:13]),
    ]
    file = tmp_path / "preview.html"
    file.write_text(page(score) + SCROLLED % between, encoding="utf-8")
    found = re.search(r'data-told="([^"]*)"', dump(chromium, tmp_path, file, 0.0))
    assert found
    told = json.loads(markup.unescape(found[1]))
    assert len(told) == len(between)
    for count, scrolled, seen, marked in told:
        assert not marked, "a time within a word would show nothing new"
        assert seen
        assert (scrolled > 100) == (count > 0)


SEEN = """<script>{
const pen = document.createElement("canvas").getContext("2d"), told = [];
pen.font = FONT;
for (const t of %s) {
  window.scorebreath.pose(t);
  const {shown, seconds, first, count} = window.scorebreath.labels();
  for (const label of shown) label.width = pen.measureText(label.text).width;
  told.push({t, first, seconds, count, shown});
}
const strip = document.getElementById("strip"), box = id => document.getElementById(id).getBoundingClientRect();
document.body.dataset.told = JSON.stringify({told, frame: box("frame").height, stage: box("stage").bottom,
  strip: [box("strip").top, strip.clientWidth, strip.clientHeight], page: document.documentElement.scrollHeight,
  wide: document.documentElement.scrollWidth - innerWidth, window: innerHeight, player: box("player").bottom});
}</script>"""


@pytest.mark.parametrize("size", [(780, 437), (600, 300), (390, 844), (1280, 800)])
def test_a_small_window_scrolls_and_drops_no_word(chromium: str, tmp_path: Path, size: tuple[int, int]) -> None:
    """The figure keeps its height, the player stays in sight, and every word of the strip has a label of its own."""
    score = build([Breath(speech=speech) for speech in (3.5, 2.0, 3.5, 3.0)])
    times = [score.duration * i / 23 for i in range(24)]
    file = tmp_path / "preview.html"
    file.write_text(page(score) + SEEN % times, encoding="utf-8")
    found = re.search(r'data-told="([^"]*)"', dump(chromium, tmp_path, file, 0.0, f"--window-size={size[0]},{size[1]}"))
    assert found
    seen = json.loads(markup.unescape(found[1]))
    assert seen["frame"] >= 200
    assert seen["wide"] <= 0
    assert seen["stage"] <= seen["strip"][0], "the figure's card lies on the strip"
    assert seen["player"] <= seen["window"] + 1
    assert seen["page"] >= seen["strip"][0] + seen["strip"][2]
    words = [(u.onset, word) for u in score.of(Utterance, "body") for word in u.words]
    spoken = [(onset + word.onset, slice(*word.source)) for onset, word in words if word.source]
    for told in seen["told"]:
        start, end = told["first"], told["first"] + told["seconds"]
        expected = [score.text[place] for onset, place in spoken if start <= onset < end]
        labels = [label["text"] for label in told["shown"]]
        assert labels[len(labels) - len(expected) :] == expected
        assert told["seconds"] >= 2
        rate = seen["strip"][1] / told["seconds"]
        onsets = [onset for onset, _ in spoken if onset < end][-len(told["shown"]) :]
        for label, onset in zip(told["shown"], onsets, strict=True):
            assert -1e-6 <= label["left"] / rate - (onset - start) <= 0.3, "a label stands where its word is said"
            assert 0 <= label["row"] < told["count"] <= 3
        for row in range(told["count"]):
            line = [label for label in told["shown"] if label["row"] == row]
            for one, after in pairwise(line):
                assert one["left"] + one["width"] < after["left"], "labels overlap"


def test_a_sigh_is_in_the_text_and_on_the_strip(chromium: str, tmp_path: Path) -> None:
    score = build([Breath()], tail=0.0)
    sigh = breathe_in(id="sigh", kind="sigh", onset=score.duration, duration=1.5)
    score = dataclasses.replace(score, events=(*score.events, sigh), duration=sigh.end)
    file = tmp_path / "preview.html"
    file.write_text(page(score) + SEEN % [sigh.onset - 0.1, sigh.onset + 0.5], encoding="utf-8")
    dom = dump(chromium, tmp_path, file, sigh.onset + 0.5)
    assert re.search(r'<span class="act now"[^>]*>\[sighs\]</span></section>', dom)
    found = re.search(r'data-told="([^"]*)"', dom)
    assert found
    before, during = json.loads(markup.unescape(found[1]))["told"]
    assert [label["now"] for label in during["shown"] if label["text"] == "[sighs]"] == [True]
    assert [label["now"] for label in before["shown"] if label["text"] == "[sighs]"] == [False]
