"""A show on a real engine, which is killed in mid-breath: it goes on, and nothing of the Score is lost."""

from __future__ import annotations

import os
import shutil
import signal
import time
from pathlib import Path

import pytest

from scorebreath.engine.live.journal import Entry
from scorebreath.engine.live.making import sounder_named
from scorebreath.engine.live.process import StartedBackend
from scorebreath.live.show import Setting, Show
from scorebreath.score.events import Inspiration
from scorebreath.score.take import read_take
from tests.jackd import jack_server

PATIENCE = 90.0


@pytest.mark.jack
@pytest.mark.skipif(shutil.which("jackd") is None or shutil.which("scsynth") is None, reason="needs jackd and scsynth")
def test_an_engine_killed_in_mid_breath_takes_nothing_from_the_score(tmp_path: Path) -> None:
    entries: list[Entry] = []
    text = "One two three four five. Six seven eight nine ten, eleven and twelve. " * 3
    with (
        jack_server(synchronous=False),
        sounder_named("scsynth", journal=entries.append) as sounder,
        Show(Setting(voice="tone", take=tmp_path / "take"), sounder=sounder) as show,
    ):
        backend = sounder._backend
        assert isinstance(backend, StartedBackend) and backend.pid is not None
        show.desk.say(text)
        end = time.monotonic() + PATIENCE
        while not any(
            isinstance(event, Inspiration) and event.onset + 0.1 < show.now < event.end for event in show.score().events
        ):
            assert time.monotonic() < end
            time.sleep(0.01)
        os.kill(backend.pid, signal.SIGKILL)
        killed = show.now
        show.desk.command("end")
        assert show.wait(PATIENCE)
        status = sounder.status()
        performed = show.score()
    assert status.restarts == 1
    assert " ".join(" ".join(group.text for group in performed.groups).split()) == text.strip()
    assert read_take(tmp_path / "take") == performed
    after = [entry for entry in entries if entry.kind == "sound" and entry.time > killed]
    groups = {group.id for group in performed.groups}
    heard = {entry.event.split(".speech")[0] for entry in after if ".speech" in entry.event}
    assert len(heard & groups) >= 3, "it goes on with the groups that follow"
