"""`params`, `presets`, `schema`, `--help`, `--version`, completion: what people look at before they begin."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from scorebreath.engine.engines import DEFAULT as DEFAULT_ENGINE
from scorebreath.engine.engines import ENGINES
from scorebreath.parameters.derive import derive
from scorebreath.parameters.presets import load_preset, names
from scorebreath.parameters.table import Parameters
from scorebreath.speech.voices import DEFAULT as DEFAULT_VOICE
from scorebreath.speech.voices import list_voices
from scorebreath_cli import checks
from scorebreath_cli.app import COMMANDS
from scorebreath_cli.printers import plain_table
from tests.cli.running import ENVIRONMENT, PROGRAM, ROOT, events, run, spawn


def test_params_shows_every_parameter() -> None:
    rows = events(run("params", "--json").stdout)
    assert [row["name"] for row in rows] == list(Parameters.model_fields)
    assert all(row["meaning"] and row["source"] and row["range"] for row in rows)
    assert all(row["osc"] == f"/scorebreath/{row['name']}" for row in rows)
    controllers = [row["midi_cc"] for row in rows if row["midi_cc"] is not None]
    assert len(set(controllers)) == len(controllers) > 30
    table = run("params").stdout.splitlines()
    assert [line.split()[0] for line in table[1:]] == list(Parameters.model_fields)
    assert all(row["meaning"] in line for row, line in zip(rows, table[1:], strict=True))


def test_params_shows_what_was_set_and_what_follows_from_it() -> None:
    set_here = ["--preset", "stylised", "--set", "capacity_lung=64", "--set", "norm-syllables=20"]
    rows = {row["name"]: row for row in events(run("params", "--json", *set_here).stdout)}
    assert (rows["capacity_lung"]["value"], rows["capacity_lung"]["set_by"]) == (64, "--set")
    assert (rows["motion_gain"]["value"], rows["motion_gain"]["set_by"]) == (2.5, "preset stylised")
    assert (rows["nose_share"]["value"], rows["nose_share"]["set_by"]) == (0.35, "")
    low = derive(Parameters(**load_preset("stylised").values, capacity_lung=64.0, norm_syllables=20.0))
    assert (rows["length_utterance"]["value"], rows["length_utterance"]["default"]) == (16.0, "derived")
    for name in ("urgency_limit", "length_inspiration", "amplitude_mouth_open", "volume_thorax"):
        assert rows[name]["value"] == getattr(low, name)


def test_params_takes_names() -> None:
    assert [row["name"] for row in events(run("params", "nose_share", "breath-level", "--json").stdout)] == [
        "nose_share", "breath_level",
    ]  # fmt: skip
    wrong = run("params", "nose_shar")
    assert (wrong.exit_code, wrong.stdout) == (2, "")
    assert wrong.stderr == "scorebreath: no parameter is called 'nose_shar'; did you mean 'nose_share'?\n"


def test_the_schema_of_parameters_takes_every_preset() -> None:
    schema = json.loads(run("params", "--json-schema").stdout)
    check = Draft202012Validator(schema)
    for name in names():
        check.validate(dict(load_preset(name).values))
    assert not check.is_valid({"nose_share": 1.5})
    assert not check.is_valid({"nosey": 0.5})


def test_presets_are_listed_and_shown() -> None:
    assert [row["name"] for row in events(run("presets", "--json").stdout)] == list(names())
    for name in names():
        preset = load_preset(name)
        (row,) = events(run("presets", name, "--json").stdout)
        assert row["parameters"] == preset.values
        shown = run("presets", name).stdout
        assert preset.description in shown
        assert all(key in shown for key in preset.values)
    assert run("presets", "formal").exit_code == 2


def test_a_preset_shown_is_a_preset_file(tmp_path: Path) -> None:
    lines = run("presets", "stylised").stdout.splitlines()
    (tmp_path / "mine.toml").write_text("[parameters]\n" + "\n".join(line for line in lines if " = " in line))
    assert load_preset(str(tmp_path / "mine.toml")).values == load_preset("stylised").values


def test_voices_are_listed_with_their_licences() -> None:
    rows = {row["name"]: row for row in events(run("voices", "--json").stdout)}
    assert rows["espeak"]["licence"] == "GPL-3.0-or-later"
    assert {"en-US", "de"} <= set(rows["espeak"]["languages"])
    assert all(row["provenance"] and row["licence"] for row in rows.values())
    table = run("voices").stdout
    assert all(name in table and row["licence"] in table for name, row in rows.items())


def test_the_doctor_tries_everything() -> None:
    result = run("doctor", "--json")
    told = [event for event in events(result.stdout) if event["event"] == "check"]
    state = {(check["kind"], check["name"]): check["state"] for check in told}
    assert {name for kind, name in state if kind == "engine"} == set(ENGINES)
    assert {name for kind, name in state if kind == "voice"} == {voice.name for voice in list_voices()}
    assert {event["event"] for event in events(result.stdout)} == {"check", "done"}
    assert state["engine", DEFAULT_ENGINE] == state["voice", DEFAULT_VOICE] == "works"
    assert result.exit_code == 0
    assert events(result.stdout)[-1] == {"schema": "scorebreath.event/1", "event": "done", "status": 0, "broken": []}
    assert all(check["what"] and (check["state"] == "works" or check["remedy"]) for check in told)


def test_the_doctor_says_how_to_get_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SCOREBREATH_SCSYNTH", "/nowhere/scsynth")
    find_spec = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "nanosynth" else find_spec(name))
    result = run("doctor", "--json")
    state = {check["name"]: check for check in events(result.stdout) if check["event"] == "check"}
    assert (state["embedded"]["state"], state["scsynth"]["state"]) == ("missing", "missing")
    assert "pip install nanosynth" in state["embedded"]["remedy"]
    assert "apt install supercollider-server" in state["scsynth"]["remedy"]
    assert "/nowhere/scsynth" in state["scsynth"]["what"]
    assert result.exit_code == 3
    assert run("doctor").stderr == "scorebreath: needed but not working: embedded\n"


def test_the_doctor_knows_a_checkout(monkeypatch: pytest.MonkeyPatch) -> None:
    def nowhere(name: str) -> str:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "requires", nowhere)
    monkeypatch.setattr(checks, "_engines", lambda: iter(()))
    monkeypatch.setattr(checks, "_voices", lambda: iter(()))
    result = run("doctor", "--json")
    state = {check["name"]: check for check in events(result.stdout) if check["event"] == "check"}
    assert (state["scorebreath"]["state"], state["scorebreath"]["what"]) == ("works", f"in {ROOT}, not installed")
    assert result.exit_code == 0


def test_the_doctor_leaves_out_what_says_nothing() -> None:
    def check(said: str) -> str:
        return checks._tried("engine", "scsynth", lambda: said, lambda: "rendered", "", needed=False).what

    assert check("scsynth 3.13.0 (Built from  '' [na])") == "scsynth 3.13.0; rendered"
    assert check("scsynth 3.14.0 (Built from branch 'main' [c0ffee])").endswith("'main' [c0ffee]); rendered")


def test_the_doctor_hears_silence(monkeypatch: pytest.MonkeyPatch) -> None:
    from scorebreath.engine import onsets

    monkeypatch.setattr(onsets, "sounds_of", lambda *_: iter(()))
    state = {check["name"]: check for check in events(run("doctor", "--json").stdout) if check["event"] == "check"}
    assert state["embedded"]["state"] == "broken"
    assert "silence" in state["embedded"]["what"]


def test_the_schema_is_a_schema() -> None:
    schema = json.loads(run("schema").stdout)
    Draft202012Validator.check_schema(schema)
    assert schema["properties"]["schema"]["const"] == "scorebreath.score/1"


def test_the_version(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(metadata, "version", lambda _: "1.2.3")
    assert run("--version").stdout == "scorebreath 1.2.3\n"

    def nowhere(name: str) -> str:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "version", nowhere)
    assert run("--version").stdout == "scorebreath (not installed)\n"


@pytest.mark.parametrize(("name", "examples"), [(name, examples) for name, _, _, examples in COMMANDS])
def test_every_command_has_help_with_examples(name: str, examples: tuple[str, ...]) -> None:
    result = run(name, "--help")
    assert result.exit_code == 0
    said = " ".join(result.stdout.split())
    assert all(" ".join(example.split()) in said for example in examples)
    assert any(f"scorebreath {name}" in example for example in examples)
    assert name in run("--help").stdout


def test_without_a_command_there_is_help() -> None:
    result = run()
    assert result.exit_code == 2
    assert "Usage: scorebreath" in result.output


@pytest.mark.parametrize(
    "wrong", ["rendr", "render --colour x", "params --sett x", "schema extra", "render a.txt", "compile a --seed ten"]
)
def test_bad_usage_is_status_2(wrong: str) -> None:
    result = spawn(*wrong.split())
    assert (result.returncode, result.stdout) == (2, b"")
    (line,) = result.stderr.decode().splitlines()
    assert line.startswith("scorebreath: ")
    assert "; try `scorebreath" in line


@pytest.mark.parametrize("wrong", ["rendr --json", "render --json --colour x", "explain --json", "params --json --set"])
def test_bad_usage_of_a_program_is_told_to_the_program(wrong: str) -> None:
    result = spawn(*wrong.split())
    assert (result.returncode, result.stderr) == (2, b"")
    (told,) = events(result.stdout)
    assert (told["event"], told["status"]) == ("error", 2)
    assert "; try `scorebreath" in told["message"]


def test_what_follows_two_dashes_is_no_option() -> None:
    result = run("render", "--colour", "--", "--json")
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith("scorebreath: no such option: --colour")


def test_bad_usage_names_what_is_wrong() -> None:
    result = run("render", "--colour\x1b[31m", "x")
    assert result.exit_code == 2
    assert result.stderr.startswith("scorebreath: no such option: --colour\\x1b[31m")
    assert result.stderr.endswith("; try `scorebreath render --help`\n")


def test_the_package_runs_as_a_module() -> None:
    line = [sys.executable, "-m", "scorebreath_cli", "--version"]
    result = subprocess.run(line, env=ENVIRONMENT, capture_output=True, timeout=60, check=True)
    assert result.stdout.startswith(b"scorebreath ")


def test_the_tail_s_help_says_after_what() -> None:
    for name in ("render", "compile"):
        assert "come back to rest" in " ".join(
            run(name, "--help").stdout.replace("\N{BOX DRAWINGS LIGHT VERTICAL}", " ").split()
        )


def complete(line: str) -> list[str]:
    """What bash offers at the end of the line."""
    words = line.split(" ")
    variables = {"COMP_WORDS": line, "COMP_CWORD": str(len(words) - 1), "_SCOREBREATH_COMPLETE": "complete_bash"}
    program = "import sys; sys.argv[0] = 'scorebreath'; from scorebreath_cli.main import main; main()"
    result = subprocess.run(
        [sys.executable, "-c", program],
        env={**ENVIRONMENT, **variables}, capture_output=True, timeout=60, check=True,
    )  # fmt: skip
    return result.stdout.decode().split()


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("scorebreath pa", ["params"]),
        ("scorebreath params --pres", ["--preset"]),
        ("scorebreath params --preset formal", ["formal-human", "formal-tts"]),
        ("scorebreath params --set nose", ["nose_share="]),
        ("scorebreath params nose", ["nose_share"]),
        ("scorebreath presets sty", ["stylised"]),
    ],
)
def test_names_complete(line: str, offered: list[str]) -> None:
    assert complete(line) == offered


@pytest.mark.skipif(not os.path.exists("/bin/bash"), reason="no bash")  # noqa: PTH110
def test_the_completion_script_works_in_bash(tmp_path: Path) -> None:
    program = tmp_path / "scorebreath"
    program.write_text(f"#!/bin/sh\nexec {sys.executable} -c 'import sys; sys.argv[0] = \"scorebreath\"\n"
                       "from scorebreath_cli.main import main; main()' \"$@\"\n")  # fmt: skip
    program.chmod(0o755)
    session = """
        source <(scorebreath --show-completion)
        COMP_WORDS=(scorebreath presets formal-t) COMP_CWORD=2
        complete -p scorebreath >/dev/null && $(complete -p scorebreath | sed 's/.*-F \\([^ ]*\\).*/\\1/') scorebreath
        printf '%s\\n' "${COMPREPLY[@]}"
    """
    shown = subprocess.run(
        ["/bin/bash", "--norc", "-c", session],
        env={**ENVIRONMENT, "PATH": f"{tmp_path}:{os.environ['PATH']}", "SHELL": "/bin/bash"},
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert shown.stdout.split() == ["formal-tts"], shown.stderr


def test_a_closed_pipe_is_nobodys_error() -> None:
    with subprocess.Popen(
        [*PROGRAM, "schema"], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stdout
        assert process.stderr
        process.stdout.close()
        assert process.wait(60) == 141
        assert process.stderr.read() == b""


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")  # noqa: PTH110
def test_a_full_disk_is_the_environments() -> None:
    with open("/dev/full", "wb") as full:  # noqa: PTH123
        result = spawn("params", stdout=full, stderr=subprocess.PIPE, capture_output=False)
    assert (result.returncode, result.stderr) == (3, b"scorebreath: <stdout>: No space left on device\n")


def test_a_plain_table_is_no_wider_than_what_it_says() -> None:
    long = "x" * 40
    rows: list[dict[str, object]] = [{"a": long, "b": 1, "c": "end"}, {"a": "short", "b": None, "c": "end"}]
    assert plain_table(rows, ["a", "b", "c"]) == [
        f"a{' ' * 33}b  c", f"{long}  1  end", f"short{' ' * 32}end",
    ]  # fmt: skip
    for command in ("params", "voices"):
        header, *lines = run(command).stdout.splitlines()
        assert len(lines) == len(events(run(command, "--json").stdout))
        assert all("  " * 40 not in line and line == line.rstrip() for line in (header, *lines))


def test_a_plain_table_is_one_line_a_row() -> None:
    rows = [{"a": "x\ny", "b": True}, {"a": "longer", "b": 0.1}]
    assert plain_table(rows, ["a", "b"]) == ["a       b", "x y     yes", "longer  0.1"]
