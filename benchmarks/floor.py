"""The least that rendering a text can take: eSpeak NG as it is used, pitch once a group, and the engine's own run.

python -m benchmarks.floor prepare TEXT FOLDER    render, and keep what the voice and the engine were asked for
python -m benchmarks.floor run FOLDER             do just that again, one after the other; seconds as JSON
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

PITCH_STEP = 0.005
"""Seconds."""


def prepare(text: Path, folder: Path) -> None:
    """Render a text once, listening at the doors of the voice's worker and of the engine."""
    from scorebreath.engine import offline
    from scorebreath.speech.worker import Worker
    from scorebreath_cli.main import main

    asked: list[dict[str, Any]] = []
    runs: list[dict[str, Any]] = []
    send, engine_run = Worker.send, offline.run

    def listen(self: Worker, fields: Any, *rest: Any, **options: Any) -> int:
        if fields["do"] == "speak" and fields["pitch"] is not None:
            asked.append({"text": fields["text"], "settings": fields["settings"]})
        return send(self, fields, *rest, **options)

    def keep(engine: Any, place: Path, **options: Any) -> Path:
        kept = folder / f"engine-{place.name}"  # several at once
        shutil.copytree(place, kept)
        runs.append({"place": str(kept), "rate": options["sample_rate"], "buffers": options["needs"].buffers})
        return engine_run(engine, place, **options)

    Worker.send = listen  # type: ignore[method-assign]
    offline.run = keep
    sys.argv = ["scorebreath", "render", str(text), "-o", str(folder / "out")]
    try:
        main()
    except SystemExit as end:
        if end.code:
            raise
    (folder / "asked.json").write_text(json.dumps({"speech": asked, "engine": runs}))


def run(folder: Path) -> dict[str, float]:
    """Seconds for each of the three."""
    import numpy as np
    import parselmouth

    from scorebreath.engine.engines import engine_named
    from scorebreath.speech.espeak.launch import installed
    from scorebreath.speech.espeak.library import SAMPLE_RATE, Settings

    told = json.loads((folder / "asked.json").read_text())
    library, command = installed(), engine_named("embedded").command()
    os.chdir(folder)
    started = time.perf_counter()
    sounds = [library.synthesise(one["text"], Settings(**one["settings"]))[0] for one in told["speech"]]
    spoken = time.perf_counter()
    for sound in sounds:
        samples = np.frombuffer(sound, dtype=np.int16) / 32768
        parselmouth.Sound(samples, SAMPLE_RATE).to_pitch(PITCH_STEP)
    measured = time.perf_counter()
    for one in told["engine"]:
        flags = ["-N", "score.osc", "_", "again.raw", one["rate"], "RAW", "float", "-o", "1", "-i", "0", "-D", "0"]
        subprocess.run(
            [*command, *map(str, flags), "-b", str(max(1024, one["buffers"]))],
            cwd=one["place"], check=True, stdout=subprocess.DEVNULL,
        )  # fmt: skip
    ended = time.perf_counter()
    return {"espeak": spoken - started, "pitch": measured - spoken, "engine": ended - measured}


if __name__ == "__main__":
    if sys.argv[1] == "prepare":
        prepare(Path(sys.argv[2]), Path(sys.argv[3]))
    else:
        print(json.dumps(run(Path(sys.argv[2]))))
