"""The engine makes the next piece while one is taken; what it works for may end early."""

from __future__ import annotations

import io
import sys
import tempfile
import threading
import time
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scorebreath.engine import offline
from scorebreath.engine.engines import Embedded, Engine
from scorebreath.engine.offline import render
from scorebreath.engine.run import run
from scorebreath.engine.segments import segments
from scorebreath.errors import EngineError
from scorebreath.media.store import MemoryStore
from scorebreath.score.document import Score
from tests.engine.sounding import inspiration, noise, samples, score

BREATHS = 12
PATIENCE = 60.0


@pytest.fixture(autouse=True)
def short_pieces(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(offline, "segments", partial(segments, length=0.5))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))


def breaths() -> Score:
    return score([inspiration(0.1 + number, noise(seed=number + 1)) for number in range(BREATHS)], BREATHS + 0.5)


def test_what_is_heard_is_what_is_in_the_file(tmp_path: Path) -> None:
    heard: list[np.ndarray[tuple[int], np.dtype[np.float32]]] = []
    stream = io.BytesIO()
    render(breaths(), MemoryStore(), stream, encoding="float32", on_samples=lambda block: heard.append(block.copy()))
    written, _ = samples(stream.getvalue())
    np.testing.assert_array_equal(np.concatenate(heard), written)
    assert len(heard) > BREATHS
    assert not list(tmp_path.iterdir())


def test_few_pieces_are_on_the_disk_at_once(tmp_path: Path) -> None:
    most = 0

    def count(_: object) -> None:
        nonlocal most
        most = max(most, sum(1 for _ in tmp_path.glob("scorebreath-*/*")))

    render(breaths(), MemoryStore(), io.BytesIO(), on_samples=count)
    assert 1 <= most <= 1 + offline.AHEAD


def test_an_engine_nobody_waits_for_is_stopped(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    stopped: list[EngineError] = []
    own = run

    def slow_after_the_first(engine: Engine, place: Path, **options: Any) -> Path:
        if place.name == "0":
            return own(engine, place, **options)
        try:
            return own(Endless(), place, **options)
        except EngineError as error:
            stopped.append(error)
            raise

    class Endless(Embedded):
        def command(self) -> tuple[str, ...]:
            return (sys.executable, "-c", "import time; time.sleep(600)")

    def full(_: object) -> None:
        raise OSError("no room")

    monkeypatch.setattr(offline, "run", slow_after_the_first)
    started = time.monotonic()
    with pytest.raises(OSError, match="no room"):
        render(breaths(), MemoryStore(), io.BytesIO(), on_samples=full)
    assert time.monotonic() - started < PATIENCE
    assert {str(error) for error in stopped} == {"the embedded engine was stopped"}
    assert not list(tmp_path.iterdir())
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("engine")]
