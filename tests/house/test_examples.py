"""Every script in examples/ becomes a Score, a sound, curves and pictures that agree with each other."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
from pathlib import Path

import pytest
import soundfile

from scorebreath.score.files import check_media, load
from scorebreath.units import frame_count

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted(path for path in (ROOT / "examples").glob("*.txt"))
MADE = {"mix.wav", "score.json", "speech", "curves.csv", "curves.json", "groups.csv", "timeline.png", "preview.html"}
FPS = 60


def test_the_examples_are_there() -> None:
    assert {"forecast.txt"} <= {path.name for path in EXAMPLES} and len(EXAMPLES) >= 5


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda p: p.name)
def test_an_example_renders(example: Path, tmp_path: Path) -> None:
    paths = os.pathsep.join(str(ROOT / folder) for folder in ("", "cli", "synthdefs"))
    run = subprocess.run(
        [sys.executable, "-m", "scorebreath_cli.main", "render", str(example), "-o", str(tmp_path / "out")],
        env={**os.environ, "PYTHONPATH": paths}, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr[-2000:]
    out = tmp_path / "out"
    assert {path.name for path in out.iterdir()} >= MADE

    score, media = load(out / "score.json")
    check_media(score, media)
    text = example.read_text(encoding="utf-8")
    assert score.text.split() == text.split()
    assert "".join("".join(group.text.split()) for group in score.groups) == "".join(text.replace("_", "").split())
    with soundfile.SoundFile(out / "mix.wav") as sound:
        assert sound.frames == frame_count(score.duration, sound.samplerate)
    with (out / "curves.csv").open(encoding="utf-8", newline="") as file:
        rows = sum(1 for _ in csv.reader(file)) - 1
    assert abs(rows - score.duration * FPS) <= 1
    with (out / "groups.csv").open(encoding="utf-8", newline="") as file:
        assert len(list(csv.DictReader(file))) == len(score.groups)
