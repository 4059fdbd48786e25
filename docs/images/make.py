"""Makes the pictures of README.md again: `python docs/images/make.py` (needs Chromium)."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ROWS = (0, 0, 2400, 965)
"""Left, top, right, bottom of the timeline's head and first two rows, pixels."""
MOMENT = 0.95
"""s; within the first inspiration"""


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        command = [sys.executable, "-m", "scorebreath_cli.main", "render", "examples/forecast.txt", "-o", str(out)]
        subprocess.run(command, cwd=ROOT, check=True)
        with Image.open(out / "timeline.png") as picture:
            save(
                picture.crop(ROWS).resize((1600, round(1600 * ROWS[3] / ROWS[2])), Image.Resampling.LANCZOS), "timeline"
            )
        shot = Path(folder) / "shot.png"
        chromium = shutil.which("chromium") or shutil.which("google-chrome") or "chromium"
        subprocess.run(
            [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=1280,800",
             f"--user-data-dir={folder}/profile", "--virtual-time-budget=4000", f"--screenshot={shot}",
             f"{(out / 'preview.html').as_uri()}#t={MOMENT}"],
            check=True, capture_output=True,
        )  # fmt: skip
        with Image.open(shot) as picture:
            save(picture, "preview")


def save(picture: Image.Image, name: str) -> None:
    picture.convert("RGB").quantize(128).save(HERE / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
