"""The preview in a browser: its figure stands as the curves say, at any time asked for."""

from __future__ import annotations

import html as markup
import re
import subprocess
from pathlib import Path

import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.report import preview
from scorebreath.score.document import Score
from tests.curves.scores import Breath, build
from tests.report.test_preview import HOSTILE, page

pytestmark = pytest.mark.browser
QUIET = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--no-first-run", "--virtual-time-budget=2000", "--dump-dom",
)  # fmt: skip


def dump(chromium: str, folder: Path, file: Path, time: float) -> str:
    command = [chromium, *QUIET, f"--user-data-dir={folder / 'profile'}", f"{file.as_uri()}#t={time}"]
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
