"""What a minute costs, stage by stage, in a process of its own.

    python -m benchmarks.growth TEXT FOLDER    seconds of each stage and minutes of sound, as JSON

Stages that take turns (reading, planning, speaking, composing) are told apart by what is running when; what the voice's
worker does beside them counts as `speak` only while it is waited for.
"""

from __future__ import annotations

import gc
import json
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")


class Clock:
    """Time by stage; a stage inside another stops the outer one's clock."""

    def __init__(self) -> None:
        """Nothing runs."""
        self.seconds: Counter[str] = Counter()
        self._running: list[str] = []
        self._since = time.perf_counter()

    def timed(self, stage: str, call: Callable[..., T]) -> Callable[..., T]:
        """The call, its time booked."""

        def run(*arguments: Any, **options: Any) -> T:
            self._switch(stage)
            try:
                return call(*arguments, **options)
            finally:
                self._switch(None)

        return run

    def stepped(self, stage: str, call: Callable[..., Iterable[T]]) -> Callable[..., Iterator[T]]:
        """The generator, the time of each of its steps booked."""

        def run(*arguments: Any, **options: Any) -> Iterator[T]:
            steps = iter(call(*arguments, **options))
            step = self.timed(stage, lambda: next(steps, None))
            while (item := step()) is not None:
                yield item

        return run

    def _switch(self, stage: str | None) -> None:
        now = time.perf_counter()
        if self._running:
            self.seconds[self._running[-1]] += now - self._since
        self._since = now
        if stage is None:
            self._running.pop()
        else:
            self._running.append(stage)


def measure(text: Path, folder: Path) -> dict[str, Any]:
    """Render a text to everything, one stage after the other."""
    from scorebreath import pipeline
    from scorebreath.curves.curve_set import curves
    from scorebreath.engine.offline import render
    from scorebreath.formats import curves_csv, curves_json, groups_csv
    from scorebreath.media.store import FolderStore
    from scorebreath.report.preview import write_preview
    from scorebreath.report.timeline import write_timeline
    from scorebreath.score.files import load, save
    from scorebreath.speech.voices import open_voice
    from scorebreath_cli.main import COLLECTIONS

    gc.set_threshold(*COLLECTIONS)  # as the command line does
    clock = Clock()
    pipeline.read = clock.timed("read", pipeline.read)
    pipeline.plan_script = clock.stepped("plan", pipeline.plan_script)
    pipeline.speak = clock.stepped("speak", pipeline.speak)
    media = FolderStore(folder)
    voice = open_voice("espeak", "en")
    try:
        said = text.read_text(encoding="utf-8")
        score = clock.timed("compose", pipeline.compile_text)(said, voice=voice, media=media)
    finally:
        voice.close()
    clock.timed("save", save)(score, folder / "score.json", media)
    clock.timed("load", load)(folder / "score.json")

    def into(name: str, write: Callable[..., Any], *arguments: Any) -> None:
        with (folder / name).open("wb") as stream:
            clock.timed(name, write)(stream, *arguments)

    with (folder / "mix.wav").open("wb") as stream:
        clock.timed("mix.wav", render)(score, media, stream)
    curve_set = clock.timed("curves", curves)(score)
    into("curves.csv", curves_csv.write, curve_set, score.duration, Fraction(60))
    into("curves.json", curves_json.write, curve_set, score.duration, Fraction(60))
    into("groups.csv", groups_csv.write, score)
    into("timeline.png", write_timeline, score, curve_set)
    into("preview.html", write_preview, score, curve_set, folder / "mix.wav")
    return {"minutes": score.duration / 60, "stages": dict(clock.seconds)}


if __name__ == "__main__":
    print(json.dumps(measure(Path(sys.argv[1]), Path(sys.argv[2]))))
