"""A text compiled, and compiled again with another way of breathing: imports aside, in one process.

python -m benchmarks.again TEXT VOICE FOLDER    seconds of the first and the second time, as JSON
"""

from __future__ import annotations

import gc
import json
import sys
import time
from pathlib import Path
from typing import Any

WARM = "One two."


def measure(text: str, name: str, folder: Path) -> dict[str, Any]:
    """Compile a text twice, each time with a voice that was just opened, its process included."""
    from scorebreath.media.store import FolderStore
    from scorebreath.parameters.table import Parameters
    from scorebreath.pipeline import compile_text
    from scorebreath.speech.cache.shelf import Shelf
    from scorebreath.speech.cache.voice import CachedVoice
    from scorebreath.speech.voices import open_voice
    from scorebreath_cli.main import COLLECTIONS

    gc.set_threshold(*COLLECTIONS)  # as the command line does

    def once(what: str, nose_share: float, shelf: Path, media: Path) -> tuple[float, int, int]:
        begun = time.perf_counter()
        voice = CachedVoice(open_voice(name, "en"), Shelf(shelf))
        store = FolderStore(media)
        with voice:
            compile_text(what, voice=voice, media=store, parameters=Parameters(nose_share=nose_share))
        return time.perf_counter() - begun, voice.spoken, voice.kept

    once(WARM, 1.0, folder / "warm", folder / "warm-media")  # modules and tables of this process
    first, spoken, _ = once(text, 1.0, folder / "kept", folder / "one")
    again, anew, kept = once(text, 0.4, folder / "kept", folder / "two")
    if anew or kept < spoken:
        raise SystemExit(f"{anew} groups were spoken again, {kept} remembered of {spoken}")
    return {"first": first, "again": again, "groups": spoken}


if __name__ == "__main__":
    print(json.dumps(measure(Path(sys.argv[1]).read_text(encoding="utf-8"), sys.argv[2], Path(sys.argv[3]))))
