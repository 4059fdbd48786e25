"""A voice's process is started before the voice is loaded, and is the one that it then uses."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from scorebreath.errors import InputError
from scorebreath.speech import process
from scorebreath.speech.espeak.launch import installed, worker_command
from scorebreath.speech.espeak.voice import EspeakVoice
from scorebreath.speech.voices import open_voice

SILENT = (sys.executable, "-c", "import sys; sys.stdin.read()")


def test_the_process_started_ahead_is_the_one_that_is_used() -> None:
    process.start_ahead(SILENT)
    process.start_ahead(SILENT)
    first, second = process.start(SILENT), process.start(SILENT)
    try:
        assert SILENT not in process._ahead
        assert first.pid != second.pid
    finally:
        for one in (first, second):
            one.kill()
            one.end()


def test_an_opened_voice_uses_up_what_was_started_for_it() -> None:
    with open_voice("espeak:de", "de") as voice:
        assert isinstance(voice, EspeakVoice)
        assert len(voice.pids) == 1
        assert worker_command(installed()) not in process._ahead


def test_a_voice_that_is_refused_leaves_nothing_behind_at_the_end() -> None:
    code = (
        "from scorebreath.errors import InputError\n"
        "from scorebreath.speech import process, voices\n"
        "try:\n"
        "    voices.open_voice('espeak', 'xx')\n"
        "except InputError:\n"
        "    (kept,) = process._ahead.values()\n"
        "    print(kept.pid)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True)
    with pytest.raises(ProcessLookupError):
        os.kill(int(done.stdout), 0)


def test_the_next_voice_takes_what_a_refused_one_left() -> None:
    with pytest.raises(InputError):
        open_voice("espeak", "xx")
    (kept,) = process._ahead.values()
    with open_voice("espeak", "en") as voice:
        assert isinstance(voice, EspeakVoice)
        assert voice.pids == (kept.pid,)
