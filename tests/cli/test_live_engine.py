"""`live` and `doctor --sound` with an engine that sounds, on a JACK server without a sound card."""

from __future__ import annotations

import os
import signal
import subprocess
from pathlib import Path

from scorebreath.score.events import Command
from scorebreath.score.files import load
from tests.cli.performances import PATIENCE, program, told
from tests.cli.running import ENVIRONMENT
from tests.jackd import jack_server, needs_jack

pytestmark = needs_jack


def environment() -> dict[str, str]:
    """With the JACK server that is in use now."""
    return {**ENVIRONMENT, **{name: value for name, value in os.environ.items() if name.startswith("JACK")}}


def test_ctrl_c_in_a_terminal_stops_the_voice_and_not_the_engine(tmp_path: Path) -> None:
    """A terminal sends it to the whole group of processes; the engine has still to let the breath go."""
    (tmp_path / "in.txt").write_text("This goes on and on, and on and on, for quite a while. " * 40)
    line = ("live", "in.txt", "--engine", "scsynth", "--voice", "tone", "--no-osc", "--json", "--take", "take")
    with (
        jack_server(),
        program(*line, cwd=tmp_path, env=environment(), stdin=subprocess.DEVNULL, start_new_session=True) as process,
    ):
        before = told(process, "group")
        os.killpg(process.pid, signal.SIGINT)
        after = told(process)
        assert process.wait(PATIENCE) == 130
    assert before[0]["engine"].startswith("scsynth")
    assert not [event for event in (*before, *after) if event["event"] == "trouble"]
    assert after[-2]["event"] == "ended"
    assert after[-2]["engine"]["restarts"] == 0
    assert "stop" in {event.name for event in load(tmp_path / "take")[0].of(Command)}


def test_doctor_says_when_no_click_comes_back() -> None:
    with jack_server(), program("doctor", "--sound", "--engine", "scsynth", "--json", env=environment()) as process:
        sound, last = told(process)
        assert process.wait(PATIENCE) == 0
    assert (sound["event"], sound["round_trip"], last["measured"]) == ("sound", None, False)
    assert "no click came back" in sound["about"]


def test_doctor_says_when_there_is_no_device() -> None:
    nowhere = {**ENVIRONMENT, "JACK_NO_START_SERVER": "1", "JACK_DEFAULT_SERVER": f"none-{os.getpid()}"}
    with program("doctor", "--sound", "--engine", "scsynth", env=nowhere) as process:
        _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 3
    assert said.startswith(b"scorebreath: ")
    assert b"Traceback" not in said
