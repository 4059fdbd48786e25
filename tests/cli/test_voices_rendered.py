"""Verse and prose by the voices that people would choose, rendered to everything."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scorebreath.signal.level import active_db
from tests.cli.running import run
from tests.speech.neural import needs_joe

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
GERMAN_PROSE = (
    "Am Abend kam der Regen von Westen, und er blieb bis zum Morgen. Im Hafen lagen die Boote dicht nebeneinander, wie "
    "Kühe es tun. Ein alter Mann zählte sie zweimal; dann ging er nach Hause.\n"
)
ENGLISH_PROSE = (
    "Alice was beginning to get very tired of sitting by her sister on the bank, and of having nothing to do: once or "
    "twice she had peeped into the book her sister was reading, but it had no pictures or conversations in it.\n"
)
CASES = {
    "a German poem by espeak": ((EXAMPLES / "parallelen.txt").read_text(encoding="utf-8"), "espeak", "de"),
    "German prose by espeak": (GERMAN_PROSE, "espeak:de", "de"),
    "German prose by a woman": (GERMAN_PROSE, "espeak:de+f3", "de"),
    "English prose by a woman": (ENGLISH_PROSE, "espeak:en-us+f3", "en"),
    "English prose by joe": (ENGLISH_PROSE, "joe", "en"),
}


@pytest.mark.parametrize("case", [pytest.param(name, marks=needs_joe) if "joe" in name else name for name in CASES])
def test_it_is_rendered(case: str, tmp_path: Path) -> None:
    text, voice, language = CASES[case]
    (tmp_path / "script.txt").write_text(text, encoding="utf-8")
    out = tmp_path / "out"
    done = run("render", tmp_path / "script.txt", "-o", out, "--voice", voice, "--language", language)
    assert done.exit_code == 0, done.output
    score = json.loads((out / "score.json").read_text())
    samples, rate = soundfile.read(out / "mix.wav", dtype="float32")
    assert len(samples) == round(score["duration"] * rate)
    speeches = [event for event in score["events"] if event["type"] == "utterance"]
    breaths = [event for event in score["events"] if event["type"] == "inspiration" and event.get("noise")]
    assert len(score["groups"]) >= 3
    assert len(breaths) >= len(score["groups"])
    assert sum(len(event["words"]) for event in speeches) > 0.8 * len(text.split())
    spoken = [_level(samples, rate, event) for event in speeches]
    breathed = [_level(samples, rate, event) for event in breaths]
    assert min(spoken) > -40
    assert -35 < np.median(breathed) - np.median(spoken) < -10, "breaths are as soft as breaths are"
    hertz = [value for event in speeches for value in event["pitch"]["hertz"] if value]
    assert (np.median(hertz) > 150) == ("woman" in case)
    rows = (out / "curves.csv").read_text().splitlines()
    assert abs(len(rows) - 1 - score["duration"] * 60) < 2


def _level(samples: np.ndarray[tuple[int, ...], np.dtype[np.float32]], rate: int, event: dict[str, float]) -> float:
    first = round(event["onset"] * rate)
    return active_db(samples[first : first + round(event["duration"] * rate)], rate)
