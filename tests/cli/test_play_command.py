"""`scorebreath play`: from anywhere, over and over, with its curves."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from pathlib import Path
from threading import Event

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.errors import ScoreError
from scorebreath.media.store import MediaStore, MemoryStore
from scorebreath.score.document import Score
from scorebreath.score.files import load
from scorebreath_cli.performing.transport import Transport
from tests.cli.performances import PATIENCE, Screen, program
from tests.cli.running import ENVIRONMENT, events, run, spawn

SILENT = ("--engine", "silent")


@pytest.fixture(scope="module")
def score(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A Score of some five seconds."""
    folder = tmp_path_factory.mktemp("score")
    (folder / "in.txt").write_text("Yes, of course. [breath] And then we all went home.")
    made = run("compile", folder / "in.txt", "-o", folder / "score.json", "--voice", "tone", "--lead", 0, "--tail", 0)
    assert made.exit_code == 0, made.stderr
    return folder / "score.json"


def test_a_score_is_played_with_its_curves(score: Path, tmp_path: Path) -> None:
    done = spawn("play", score, *SILENT, "--json", "--to", f"jsonl:{tmp_path / 'c.jsonl'}", "--curve-rate", 20)
    assert done.returncode == 0, done.stderr
    first, ended, last = (events(done.stdout)[place] for place in (0, -2, -1))
    loaded, _ = load(score)
    assert (first["event"], first["duration"], first["engine"]) == ("started", loaded.duration, "silent")
    assert (ended["complete"], last["status"]) == (True, 0)
    assert ended["engine"]["sent"] > 0
    pictures = [json.loads(line) for line in (tmp_path / "c.jsonl").read_text("utf-8").splitlines()]
    assert ended["curves"] == [{"target": f"jsonl:{tmp_path / 'c.jsonl'}", "sent": len(pictures), "skipped":
                                ended["curves"][0]["skipped"], "failed": 0}]  # fmt: skip
    numbers = [picture["number"] for picture in pictures]
    assert numbers == sorted(set(numbers))
    made = curves(loaded)
    wanted = made.sample([number / 20 for number in numbers])
    shown = np.array([[picture["channels"][name] for name in made.channels] for picture in pictures])
    assert np.max(np.abs(wanted - shown)) <= 1e-6


def test_it_begins_in_the_middle(score: Path, tmp_path: Path) -> None:
    start = load(score)[0].duration - 0.5
    done = spawn("play", score, *SILENT, "--start", start, "--to", f"jsonl:{tmp_path / 'c.jsonl'}", "--json")
    assert done.returncode == 0, done.stderr
    times = [json.loads(line)["time"] for line in (tmp_path / "c.jsonl").read_text("utf-8").splitlines()]
    assert min(times) > start - 0.1


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_it_is_played_over_and_over_until_somebody_has_heard_enough(score: Path) -> None:
    line = ("play", score, *SILENT, "--loop", "--to", "-", "--curve-rate", "50")
    with program(*line, stdin=subprocess.DEVNULL) as process:
        assert process.stdout is not None
        before, rounds = -1.0, 0
        for told in process.stdout:
            now = json.loads(told)["time"]
            rounds += now < before
            before = now
            if rounds:
                break
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=PATIENCE)
    assert (rounds, process.returncode) == (1, 130)
    assert b"interrupted" in said
    assert b"Traceback" not in said


