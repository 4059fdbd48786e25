"""Makes the pictures of README.md and face.md again: `python docs/images/make.py` (needs Chromium)."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

from scorebreath.score.codec import loads
from scorebreath.score.events import Emotion

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
BOTTOM = 1030
"""Pixels of the timeline that are shown: its head and first row."""
MOMENT = 0.95
"""s; within the first inspiration"""
WINDOW = (1280, 800)
FIGURE = (16, 60, 492, 474)
"""Left, top, right, bottom of the preview's figure in a window of 1000 by 760 pixels."""


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        render(out, "examples/forecast.txt")
        with Image.open(out / "timeline.png") as picture:
            shown = picture.crop((0, 0, picture.width, BOTTOM))
            save(shown.resize((1600, round(1600 * BOTTOM / picture.width)), Image.Resampling.LANCZOS), "timeline")
        save(shot(out, MOMENT, WINDOW), "preview")
        poem = Path(folder) / "poem"
        render(poem, "examples/parallelen_emoticons.txt", "--language", "de")
        save(emotions(poem), "faces")


def emotions(poem: Path) -> Image.Image:
    """The figure at the climax of each emotion of the poem."""
    score = loads((poem / "score.json").read_bytes())
    found = {event.name: event.onset + event.apex for event in score.of(Emotion)}
    figures = [shot(poem, time, (1000, 760)).crop(FIGURE) for time in sorted(found.values())]
    width, height = figures[0].size
    whole = Image.new("RGB", (width * len(figures), height), "white")
    for number, figure in enumerate(figures):
        whole.paste(figure, (number * width, 0))
    return whole.resize((1600, round(1600 * height / whole.width)), Image.Resampling.LANCZOS)


def render(out: Path, script: str, *options: str) -> None:
    command = [sys.executable, "-m", "scorebreath_cli.main", "render", script, "-o", str(out), *options]
    subprocess.run(command, cwd=ROOT, check=True)


def shot(out: Path, time: float, window: tuple[int, int]) -> Image.Image:
    """The preview as a browser shows it at a time."""
    chromium = shutil.which("chromium") or shutil.which("google-chrome") or "chromium"
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "shot.png"
        subprocess.run(
            [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
             f"--window-size={window[0]},{window[1]}", f"--user-data-dir={folder}/profile",
             "--virtual-time-budget=4000", f"--screenshot={picture}",
             f"{(out / 'preview.html').as_uri()}#t={time:.2f}"],
            check=True, capture_output=True,
        )  # fmt: skip
        with Image.open(picture) as opened:
            return opened.convert("RGB")


def save(picture: Image.Image, name: str) -> None:
    picture.convert("RGB").quantize(128).save(HERE / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
