"""What the curves of a face cost, in a process of its own.

python -m benchmarks.curves prepare TEXT SCORE    speak a text, and keep its Score
python -m benchmarks.curves cost SCORE...         s for all ARKit columns of each, and for a window of 100 ms, as JSON
python -m benchmarks.curves naive TEXT SECONDS    s that OpenFaceFX takes for the same, as JSON
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

FPS = 60
BLOCK = 4096
"""Frames at a time, as the writers of files do."""
WINDOW = 0.1
"""s"""
WINDOWS = 400
"""Spread over each Score."""
ROUNDS = 7


def has_peer() -> bool:
    """Whether OpenFaceFX is installed: `pip install openfacefx==0.24.0`."""
    return find_spec("openfacefx") is not None


def prepare(text: str, target: str) -> dict[str, float]:
    """Speak a text; how long that took."""
    from scorebreath.media.store import MemoryStore
    from scorebreath.pipeline import compile_text
    from scorebreath.score.codec import dumps
    from scorebreath.speech.voices import open_voice

    media = MemoryStore()
    voice = open_voice("espeak", "en")
    started = time.perf_counter()
    try:
        score = compile_text(Path(text).read_text(encoding="utf-8"), voice=voice, media=media)
    finally:
        voice.close()
    taken = time.perf_counter() - started
    Path(target).write_bytes(dumps(score))
    return {"seconds": taken, "duration": score.duration}


def cost(*scores: str) -> list[dict[str, float]]:
    """Seconds for the whole of each Score and for one window, each the median of rounds that take turns."""
    from scorebreath.curves.curve_set import curves
    from scorebreath.curves.rigs.table import rig_named
    from scorebreath.score.codec import loads

    rig = rig_named("arkit")
    loaded = [loads(Path(score).read_bytes(), score) for score in scores]
    sets = [curves(score) for score in loaded]

    def whole(index: int) -> None:
        set_ = curves(loaded[index])
        frames = np.arange(int(loaded[index].duration * FPS) + 1)
        for first in range(0, len(frames), BLOCK):
            rig.sample(set_, frames[first : first + BLOCK] / FPS)

    def windows(index: int) -> None:
        for start in np.linspace(0.0, loaded[index].duration - WINDOW, WINDOWS):
            rig.sample(sets[index], start + np.arange(0.0, WINDOW, 1 / FPS))

    places = range(len(scores))
    taken = [[(_timed(whole, place), _timed(windows, place) / WINDOWS) for place in places] for _ in range(ROUNDS)]
    return [
        {
            "duration": loaded[place].duration,
            "whole": median(row[place][0] for row in taken),
            "window": median(row[place][1] for row in taken),
        }
        for place in places
    ]


def naive(text: str, duration: str) -> float:
    """Seconds for a text and a length to curves, once: its way without recordings and models."""
    from openfacefx import generate_naive

    said = Path(text).read_text(encoding="utf-8")
    started = time.perf_counter()
    generate_naive(said, float(duration), fps=FPS)
    return time.perf_counter() - started


def _timed(call: Callable[[int], None], place: int) -> float:
    started = time.perf_counter()
    call(place)
    return time.perf_counter() - started


if __name__ == "__main__":
    commands: dict[str, Callable[..., Any]] = {"prepare": prepare, "cost": cost, "naive": naive}
    print(json.dumps(commands[sys.argv[1]](*sys.argv[2:])))
