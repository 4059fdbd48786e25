"""What cuts cost the curves: an hour that is interrupted a thousand times, beside the same hour without cuts.

python -m benchmarks.cuts [CUTS]    s for both, reading the Score and 60 frames a second of all channels, as JSON
"""

from __future__ import annotations

import dataclasses
import json
import sys
import time
from statistics import median
from typing import Any

import numpy as np

HOUR = 3600.0
CUTS = 1000
FPS = 60
BLOCK = 4096
"""Frames at a time, as the writers of files do."""
ROUNDS = 3
TEXT = "Good evening :-) Low pressure moves in from the west tonight, and with it comes a band of heavy rain."
FADE, BACK = 0.05, 0.5
"""s; of each cut's sound, and in which the breath goes back to rest"""


def said() -> Any:
    """A sentence or two, as the tone voice says them."""
    from scorebreath.media.store import MemoryStore
    from scorebreath.pipeline import compile_text
    from scorebreath.speech.voices import open_voice

    voice = open_voice("tone", "en")
    try:
        return compile_text(TEXT, voice=voice, media=MemoryStore())
    finally:
        voice.close()


def hour(cuts: int) -> Any:
    """An hour in which it is said again and again; interrupted so many times, half a second before its end."""
    from scorebreath.curves.curve_set import curves
    from scorebreath.score.events import Cut, Expiration, Inspiration
    from scorebreath.units import snap

    one = said()
    last = max(event.end for event in one.events)
    length = snap(HOUR / cuts) if cuts else snap(last + 0.5)
    stop = snap(min(length, last) - BACK)
    volume = snap(float(curves(one).sample([stop], ["lung_volume"])[0, 0]))
    rest = one.bodies[0].person.resting_volume
    breath = next(one.of(Inspiration))
    events: list[Any] = []
    for number in range(int(HOUR / length)):
        begin, name = snap(number * length), f"n{number}"
        own = [
            dataclasses.replace(event, id=f"{name}.{event.id}", onset=snap(begin + event.onset), group=None)
            for event in one.events
            if event.duration > 0
        ]
        events += own
        if cuts:
            at = snap(begin + stop)
            ended = tuple(event.id for event in own if event.end > at)
            events.append(Cut(id=name, body="body", onset=at, duration=FADE, fade=FADE, targets=ended))
            events.append(
                Expiration(
                    id=f"{name}.out", body="body", onset=at, duration=BACK, from_volume=volume, to_volume=rest,
                    profile="sine", thorax_share=breath.thorax_share, motion=breath.motion,
                )
            )  # fmt: skip
    return dataclasses.replace(one, events=tuple(events), groups=(), duration=HOUR)


def cost(score: Any) -> tuple[float, float]:
    """Seconds to read a Score, and to sample all of it."""
    from scorebreath.curves.curve_set import curves

    started = time.perf_counter()
    found = curves(score)
    read = time.perf_counter() - started
    frames = np.arange(int(HOUR * FPS))
    for first in range(0, len(frames), BLOCK):
        found.sample(frames[first : first + BLOCK] / FPS)
    return read, time.perf_counter() - started


def compared(cuts: int) -> dict[str, float]:
    """Both, each the median of rounds that take turns, and how many times as much the cuts take."""
    with_cuts, without = hour(cuts), hour(0)
    rows = [(*cost(with_cuts), *cost(without)) for _ in range(ROUNDS)]
    read, whole, read_plain, whole_plain = (median(row[column] for row in rows) for column in range(4))
    return {
        "cuts": float(cuts), "read": read, "whole": whole, "read without": read_plain, "whole without": whole_plain,
        "ratio": whole / whole_plain,
    }  # fmt: skip


if __name__ == "__main__":
    print(json.dumps(compared(int(sys.argv[1]) if len(sys.argv) > 1 else CUTS)))
