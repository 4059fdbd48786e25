"""What goes wrong: the status, one line, and nothing left behind."""

from __future__ import annotations

import errno
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from scorebreath import errors
from scorebreath_cli.failures import GRAVITY, Status, failure_of, worst
from tests.cli.running import ENVIRONMENT, PROGRAM, events, run, spawn

HOSTILE: dict[str, tuple[bytes, int]] = {
    "empty": (b"", 2),
    "only a byte order mark": (b"\xef\xbb\xbf", 2),
    "only white space": (b" \n\t\n", 2),
    "only punctuation": (b"... !? -- ,;\n", 2),
    "only marks": (b"_ . _ .", 2),
    "invalid UTF-8": (b"caf\xe9 au lait", 2),
    "a cut-off character": ("na\u00efve".encode()[:3], 2),
    "NUL": (b"one\0two", 2),
    "UTF-16": ("Hello.".encode("utf-16"), 2),
    "a word of 10,000 characters": (b"a" * 10_000, 0),
    "10,000 vowels and consonants": (b"ba" * 5_000 + b".", 0),
    "control characters": (bytes(range(1, 32)) + b"Hello" + b"\x7f\x1b[31m there.", 0),
    "emoji": ("Hello \U0001f600 there \U0001f468\u200d\U0001f469\u200d\U0001f467!".encode(), 0),
    "only emoji": ("\U0001f389\U0001f6b2".encode(), 2),
    "only feelings": ("\U0001f600\U0001f600".encode(), 0),
    "mixed scripts": ("Hello мир, 世界 and عالم.".encode(), 0),
    "combining marks": (("Z" + "\u0351" * 200 + "algo speaks.").encode(), 0),
    "one long line": (b"and so it went on " * 500, 0),
    "markup": (b"<speak>Hello &amp; goodbye</speak>", 0),
    "broken markup": (b"<speak>Hello & goodbye</speak>", 2),
    "an entity bomb": (b'<!DOCTYPE x [<!ENTITY a "aaaa">]><speak>&a;</speak>', 2),
    "an unknown tag": (b"Hello [sihg] there.", 2),
    "an unclosed tag": (b"Hello [sigh there.", 2),
    "brackets that are text": (b"Hello [1] there [He] and [...] then.", 0),
    "a sigh alone": (b"[sigh]", 0),
    "a formula": (b"=1+1 is two. -5 degrees.", 0),
    "line separators": ("One\u2028two\u2029three\x0bfour\x0cfive\x85six.".encode(), 0),
    "right to left": ("\u202eHello\u202c there.".encode(), 0),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_text_is_spoken_or_refused_with_its_place(tmp_path: Path, name: str) -> None:
    data, status = HOSTILE[name]
    (tmp_path / "in.txt").write_bytes(data)
    result = run("compile", tmp_path / "in.txt", "-o", tmp_path / "out" / "s.json", "--voice", "tone")
    assert result.exit_code == status, result.stderr
    assert "Traceback" not in result.stderr
    assert (tmp_path / "out").exists() == (status == 0)
    if status:
        assert result.stderr.startswith(f"scorebreath: {tmp_path / 'in.txt'}")
        assert "; expected " in result.stderr
        assert len(result.stderr.splitlines()) in (1, 3)


def test_a_bad_byte_gets_a_caret(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_bytes("Voilà.\nUn caf".encode() + b"\xe9 noir\n")
    result = run("explain", tmp_path / "in.txt")
    first, shown, caret = result.stderr.splitlines()
    assert first.startswith(f"scorebreath: {tmp_path / 'in.txt'}:2:7: ")
    assert shown[caret.index("^")] == "\N{REPLACEMENT CHARACTER}"
    (told,) = events(run("explain", tmp_path / "in.txt", "--json").stdout)
    assert (told["event"], told["status"], told["line"], told["column"]) == ("error", 2, 2, 7)


WRONG: dict[str, list[str]] = {
    "model": ["--model", "freestyle"],
    "voice": ["--voice", "nobody"],
    "voice of no engine": ["--voice", "espeak:xx-nowhere"],
    "language": ["--language", "tlh-nowhere"],
    "preset": ["--preset", "formel-tts"],
    "preset file": ["--preset", "missing.toml"],
    "name": ["--set", "nosey=1"],
    "value": ["--set", "nose_share=2"],
    "assignment": ["--set", "nose_share"],
    "seed": ["--seed", "-1"],
    "lead": ["--lead", "-1"],
    "tail": ["--tail", "nan"],
    "engine": ["--engine", "organ"],
    "rate": ["--rate", "7"],
    "fps": ["--fps", "0"],
    "fps below 0": ["--fps", "-1"],
    "fps nan": ["--fps", "nan"],
    "fps exponent": ["--fps", "1e9"],
    "fps above all": ["--fps", "100001"],
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_options_are_refused_in_a_line_that_names_the_value(tmp_path: Path, name: str) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    result = run("render", tmp_path / "in.txt", "-o", tmp_path / "out", *WRONG[name])
    assert result.exit_code == 2, result.stderr
    said = WRONG[name][1].partition("=")[0]
    assert said in result.stderr
    assert "100000" in result.stderr or not name.startswith("fps")
    assert "Traceback" not in result.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("options", "meant"),
    [
        (["--model", "nature"], "natural"),
        (["--engine", "embeded"], "embedded"),
        (["--engine", "scsyn"], "scsynth"),
        (["--preset", "formel-tts"], "formal-tts"),
        (["--voice", "espaek"], "espeak"),
    ],
)
def test_a_name_that_is_nearly_right_gets_the_right_one(tmp_path: Path, options: list[str], meant: str) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    said = run("render", tmp_path / "in.txt", "-o", tmp_path / "out", *options).stderr
    assert f"did you mean {meant}?" in said.replace("'", "")
    if options[0] == "--model":
        assert f"did you mean {meant}?" in run("explain", tmp_path / "in.txt", *options).stderr


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b'{"schema":"scorebreath.score/2"}', "scorebreath.score/2"),
        (b'{"schema":"scorebreath.score/1"}', "made_by"),
        (b'{"schema":', "broken JSON"),
        (b'{"schema":"opentimelineio"}', "opentimelineio"),
        (b"{}", "schema"),
        (b'{"a":' * 100_000, "nested too deeply"),
    ],
)
def test_a_broken_score_is_refused(tmp_path: Path, content: bytes, said: str) -> None:
    (tmp_path / "s.json").write_bytes(content)
    for command in (["curves"], ["explain"], ["render", "-o", str(tmp_path / "out")]):
        result = run(*command, tmp_path / "s.json")
        assert result.exit_code == 2
        assert said.lower() in result.stderr.lower()
        assert len(result.stderr.splitlines()) == 1


