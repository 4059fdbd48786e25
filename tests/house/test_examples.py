"""Every script in examples/ becomes a Score, a sound, curves and pictures that agree with each other."""

from __future__ import annotations

import csv
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import soundfile

from scorebreath.score.files import check_media, load
from scorebreath.script.markup.marked import marked
from scorebreath.units import frame_count

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted(path for path in (ROOT / "examples").iterdir() if path.suffix in (".txt", ".ssml"))
LANGUAGES = {"English": "en", "German": "de"}
LISTED = {
    name: LANGUAGES[language]
    for name, language in re.findall(
        r"^\| `([\w.]+)` \| [^|]+ \| (\w+) \|",
        (ROOT / "examples" / "README.md").read_text(encoding="utf-8"),
        re.MULTILINE,
    )
}
"""Example: its language, as examples/README.md tells it."""
MADE = {"mix.wav", "score.json", "speech", "curves.csv", "curves.json", "groups.csv", "timeline.png", "preview.html"}
FPS = 25


def test_every_example_is_listed_and_every_listed_one_is_there() -> None:
    assert {path.name for path in EXAMPLES} == set(LISTED)
    assert "forecast.txt" in LISTED and set(LISTED.values()) == {"en", "de"}


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda p: p.name)
def test_an_example_renders(example: Path, tmp_path: Path) -> None:
    paths = os.pathsep.join(str(ROOT / folder) for folder in ("", "cli", "synthdefs"))
    options = ("-o", str(tmp_path / "out"), "--language", LISTED[example.name], "--fps", str(FPS))
    run = subprocess.run(
        [sys.executable, "-m", "scorebreath_cli.main", "render", str(example), *options],
        env={**os.environ, "PYTHONPATH": paths}, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr[-2000:]
    out = tmp_path / "out"
    assert {path.name for path in out.iterdir()} >= MADE

    score, media = load(out / "score.json")
    check_media(score, media)
    text = marked(example.read_text(encoding="utf-8")).text
    assert score.text.split() == text.split()
    said = "".join("".join(group.text.replace("_", " ").split()) for group in score.groups)
    assert said == "".join(text.replace("_", " ").split())
    with soundfile.SoundFile(out / "mix.wav") as sound:
        assert sound.frames == frame_count(score.duration, sound.samplerate)
    with (out / "curves.csv").open(encoding="utf-8", newline="") as file:
        rows = sum(1 for _ in csv.reader(file)) - 1
    assert {body.id for body in score.bodies[1:]} == {path.parent.name for path in out.glob("*/curves.csv")}
    assert abs(rows - score.duration * FPS) <= 1
    with (out / "groups.csv").open(encoding="utf-8", newline="") as file:
        assert len(list(csv.DictReader(file))) == len(score.groups)
