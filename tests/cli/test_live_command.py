"""`scorebreath live`: what is said, kept, told and ended, as somebody runs it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scorebreath.curves.curve_set import curves
from scorebreath.engine.live.timing import EPOCH
from scorebreath.engine.onsets import onsets
from scorebreath.score.codec import dumps, loads
from scorebreath.score.events import Command, Cut, Utterance
from scorebreath.score.files import load
from tests.cli.performances import PATIENCE, QUIET, Screen, journal, performance, program, told
from tests.cli.running import ENVIRONMENT, events, run, spawn

SHORT = ("--lead", 0, "--tail", 0)
LONG = "This goes on and on, and on and on, for quite a while. " * 40


@pytest.fixture(scope="module")
def performed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two files said one behind the other, kept as a take; what was told and streamed lies beside it."""
    folder = tmp_path_factory.mktemp("performed")
    (folder / "one.txt").write_text("Yes. [breath] Yes.")
    (folder / "two.ssml").write_text("<speak>No, <amazon:breath/> no.</speak>")
    done = spawn(
        "live", *QUIET, "one.txt", "two.ssml", *SHORT, "--take", "take", "--no-breath-sound", "--json",
        "--to", "jsonl:curves.jsonl", "--curve-rate", "30", cwd=folder, stdin=subprocess.DEVNULL,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    (folder / "told.jsonl").write_bytes(done.stdout)
    return folder


def test_files_are_said_in_their_order_and_told(performed: Path) -> None:
    found = events((performed / "told.jsonl").read_bytes())
    assert [event["text"] for event in found if event["event"] == "group"] == ["Yes.", "Yes.", "No,", "no."]
    said, _ = load(performed / "take")
    assert [event["onset"] for event in found if event["event"] == "group"] == [e.onset for e in said.of(Utterance)]
    assert [found[0]["event"], found[-2]["event"], found[-1]["event"]] == ["started", "ended", "done"]
    assert (found[0]["engine"], found[0]["take"], found[0]["voice"]) == ("silent", "take", "tone")
    ended = found[-2]
    assert (ended["groups"], ended["unspoken"], ended["engine"]["lost"]) == (4, 0, 0)
    assert ended["late"] == sum(event["event"] == "late" for event in found)
    assert ended["engine"]["alive"]
    assert ended["curves"][0]["sent"] == len((performed / "curves.jsonl").read_text("utf-8").splitlines()) > 0
    assert found[-1]["status"] == 0


def test_the_take_rendered_is_the_performance(performed: Path, tmp_path: Path) -> None:
    assert run("render", performed / "take", "-o", tmp_path / "out").exit_code == 0
    taken, media = load(performed / "take")
    assert loads((tmp_path / "out" / "score.json").read_bytes()) == loads(dumps(taken))
    told_engine = [entry for entry in journal(performed / "take") if entry["kind"] == "sound"]
    samples, rate = soundfile.read(tmp_path / "out" / "mix.wav")
    wanted = [(sound.event, round(sound.time * rate)) for sound in onsets(taken)]
    assert [entry["event"] for entry in told_engine] == [event for event, _ in wanted]
    in_time = [place for place, entry in enumerate(told_engine) if not entry["late"]]  # all, unless the machine is busy
    assert [told_engine[place]["frame"] for place in in_time] == [wanted[place][1] for place in in_time]
    assert len(wanted) == 4
    assert len(samples) == round(taken.duration * rate)
    loud = np.flatnonzero(np.atleast_2d(samples.T)[0])
    for (_, frame), event in zip(wanted, taken.of(Utterance), strict=True):
        assert not np.any(np.abs(loud - frame + 100) < 100)  # the silence before
        held = media.get(event.media)
        begins = np.flatnonzero(held.samples)[0] * rate / held.sample_rate
        first = loud[np.searchsorted(loud, frame)]
        assert abs(first - frame - begins) <= 1


def test_time_tags_are_the_scores_times(performed: Path) -> None:
    start = events((performed / "told.jsonl").read_bytes())[0]["start_unix"]
    for entry in journal(performed / "take"):
        happens = int(entry["tag"], 16) / 2**32 - EPOCH - start
        assert happens == pytest.approx(entry["time"] + entry["late"], abs=1.1 / 48000)
        assert entry["lead"] > 0


def test_curves_streamed_are_those_of_the_take(performed: Path) -> None:
    taken, _ = load(performed / "take")
    pictures = [json.loads(line) for line in (performed / "curves.jsonl").read_text("utf-8").splitlines()]
    times = [picture["number"] / 30 for picture in pictures]
    made = curves(taken)
    sampled = made.sample(times)
    streamed = [[picture["channels"][name] for name in made.channels] for picture in pictures]
    assert np.max(np.abs(sampled - np.array(streamed))) <= 1e-6
    assert times[-1] > taken.duration - 1.0


def test_stdin_is_said_as_it_comes(tmp_path: Path) -> None:
    """Pieces end anywhere, within words and characters too; what comes is said before the end is there."""
    with performance("--json", "--take", "take", *SHORT, cwd=tmp_path) as process:
        assert process.stdin is not None
        pieces = [b"Good eve", "ning, Zoë".encode()[:-1], "ë".encode()[1:] + b". And "]
        for piece in pieces:
            process.stdin.write(piece)
            process.stdin.flush()
            time.sleep(0.05)
        found = told(process, "group")  # while the pipe is still open
        assert found[-1]["text"].startswith("Good evening, Zoë.")
        process.stdin.write(b"bye.")
        process.stdin.close()
        found += told(process)
        assert process.wait(PATIENCE) == 0
    assert found[-1] == {"schema": "scorebreath.event/1", "event": "done", "status": 0}
    assert "".join(event["text"] for event in found if event["event"] == "group").replace(" ", "") == (
        "Goodevening,Zoë.Andbye."
    )
    taken, _ = load(tmp_path / "take")
    assert " ".join(taken.text.split()) == "Good evening, Zoë. And bye."


def test_what_is_no_text_is_left_out_and_said(tmp_path: Path) -> None:
    done = spawn("live", *QUIET, *SHORT, "-", "--json", cwd=tmp_path, input=b"Well \xff\xfe then.")
    assert done.returncode == 0
    found = events(done.stdout)
    assert any(event["event"] == "note" and "UTF-8" in event["text"] for event in found)
    assert any(event["event"] == "group" and event["text"] == "Well then." for event in found)


def test_a_document_that_is_wrong_is_bad_input(tmp_path: Path) -> None:
    done = spawn("live", *QUIET, *SHORT, "-", "--json", cwd=tmp_path, input=b"<speak>Good & evening</speak>")
    assert done.returncode == 2
    found = events(done.stdout)
    assert any(event["event"] == "note" and "<stdin>: 1:14: broken XML" in event["text"] for event in found)
    assert found[-1]["status"] == 2


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_an_interrupt_stops_gently_and_ends(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text(LONG)
    with performance("in.txt", "--json", "--take", "take", cwd=tmp_path, stdin=subprocess.DEVNULL) as process:
        told(process, "group")
        process.send_signal(signal.SIGINT)
        found = told(process)
        assert process.wait(PATIENCE) == 130
        assert process.stderr is not None
        assert b"Traceback" not in process.stderr.read()
    assert found[-1]["status"] == 130
    assert [event["event"] for event in found[-2:]] == ["ended", "done"]
    taken, _ = load(tmp_path / "take")
    assert [event.name for event in taken.of(Command)] == ["end", "stop"]  # the file was all there was
    assert taken.of(Cut)
    assert found[-2]["groups"] < 5


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_a_second_interrupt_ends_at_once(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text(LONG)
    with performance("in.txt", "--take", "take", "--tail", 30, cwd=tmp_path, stdin=subprocess.DEVNULL) as process:
        assert process.stderr is not None
        assert b"take" in process.stderr.readline()
        process.send_signal(signal.SIGINT)
        assert b"Ctrl-C again" in process.stderr.readline()
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 130
        said = process.stderr.read()
    assert b"interrupted" in said
    assert b"Traceback" not in said
    assert load(tmp_path / "take")[0].duration < 29


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
@pytest.mark.parametrize(("number", "status"), [(signal.SIGTERM, 143), (signal.SIGHUP, 129)])
@pytest.mark.parametrize("command", ["live", "play"])
def test_a_program_is_told_how_it_ended(
    performed: Path, tmp_path: Path, command: str, number: int, status: int
) -> None:
    (tmp_path / "in.txt").write_text(LONG)
    given = ("in.txt", *QUIET) if command == "live" else (performed / "take", *QUIET[:2])
    with program(command, *given, "--json", cwd=tmp_path, stdin=subprocess.DEVNULL) as process:
        told(process, "group" if command == "live" else "started")
        process.send_signal(number)
        found = told(process)
        assert process.wait(PATIENCE) == status
    assert [event["event"] for event in found[-2:]] == ["ended", "done"]
    assert found[-1]["status"] == status


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
@pytest.mark.parametrize(("number", "status"), [(signal.SIGTERM, 143), (signal.SIGKILL, -9)])
def test_whatever_ends_it_the_take_is_there(tmp_path: Path, number: int, status: int) -> None:
    (tmp_path / "in.txt").write_text(LONG)
    with performance("in.txt", "--json", "--take", "take", cwd=tmp_path, stdin=subprocess.DEVNULL) as process:
        told(process, "group")
        os.kill(process.pid, number)
        assert process.wait(PATIENCE) == status
        assert process.stderr is not None
        assert b"Traceback" not in process.stderr.read()
    with (tmp_path / "take" / "take.jsonl").open("ab") as stream:
        stream.write(b'{"type":"blink","id":"body.bl')  # as if it was hit in the middle of a line
    made = run("render", tmp_path / "take", "-o", tmp_path / "out")
    assert made.exit_code == 0
    assert "the last line was cut off (29 bytes) and is dropped" in made.stderr
    score = loads((tmp_path / "out" / "score.json").read_bytes())
    assert score.of(Utterance)
    for command in (["curves"], ["explain"], ["norms", "--no-sound"], ["export", "--to", "maryxml"]):
        result = run(*command, tmp_path / "take")
        assert result.exit_code == 0, (command, result.stderr)
        assert "cut off" in result.stderr


def test_a_take_is_never_written_over(performed: Path) -> None:
    before = (performed / "take" / "take.jsonl").read_bytes()
    result = run("live", *QUIET, performed / "one.txt", "--take", performed / "take")
    assert (result.exit_code, len(result.stderr.splitlines())) == (2, 1)
    assert "holds a take already" in result.stderr
    assert run("live", *QUIET, performed / "one.txt", "--take", performed).exit_code == 2  # not empty
    assert (performed / "take" / "take.jsonl").read_bytes() == before


def test_renderings_in_a_takes_folder_leave_its_speech(performed: Path, tmp_path: Path) -> None:
    import shutil

    take = shutil.copytree(performed / "take", tmp_path / "take")
    speech = sorted(path.name for path in (take / "speech").iterdir())
    (tmp_path / "other.txt").write_text("Something else.")
    for given, more in ((take, ()), (tmp_path / "other.txt", ("--force", "--voice", "tone"))):
        result = run("render", given, "-o", take, *more)
        assert result.exit_code == 0, result.stderr
    assert set(speech) < {path.name for path in (take / "speech").iterdir()}
    assert run("curves", take).exit_code == 0


WRONG: dict[str, tuple[list[str], int, str]] = {
    "engine": (["--engine", "organ"], 2, "organ"),
    "engine's address": (["--engine", "scsynth@here"], 2, "scsynth@HOST:PORT"),
    "device of another's engine": (["--engine", "scsynth@127.0.0.1:57110", "--device", "USB"], 2, "USB"),
    "device of an engine without": (["--device", "USB"], 2, "the silent engine has none"),
    "rate": (["--rate", "7"], 2, "7"),
    "lookahead": (["--lookahead", "0"], 2, "--lookahead 0"),
    "output latency": (["--output-latency", "-1"], 2, "--output-latency -1"),
    "output latency nan": (["--output-latency", "nan"], 2, "nan"),
    "target": (["--to", "vnc://"], 2, "did you mean vmc?"),
    "target's option": (["--to", "osc://?speed=3"], 2, "speed"),
    "stdout twice": (["--to", "-", "--to", "jsonl:-"], 2, "once"),
    "curve rate": (["--curve-rate", "0"], 2, "--curve-rate '0'"),
    "curve rate, endless": (["--curve-rate", "1e999999999"], 2, "--curve-rate"),
    "curve lead": (["--curve-lead", "6"], 2, "--curve-lead 6"),
    "osc": (["--osc", "here:there"], 2, "here:there"),
    "osc port": (["--osc", "65536"], 2, "65536"),
    "osc and none": (["--osc", "9001", "--no-osc"], 2, "contradict"),
    "map without midi": (["--midi-map", "x.toml"], 2, "--midi PORT"),
    "midi system": (["--midi", "own", "--midi-api", "bluetooth"], 2, "expected alsa, jack"),
    "midi system without midi": (["--midi-api", "jack"], 2, "--midi PORT"),
    "map that is not there": (["--midi", "own", "--midi-map", "missing.toml"], 2, "missing.toml"),
    "voice": (["--voice", "nobody"], 2, "nobody"),
    "model": (["--model", "freestyle"], 2, "freestyle"),
    "value": (["--set", "nose_share=2"], 2, "nose_share"),
    "state": (["--state", "sleepwalking"], 2, "sleepwalking"),
    "cast": (["--cast", "tone"], 2, "VOICE=PRESET"),
    "markup": (["--markup", "html"], 2, "html"),
    "seed": (["--seed", "-1"], 2, "-1"),
    "lead": (["--lead", "61"], 2, "--lead 61"),
    "breaths": (["--breaths", "missing"], 2, "missing"),
    "file": (["missing.txt"], 2, "missing.txt"),
    "stdin twice": (["-", "-"], 2, "once"),
    "a day of speech": (["long.txt"], 2, "expected at most 1000000"),
    "a score": (["score.json"], 2, "scorebreath play"),
    "broken markup": (["broken.ssml"], 2, "broken.ssml:1:"),
    "take that is a file": (["--take", "in.txt"], 2, "in.txt"),
    "take on stdout": (["--take", "-"], 2, "folder"),
    "take that cannot be": (["--take", "in.txt/take"], 3, "in.txt"),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_options_are_refused_in_a_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in.txt").write_text("Hello.")
    (tmp_path / "score.json").write_text('{"schema": "scorebreath.score/1"}')
    (tmp_path / "long.txt").write_text("And on. " * 130_000)
    (tmp_path / "broken.ssml").write_text("<speak>Hello & goodbye</speak>")
    arguments, status, said = WRONG[name]
    result = run("live", "in.txt", *QUIET[:4], *arguments, *([] if "osc" in name else ["--no-osc"]))
    assert result.exit_code == status, result.stderr
    assert said in result.stderr
    assert len(result.stderr.splitlines()) in (1, 3)
    assert "Traceback" not in result.stderr
    assert not (tmp_path / "take").exists()


def test_events_and_curves_do_not_share_stdout(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    result = run("live", tmp_path / "in.txt", *QUIET, "--to", "-", "--json")
    (event,) = events(result.stdout)
    assert (result.exit_code, event["event"], event["status"]) == (2, "error", 2)


def test_curves_go_to_stdout_and_a_reader_that_leaves_is_nobodys_error(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Yes.")
    with performance("in.txt", "--to", "-", *SHORT, cwd=tmp_path, stdin=subprocess.DEVNULL) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert json.loads(process.stdout.readline())["schema"] == "scorebreath.picture/1"
        process.stdout.close()
        assert process.wait(PATIENCE) == 0
        said = process.stderr.read()
    assert b"1 group said" in said
    assert b"Traceback" not in said


def test_devices_are_listed() -> None:
    (event,) = events(run("live", "--devices", "--engine", "silent", "--json").stdout)
    assert (event["event"], event["status"]) == ("done", 0)
    assert "silent" in event["about"]


def test_a_port_that_is_taken_is_said(tmp_path: Path) -> None:
    import socket

    (tmp_path / "in.txt").write_text("Hello.")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        result = run("live", tmp_path / "in.txt", *QUIET[:4], "--osc", port)
    assert (result.exit_code, len(result.stderr.splitlines())) == (3, 1)
    assert str(port) in result.stderr


POSIX = pytest.mark.skipif(os.name != "posix", reason="a terminal of POSIX")


@POSIX
def test_a_performer_at_a_terminal(tmp_path: Path) -> None:
    """Types, sighs, moves, asks for help, errs, and ends; the terminal is as it was."""
    import pty
    import termios

    ours, theirs = pty.openpty()
    termios.tcsetwinsize(theirs, (24, 100))
    before = termios.tcgetattr(theirs)
    environment = {k: v for k, v in ENVIRONMENT.items() if k != "COLUMNS"} | {"TERM": "xterm-256color"}
    screen = Screen(ours)
    ends = {"stdin": theirs, "stdout": theirs, "stderr": theirs}
    with performance("--take", "take", *SHORT, cwd=tmp_path, env=environment, start_new_session=True, **ends) as live:
        screen.wait("/help   Esc or Ctrl-X panic")
        assert termios.tcgetattr(theirs) != before
        screen.type("Hello there, my friend.\r")
        screen.wait("1 said")
        screen.type("/set nose_share=0.8\r")
        screen.wait("nose_share 0.8")
        screen.type("/hep\r")
        screen.wait("/hep: there is no such command; did you mean help")
        screen.type("/sig\t\r")
        screen.type("/help\r")
        screen.wait("say TEXT now, in place of everything else")
        screen.type("\r")
        termios.tcsetwinsize(theirs, (12, 60))
        os.kill(live.pid, signal.SIGWINCH)
        screen.forget()
        screen.wait("lungs")
        screen.type("/end\r")
        screen.wait("; take\r\n")
        assert live.wait(PATIENCE) == 0
    assert termios.tcgetattr(theirs) == before
    os.close(theirs)
    while screen.look(0.1):
        pass
    assert "\x1b[?1049h" in screen.raw or "lungs" in screen.raw
    assert screen.raw.rindex("\x1b[?1049l") > screen.raw.rindex("lungs")  # what was there before came back
    os.close(ours)
    taken, _ = load(tmp_path / "take")
    assert taken.text == "Hello there, my friend."
    assert [event.name for event in taken.of(Command)] == ["sigh", "end"]
    assert any(event.type == "parameter" for event in taken.events)


@POSIX
def test_a_dumb_terminal_gets_lines(tmp_path: Path) -> None:
    import pty

    ours, theirs = pty.openpty()
    screen = Screen(ours)
    ends = {"stdin": theirs, "stdout": theirs, "stderr": theirs}
    with performance(*SHORT, cwd=tmp_path, start_new_session=True, **ends) as live:
        screen.wait("silent at 48000 Hz")
        screen.type("Yes.\n/bogus\n/who\n")
        screen.wait("scorebreath: Yes.")
        screen.wait("/bogus: there is no such command")
        screen.wait("you speak to everybody")
        screen.type("\x04")
        screen.wait("1 group said")
        assert live.wait(PATIENCE) == 0
    assert "\x1b" not in screen.raw
    os.close(ours)
    os.close(theirs)


@POSIX
def test_ctrl_c_and_panic_are_keys(tmp_path: Path) -> None:
    import pty

    (tmp_path / "in.txt").write_text(LONG)
    ours, theirs = pty.openpty()
    screen = Screen(ours)
    environment = {**ENVIRONMENT, "TERM": "xterm"}
    ends = {"stdin": theirs, "stdout": theirs, "stderr": theirs}
    with performance(
        "in.txt", "--take", "take", "--stay", cwd=tmp_path, env=environment, start_new_session=True, **ends
    ) as live:
        screen.wait("1 said")
        screen.type("\x18")
        screen.wait("(")
        screen.type("\x03")
        screen.wait("interrupted; ")
        assert live.wait(PATIENCE) == 130
    os.close(ours)
    os.close(theirs)
    assert [event.name for event in load(tmp_path / "take")[0].of(Command)] == ["panic", "stop", "end"]


def test_help_says_what_there_is() -> None:
    said = run("live", "--help").stdout
    for word in ("--take", "--to", "--midi", "--osc", "--preview", "--stay", "Examples", "rehearsal screen"):
        assert word in said


@POSIX
def test_keys_come_from_the_terminal_while_text_comes_through_a_pipe(tmp_path: Path) -> None:
    """A model writes, and a performer has a hand on it."""
    import fcntl
    import pty
    import termios

    ours, theirs = pty.openpty()
    screen = Screen(ours)

    def own_terminal() -> None:
        os.setsid()
        fcntl.ioctl(theirs, termios.TIOCSCTTY, 0)

    ends = {"stdout": theirs, "stderr": theirs, "env": {**ENVIRONMENT, "TERM": "xterm"}}
    with performance("-", "--take", "take", *SHORT, cwd=tmp_path, preexec_fn=own_terminal, **ends) as live:
        assert live.stdin is not None
        live.stdin.write(b"On and on. " * 50)
        live.stdin.flush()
        screen.wait("1 said")
        screen.type("\x1b")
        screen.wait_until(lambda frame: "On and on" not in frame and "now" in frame)
        live.stdin.close()
        screen.wait("; take\r\n")
        assert live.wait(PATIENCE) == 0
    os.close(ours)
    os.close(theirs)
    assert [event.name for event in load(tmp_path / "take")[0].of(Command)] == ["panic", "end"]


def test_osc_says_moves_and_ends_what_stays_open(tmp_path: Path) -> None:
    from pythonosc.udp_client import SimpleUDPClient

    options = ("--osc", 0, "--stay", "--json", "--take", "take", *SHORT)
    with program("live", *QUIET[:-1], *options, cwd=tmp_path, stdin=subprocess.DEVNULL) as process:
        started = told(process, "started")[-1]
        host, _, port = started["osc"].rpartition(":")
        client = SimpleUDPClient(host, int(port))
        client.send_message("/scorebreath/nose_share", 0.75)
        client.send_message("/scorebreath/say", "Good evening.")
        assert told(process, "group")[-1]["text"] == "Good evening."
        client.send_message("/scorebreath/command/end", [])
        assert told(process)[-1]["status"] == 0
        assert process.wait(PATIENCE) == 0
    moved = [event for event in load(tmp_path / "take")[0].events if event.type == "parameter"]
    assert [(event.name, event.value) for event in moved] == [("nose_share", 0.75)]  # type: ignore[attr-defined]
