"""A show on the wall clock, with real threads and a real voice: what was performed is what is written."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.engine.live.journal import Entry
from scorebreath.engine.live.making import sounder_named
from scorebreath.engine.onsets import onsets
from scorebreath.errors import EnvironmentFailure, InputError
from scorebreath.live.show import Setting, Show
from scorebreath.media.store import FolderStore
from scorebreath.score.cutting import endings
from scorebreath.score.document import Score
from scorebreath.score.events import Utterance, WarningEvent
from scorebreath.score.take import TAKE_FILE, read_take
from scorebreath.speech.espeak.voice import EspeakVoice
from scorebreath.speech.model import Voice
from scorebreath.speech.voices import open_voice
from scorebreath.units import frame_count

PATIENCE = 60.0
"""s after which something is broken."""


def until(condition: Callable[[], bool]) -> None:
    """Wait until something is so."""
    begun = time.monotonic()
    while not condition():
        assert time.monotonic() - begun < PATIENCE
        time.sleep(0.02)


def said(show: Show) -> int:
    return sum(isinstance(event, Utterance) for event in show.score().events)


def test_a_scripted_performance_is_its_take(tmp_path: Path) -> None:
    """Events, sounds and curves: as they were performed, as they are read back."""
    journal: list[Entry] = []
    told: list[str] = []
    streamed: dict[float, np.ndarray] = {}
    take = tmp_path / "take"
    with (
        sounder_named("silent", journal=journal.append) as sounder,
        Show(Setting(voice="tone", take=take), sounder=sounder, tell=told.append) as show,
    ):
        show.desk.say("Good evening. Rain moves in from the west, and by the morning it will be here.")
        until(lambda: show.now > 1.2)
        show.desk.set("nose_share", 0.9, glide=0.3)
        until(lambda: show.now > 2.0)
        show.desk.command("sigh")
        until(lambda: show.now > 5.0)
        show.desk.say("No, listen!", cut_in=True)
        for _ in range(20):
            at = show.now
            streamed[at] = show.ledger.curves("body").sample([at])[0]
            time.sleep(0.05)
        show.desk.command("end")
        assert show.wait(PATIENCE)
        performed, status = show.score(), sounder.status()
    again = read_take(take)
    assert again == performed
    assert again.duration == show.performance.over
    final = curves(again)
    assert all(np.array_equal(values, final.sample([at])[0]) for at, values in streamed.items())
    _same_sounds(again, journal, status.lost)
    media = FolderStore(take)
    assert all(name in media for name in again.media)


def _same_sounds(score: Score, journal: list[Entry], lost: int) -> None:
    """What the engine was told to play is what an offline run of the take plays, on the same frames.

    Where the machine was too busy to tell it in time, a sound is later than it should be, or lost: each is counted.
    """
    rate = 48000
    ends = endings(score.events)
    sounds = [entry for entry in journal if entry.kind == "sound"]
    taken_back = {(entry.event, entry.instrument) for entry in journal if entry.kind == "free"}
    apart = taken_back | {(entry.event, entry.instrument) for entry in sounds if entry.late > 0}
    played = ((frame_count(o.time, rate), o.event, o.instrument) for o in onsets(score) if o.duration > 0)
    wanted = Counter(sound for sound in played if sound[1:] not in apart)
    told = Counter(
        (entry.frame, entry.event, entry.instrument)
        for entry in sounds
        if not (entry.event in ends and entry.frame >= frame_count(ends[entry.event].time, rate))
        and (entry.event, entry.instrument) not in apart
    )
    assert told <= wanted
    assert (wanted - told).total() <= lost
    assert told.total() > 10, "a machine that is too busy for any of this shows nothing"
    start = {entry.tag - (2 * entry.frame + 1) * 2**32 // (2 * rate) for entry in journal if entry.late == 0}
    assert max(start) - min(start) < 2**32 // rate, "all tags count from one beginning"


def test_a_voice_whose_worker_dies_goes_on(tmp_path: Path) -> None:
    voices: list[EspeakVoice] = []

    def opened(name: str, language: str) -> Voice:
        voice = open_voice(name, language)
        assert isinstance(voice, EspeakVoice)
        voices.append(voice)
        return voice

    with sounder_named("silent") as sounder, Show(Setting(), sounder=sounder, open_voice=opened) as show:
        show.desk.say("One two three four. " * 3)
        until(lambda: said(show) > 0)
        for pid in voices[0].pids:
            os.kill(pid, signal.SIGKILL)
        show.desk.say("And five, and six, and seven.")
        show.desk.command("end")
        assert show.wait(PATIENCE)
        score = show.score()
    text = " ".join(" ".join(group.text for group in score.groups).split())
    assert text.endswith("And five, and six, and seven.")
    assert text.count("One two three four.") == 3
    assert not [event for event in score.of(WarningEvent) if event.code == "unspoken"]


def test_a_killed_process_leaves_its_take(tmp_path: Path) -> None:
    take = tmp_path / "take"
    program = textwrap.dedent(
        f"""
        import time
        from pathlib import Path
        from scorebreath.engine.live.making import sounder_named
        from scorebreath.live.show import Setting, Show
        show = Show(Setting(voice="tone", take=Path({str(take)!r})), sounder=sounder_named("silent"))
        show.desk.say("One two three four five. Six seven eight nine ten. " * 20)
        while sum(event.type == "utterance" for event in show.score().events) < 2:
            time.sleep(0.02)
        print("now", flush=True)
        time.sleep(60)
        """
    )
    roots = [str(root) for root in (Path.cwd(), Path.cwd() / "cli", Path.cwd() / "synthdefs")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(roots)}
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, env=environment, text=True)
    assert process.stdout is not None
    try:
        assert process.stdout.readline() == "now\n"
    finally:
        process.kill()
        process.wait()
        process.stdout.close()
    score = read_take(take)
    assert sum(isinstance(event, Utterance) for event in score.events) >= 2
    assert score.text.startswith("One two three four five.")
    media = FolderStore(take)
    assert all(name in media for name in score.media)
    assert curves(score).sample([1.0]).shape[0] == 1
    with (take / TAKE_FILE).open("ab") as stream:
        stream.write(b'{"type": "utter')
    assert any(event.code == "torn-take" for event in read_take(take).of(WarningEvent))


def test_what_cannot_begin_says_why(tmp_path: Path) -> None:
    with sounder_named("silent") as sounder:
        with pytest.raises(InputError, match="unknown"):
            Show(Setting(voice="nobody"), sounder=sounder)
        with pytest.raises(InputError, match="no model"):
            Show(Setting(voice="tone", model="supernatural"), sounder=sounder)
        (tmp_path / TAKE_FILE).write_text("{}")
        with pytest.raises(EnvironmentFailure, match="cannot be written"):
            Show(Setting(voice="tone", take=tmp_path), sounder=sounder)


def test_closing_ends_everything_at_once() -> None:
    with sounder_named("silent") as sounder:
        show = Show(Setting(voice="tone"), sounder=sounder)
        show.desk.say("One two three four five. " * 50)
        until(lambda: said(show) > 0)
        show.close()
        assert not show.running
        show.close()


def test_two_bodies_speak_in_turn() -> None:
    with (
        sounder_named("silent") as sounder,
        Show(Setting(voice="tone", cast={"espeak:en-us+f3": Setting().parameters}), sounder=sounder) as show,
    ):
        assert show.desk.bodies == ("body", "body2")
        show.desk.say("How are you?")
        show.desk.say("I am well.", body="body2")
        show.desk.say("[voice espeak:en-us+f3]And you?[/voice] Well enough.")
        show.desk.command("end")
        assert show.wait(PATIENCE)
        groups = show.score().groups
    assert [group.body for group in groups] == ["body", "body2", "body2", "body"]
    assert [" ".join(group.text.split()) for group in groups] == [
        "How are you?",
        "I am well.",
        "And you?",
        "Well enough.",
    ]