def test_missing_media_are_refused(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    assert run("compile", tmp_path / "in.txt", "-o", tmp_path / "s.json", "--voice", "tone").exit_code == 0
    (sound,) = (tmp_path / "speech").iterdir()
    sound.rename(tmp_path / "elsewhere.wav")
    result = run("render", tmp_path / "s.json", "-o", tmp_path / "out")
    assert result.exit_code == 2
    assert sound.name[:12] in result.stderr
    assert not (tmp_path / "out").exists()


STATUSES: tuple[tuple[BaseException, Status], ...] = (
    (errors.InputError("x"), Status.INPUT),
    (errors.ParameterError("x"), Status.INPUT),
    (errors.ScoreError("x"), Status.INPUT),
    (errors.ScriptError("x"), Status.INPUT),
    (errors.EnvironmentFailure("x"), Status.ENVIRONMENT),
    (errors.EngineError("x", ["its words"]), Status.ENVIRONMENT),
    (errors.VoiceError("x"), Status.ENVIRONMENT),
    (errors.MissingExtraError("x", "y"), Status.ENVIRONMENT),
    (errors.ScorebreathError("x"), Status.BUG),
    (OSError(errno.ENOSPC, "No space left on device"), Status.ENVIRONMENT),
    (PermissionError(errno.EACCES, "Permission denied", "f"), Status.ENVIRONMENT),
    (MemoryError(), Status.ENVIRONMENT),
    (BrokenPipeError(), Status.PIPE_CLOSED),
    (KeyboardInterrupt(), Status.INTERRUPTED),
    (ZeroDivisionError("x"), Status.BUG),
    (RecursionError("x"), Status.BUG),
)


def test_every_error_of_ours_is_in_the_table() -> None:
    ours = {kind for kind in vars(errors).values() if isinstance(kind, type) and issubclass(kind, Exception)}
    assert ours <= {type(error) for error, _ in STATUSES}


@pytest.mark.parametrize(("error", "status"), STATUSES, ids=lambda value: type(value).__name__)
def test_every_kind_of_error_has_its_status(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException, status: Status
) -> None:
    from scorebreath import pipeline

    def fail(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr(pipeline, "compile_text", fail)
    (tmp_path / "in.txt").write_text("Hello.")
    result = run("render", tmp_path / "in.txt", "-o", tmp_path / "out", "--voice", "tone")
    assert result.exit_code == status == failure_of(error).status
    assert not (tmp_path / "out").exists()
    assert "Traceback" not in result.stderr
    if status == Status.PIPE_CLOSED:
        assert result.stderr == ""
    elif not isinstance(error, errors.EngineError):
        assert len(result.stderr.splitlines()) == 1


def test_a_bug_asks_for_a_report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from scorebreath.parameters import presets

    monkeypatch.setattr(presets, "names", lambda: 1 / 0)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    result = run("presets")
    assert result.exit_code == 1
    (line,) = result.stderr.splitlines()
    assert "bug" in line
    assert "ZeroDivisionError" in line
    (saved,) = tmp_path.iterdir()
    assert line.endswith(str(saved))
    assert "Traceback" in saved.read_text()
    assert "Traceback" in run("presets", "--debug").stderr


def test_the_worst_status_wins() -> None:
    assert set(GRAVITY) == set(Status)
    assert worst([]) == Status.DONE
    assert worst([Status.DONE, Status.INPUT, Status.ENVIRONMENT]) == Status.ENVIRONMENT
    assert worst([Status.BUG, Status.ENVIRONMENT]) == Status.BUG


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="nothing is forbidden to root")
def test_what_may_not_be_read_or_written_is_the_environments(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    (tmp_path / "in.txt").chmod(0)
    assert run("render", tmp_path / "in.txt", "-o", tmp_path / "out", "--voice", "tone").exit_code == 3


def test_an_output_that_cannot_be_is_the_environments(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    result = run("render", tmp_path / "in.txt", "-o", "/proc/nowhere/out", "--voice", "tone")
    assert result.exit_code == 3
    assert result.stderr.startswith("scorebreath: /proc/nowhere")


@pytest.mark.parametrize("fails", ["timeline.png", "curves.csv", "preview.html", "mix.wav"])
def test_a_failure_at_any_file_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fails: str
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    place = {
        "timeline.png": "scorebreath.report.timeline.write_timeline",
        "curves.csv": "scorebreath.formats.curves_csv.write",
        "preview.html": "scorebreath.report.preview.Preview.write",
        "mix.wav": "scorebreath.engine.offline.write_wave",
    }
    monkeypatch.setattr(place[fails], full)
    (tmp_path / "in.txt").write_text("Hello.")
    out = tmp_path / "out"
    out.mkdir()
    (out / "mix.wav").write_text("old")
    (out / "mine.txt").write_text("mine")
    result = run("render", tmp_path / "in.txt", "-o", out, "--voice", "tone", "--force")
    assert result.exit_code == 3
    assert "No space left" in result.stderr
    assert {p.name: p.read_text() for p in out.iterdir()} == {"mix.wav": "old", "mine.txt": "mine"}
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.txt", "out"]


def children(pid: int) -> list[int]:
    found = []
    for task in Path(f"/proc/{pid}/task").iterdir():
        found += [int(word) for word in (task / "children").read_text().split()]
    return found + [grand for child in found for grand in children(child)]


@pytest.mark.skipif(sys.platform != "linux", reason="looks for child processes in /proc")
@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.parametrize(("moment", "voice"), [("started", "espeak"), ("speak", "espeak"), ("sound", "tone")])
def test_an_interrupt_leaves_nothing(tmp_path: Path, number: int, status: int, moment: str, voice: str) -> None:
    (tmp_path / "in.txt").write_text("This goes on and on, and on and on, for quite a while. " * 100)
    line = [*PROGRAM, "render", "in.txt", "-o", "out", "--json", "--voice", voice]
    with subprocess.Popen(
        line, cwd=tmp_path, env={**ENVIRONMENT, "TMPDIR": str(tmp_path)}, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stdout
        for told in process.stdout:
            event = json.loads(told)
            if moment in (event["event"], event.get("stage")):
                break
        started = children(process.pid)
        os.kill(process.pid, number)
        _, said = process.communicate(timeout=30)
    assert process.returncode == status
    assert b"Traceback" not in said
    assert [path.name for path in tmp_path.iterdir()] == ["in.txt"]
    deadline = time.monotonic() + 10
    while alive := [pid for pid in started if Path(f"/proc/{pid}").exists()]:
        assert time.monotonic() < deadline, alive
        time.sleep(0.05)


def test_an_interrupt_does_not_wait_for_imports(tmp_path: Path) -> None:
    """Modules come in beside the voice; a thread that waits for the import lock for ever looks like this one."""
    (tmp_path / "in.txt").write_text("This goes on and on, and on and on, for quite a while. " * 400)
    slow = tmp_path / "slow"
    slow.mkdir()
    (slow / "soxr.py").write_text("import time; time.sleep(600)")
    with subprocess.Popen(
        [*PROGRAM, "render", "in.txt", "-o", "out", "--json", "--voice", "tone"],
        cwd=tmp_path, env={**ENVIRONMENT, "PYTHONPATH": f"{slow}{os.pathsep}{ENVIRONMENT.get('PYTHONPATH', '')}"},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    ) as process:  # fmt: skip
        assert process.stdout
        for told in process.stdout:
            if json.loads(told).get("stage") == "speak":
                break
        time.sleep(1.0)  # soxr is one of the first modules to come in
        os.kill(process.pid, signal.SIGINT)
        try:
            _, said = process.communicate(timeout=60)
        finally:
            process.kill()
    assert process.returncode == 130
    assert b"Traceback" not in said


def test_a_reader_that_leaves_is_nobodys_error(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Hello there. " * 50)
    with subprocess.Popen(
        [*PROGRAM, "compile", "in.txt", "--voice", "tone"],
        cwd=tmp_path, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    ) as process:  # fmt: skip
        assert process.stdout
        assert process.stderr
        process.stdout.close()
        assert process.wait(60) == 141
        assert process.stderr.read() == b""


def test_json_and_data_do_not_share_stdout() -> None:
    for command in (["compile", "-"], ["curves", "-"]):
        result: Any = run(*command, "--json", text="Hello.")
        assert result.exit_code == 2
        assert "-o FILE" in result.stdout
        assert events(result.stdout)[0]["event"] == "error"


def test_no_terminal_no_colours(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    result = spawn("render", tmp_path / "in.txt", "-o", tmp_path / "out", "--voice", "tone")
    assert (result.returncode, result.stderr) == (0, b"")
    assert b"\x1b" not in result.stdout


def shell(words: str, redirection: str, folder: Path) -> subprocess.CompletedProcess[bytes]:
    """The program with its streams as a shell redirects them."""
    return subprocess.run(
        ["sh", "-c", f'"$@" {redirection}', "sh", *PROGRAM, *words.split()],
        cwd=folder, env=ENVIRONMENT, capture_output=True, timeout=60, check=False,
    )  # fmt: skip


@pytest.mark.skipif(os.name != "posix", reason="closes descriptors as a shell does")
@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"])
def test_closed_streams_are_nobodys_error_where_nothing_goes_there(tmp_path: Path, closed: str) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    for words, status in (
        ("compile in.txt -o out/s.json --voice tone", 0),
        ("compile missing.txt -o missing.json", 2),
        ("rendr", 2),
        ("params --json", 3 if ">&-" in closed.split() else 0),
    ):
        result = shell(words, closed, tmp_path)
        assert result.returncode == status, (words, result.stderr)
        assert b"Traceback" not in result.stdout + result.stderr
    assert (tmp_path / "out" / "s.json").stat().st_size > 0


TO_STDOUT = (
    "compile in.txt --voice tone", "render in.txt -o - --voice tone", "curves s.json", "curves --describe", "schema",
    "explain s.json", "explain s.json --json", "params", "params --json", "presets nose", "doctor --json", "--help",
    "render --help", "--version", "compile in.txt -o again.json --voice tone --json",
)  # fmt: skip


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")  # noqa: PTH110
def test_output_that_cannot_go_to_stdout_is_said_to_be_lost(tmp_path: Path) -> None:
    (tmp_path / "in.txt").write_text("Hello.")
    assert run("compile", tmp_path / "in.txt", "-o", tmp_path / "s.json", "--voice", "tone").exit_code == 0
    for words in TO_STDOUT:
        result = shell(words, ">&-", tmp_path)
        assert (result.returncode, result.stderr) == (
            3,
            b"scorebreath: <stdout>: is closed, but output goes there\n",
        ), words
    for words in (TO_STDOUT[0], "params", "params --json", "--help"):
        result = shell(words, ">/dev/full", tmp_path)
        assert (result.returncode, result.stderr) == (3, b"scorebreath: <stdout>: No space left on device\n"), words
    assert sorted(path.name for path in tmp_path.iterdir()) == ["in.txt", "s.json", "speech"]


CONTROL = "\x1b]0;owned\x07\x9b31m\x7f\u202e"


def test_no_control_reaches_the_terminal(tmp_path: Path) -> None:
    name = f"in{CONTROL}.txt"
    (tmp_path / name).write_text(f"Hello {CONTROL} there.", encoding="utf-8")
    (tmp_path / f"bad{CONTROL}.txt").write_bytes(b"one\0two")
    (tmp_path / f"{CONTROL}.json").write_text(json.dumps({"schema": CONTROL}))
    (tmp_path / "line\nbreak").mkdir()
    out = tmp_path / "line\nbreak" / f"s{CONTROL}.json"
    told = [
        run("compile", tmp_path / name, "-o", out, "--voice", "tone"),
        run("explain", tmp_path / name),
        run("explain", out),
        run("explain", tmp_path / f"bad{CONTROL}.txt"),
        run("explain", tmp_path / f"missing{CONTROL}"),
        run("explain", tmp_path / f"{CONTROL}.json"),
        run("params", "--set", f"nose_share={CONTROL}"),
        run("compile", tmp_path / name, "-o", out, "--voice", CONTROL, "--force"),
    ]
    assert [result.exit_code for result in told] == [0, 0, 0, 2, 2, 2, 2, 2]
    for result in told:
        assert not set(result.output) & set(CONTROL) - set("]0;owned31m")
    assert told[0].stdout.count("\n") == 1
    assert "\\x1b]0;owned\\x07\\x9b31m\\x7f\\u202e" in told[0].stdout
    as_json = run("explain", tmp_path / f"missing{CONTROL}", "--json")
    assert not set(as_json.output) & set(CONTROL) - set("]0;owned31m")
    assert events(as_json.stdout)[0]["message"].endswith(f"missing{CONTROL}: no such file")


def test_colours_in_a_script_are_neither_shown_nor_counted(tmp_path: Path) -> None:
    (tmp_path / "plain.txt").write_text("Hello red world.")
    (tmp_path / "coloured.txt").write_text("Hello \x1b[31mred\x1b[0m world.")
    for form in ([], ["--json"]):
        plain, coloured = (run("explain", tmp_path / f"{name}.txt", *form) for name in ("plain", "coloured"))
        assert plain.stdout == coloured.stdout != ""


def test_an_error_event_names_its_input(tmp_path: Path) -> None:
    for command in (["render", "-o", tmp_path / "out"], ["compile"], ["explain"], ["curves"]):
        given = [*command, "-o", tmp_path / "x.json"] if command[0] in ("compile", "curves") else command
        (told,) = events(run(*given, tmp_path / "missing.txt", "--json").stdout)
        assert (told["event"], told["source"]) == ("error", str(tmp_path / "missing.txt"))


def test_an_output_folder_given_as_input_stands_for_its_score(tmp_path: Path) -> None:
    (tmp_path / "score.json").write_text("{}")
    result = run("render", tmp_path, "-o", tmp_path / "out")
    assert result.exit_code == 2
    assert f"{tmp_path / 'score.json'}: is not a score" in result.stderr