WRONG: dict[str, tuple[list[str], str]] = {
    "start": (["--start", "100"], "--start 100"),
    "start before": (["--start", "-1"], "--start -1"),
    "start nan": (["--start", "nan"], "--start nan"),
    "engine": (["--engine", "organ"], "organ"),
    "target": (["--to", "nowhere"], "nowhere"),
    "nobody": (["--to", "jsonl:out.jsonl?body=bidy"], "did you mean body?"),
    "no score": (["--debug"], "SCORE is missing"),
    "a script": (["in.txt"], "scorebreath compile"),
    "nothing": (["missing.json"], "missing.json"),
    "stdout twice": (["--to", "-", "--json"], "--to jsonl:FILE"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_refused_in_a_line(score: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.chdir(score.parent)
    options, said = WRONG[name]
    given = [] if name in ("no score", "a script", "nothing") else ["score.json"]
    result = run("play", *given, *([] if name == "engine" else SILENT), *options)
    assert result.exit_code == 2
    assert said in result.stdout + result.stderr
    assert not (score.parent / "out.jsonl").exists(), "what is refused leaves nothing behind"
    assert name == "no score" or len((result.stdout + result.stderr).splitlines()) == 1


def test_media_that_are_missing_are_said_before_anything_sounds(score: Path, tmp_path: Path) -> None:
    (tmp_path / "score.json").write_bytes(score.read_bytes())
    result = run("play", tmp_path / "score.json", *SILENT)
    assert (result.exit_code, len(result.stderr.splitlines())) == (2, 1)
    assert "missing" in result.stderr


@pytest.mark.skipif(os.name != "posix", reason="a terminal of POSIX")
def test_keys_pause_jump_loop_and_quit(score: Path) -> None:
    import pty
    import termios

    ours, theirs = pty.openpty()
    termios.tcsetwinsize(theirs, (20, 90))
    before = termios.tcgetattr(theirs)
    screen = Screen(ours)
    environment = {k: v for k, v in ENVIRONMENT.items() if k != "COLUMNS"} | {"TERM": "xterm"}
    ends = {"stdin": theirs, "stdout": theirs, "stderr": theirs}
    with program("play", score, *SILENT, "--loop", env=environment, start_new_session=True, **ends) as process:
        screen.wait_until(lambda frame: "Space pauses" in frame and "  loop" in frame)
        screen.type(" ")
        screen.wait_until(lambda frame: "paused" in frame)
        screen.type("\x1b[C")  # to the end
        screen.wait_until(lambda frame: "0:05  paused" in frame)
        screen.type("\x1b[Dl")
        screen.wait_until(lambda frame: "0:00  paused" in frame and "  loop" not in frame)
        screen.type(" ")
        screen.wait_until(lambda frame: "speaks" in frame and "paused" not in frame)
        screen.type("q")
        assert process.wait(PATIENCE) == 0
        assert termios.tcgetattr(theirs) == before
    os.close(theirs)
    os.close(ours)


class Held:
    """In place of the engine's player: stays as long as it is told, and says where it is."""

    def __init__(self) -> None:
        self.calls: list[tuple[float, bool]] = []
        self.ends = Event()
        self.problem: Exception | None = None

    def play_score(
        self, score: Score, media: MediaStore, sounder: object, *, start: float, loop: bool, on_time: object,
        stopped: Event,
    ) -> bool:  # fmt: skip
        self.calls.append((start, loop))
        if self.problem:
            raise self.problem
        while not stopped.wait(0.005):
            if self.ends.is_set():
                self.ends.clear()
                return True
        return False


@pytest.fixture
def held(monkeypatch: pytest.MonkeyPatch) -> Held:
    made = Held()
    monkeypatch.setattr("scorebreath.engine.player.play_score", made.play_score)
    return made


def settle(transport: Transport, *, playing: bool) -> None:
    until = time.monotonic() + PATIENCE
    while transport.playing is not playing:
        assert time.monotonic() < until
        transport.look()
        time.sleep(0.005)


def test_a_transport_goes_where_it_is_told(score: Path, held: Held) -> None:
    loaded, media = load(score)
    transport = Transport(loaded, media, None, start=1.0, loop=False)  # type: ignore[arg-type]
    assert (transport.position, transport.playing, transport.over) == (1.0, False, False)
    transport.play()
    transport.play()  # once is enough
    transport.seek(2.5)
    transport.pause()
    assert (transport.position, transport.playing) == (2.5, False)
    transport.seek(-3.0)
    assert transport.position == 0.0
    transport.seek(1e9)
    assert transport.position == loaded.duration
    transport.play()  # from the beginning, as nothing is left
    transport.pause()
    assert held.calls == [(1.0, False), (2.5, False), (0.0, False)]
    assert not transport.over


def test_a_transport_comes_to_its_end_or_begins_again(score: Path, held: Held) -> None:
    loaded, media = load(score)
    transport = Transport(loaded, media, None, start=0.0, loop=False)  # type: ignore[arg-type]
    transport.play()
    transport.loop = True  # while it plays: at the end it begins again
    held.ends.set()
    until = time.monotonic() + PATIENCE
    while len(held.calls) < 2:
        assert time.monotonic() < until
        transport.look()
    assert (held.calls, transport.over) == ([(0.0, False), (0.0, True)], False)
    transport.loop = False
    held.ends.set()
    settle(transport, playing=False)
    assert (transport.over, transport.position) == (True, loaded.duration)


def test_what_goes_wrong_while_it_plays_is_raised(score: Path, held: Held) -> None:
    transport = Transport(load(score)[0], MemoryStore(), None, start=0.0, loop=False)  # type: ignore[arg-type]
    held.problem = ScoreError("media are gone")
    transport.play()
    with pytest.raises(ScoreError, match="gone"):
        settle(transport, playing=False)
