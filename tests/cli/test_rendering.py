"""`render`, `compile`, `curves`, `explain` on real input: what they write, and that it does not depend on the way."""

from __future__ import annotations

import csv
import dataclasses
import json
import shutil
import subprocess
import wave
from pathlib import Path

import pytest

from scorebreath.score.codec import dumps, loads
from scorebreath.score.files import check_media, load
from scorebreath.score.take import TakeWriter
from scorebreath.units import snap
from scorebreath_cli.app import COMMANDS
from scorebreath_cli.outputs import SET_FILES
from scorebreath_cli.printers import STAGES
from tests.cli.running import ENVIRONMENT, PROGRAM, events, run, spawn

TEXT = """The rain came in from the west, as it does in autumn, and stayed until the evening.

Nobody went out. The dog slept by the stove; the cat, who had other plans, did not.
"""
MODELS = ("natural", "bernardet-2017", "bernardet-2019")
Tree = dict[str, bytes]


def tree(folder: Path) -> Tree:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


@pytest.fixture(scope="module")
def script(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("script") / "speech.txt"
    path.write_text(TEXT)
    return path


@pytest.fixture(scope="module")
def rendered(script: Path) -> Path:
    folder = script.parent / "out"
    result = run("render", script, "-o", folder, "--voice", "tone", "--seed", 5)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.split() == [str(folder / name) for name in sorted(SET_FILES)]
    return folder


@pytest.fixture
def compiled(script: Path, tmp_path: Path) -> Path:
    path = tmp_path / "compiled" / "score.json"
    assert run("compile", script, "-o", path, "--voice", "tone", "--seed", 5).exit_code == 0
    return path


def test_render_makes_the_whole_set(rendered: Path) -> None:
    assert {path.name for path in rendered.iterdir()} == {*SET_FILES, "speech"}
    score, media = load(rendered / "score.json")
    check_media(score, media)
    assert {f"speech/{name}.wav" for name in score.media} == {n for n in tree(rendered) if n.startswith("speech/")}
    assert score.text == TEXT
    with wave.open(str(rendered / "mix.wav")) as sound:
        assert (sound.getframerate(), sound.getnframes()) == (48000, round(score.duration * 48000))
    frames = (rendered / "curves.csv").read_text().splitlines()
    assert frames[0].startswith("time,lung_volume,")
    assert len(frames) == 2 + int(score.duration * 60)
    rows = list(csv.DictReader((rendered / "groups.csv").open()))
    assert [row["text"] for row in rows] == [group.text for group in score.groups]
    assert json.loads((rendered / "curves.json").read_bytes())["fps"] == [60, 1]
    assert (rendered / "timeline.png").read_bytes().startswith(b"\x89PNG")
    assert b"</html>" in (rendered / "preview.html").read_bytes()


def test_two_runs_give_the_same_bytes(script: Path, rendered: Path, tmp_path: Path) -> None:
    assert spawn("render", script, "-o", tmp_path / "b", "--voice", "tone", "--seed", "5").returncode == 0
    assert tree(tmp_path / "b") == tree(rendered)


def test_compiling_first_makes_no_difference(rendered: Path, compiled: Path, tmp_path: Path) -> None:
    assert compiled.read_bytes() == (rendered / "score.json").read_bytes()
    assert run("render", compiled, "-o", tmp_path / "b").exit_code == 0
    assert tree(tmp_path / "b") == tree(rendered)


def test_a_score_is_rendered_where_it_lies(rendered: Path, compiled: Path) -> None:
    assert run("render", compiled, "-o", compiled.parent).exit_code == 0
    assert tree(compiled.parent) == tree(rendered)
    again = run("render", compiled, "-o", compiled.parent)
    assert again.exit_code == 2
    assert "--force" in again.stderr


def test_stdin_is_as_good_as_a_file(rendered: Path, tmp_path: Path) -> None:
    options = ["--voice", "tone", "--seed", "5"]
    assert run("render", "-", "-o", tmp_path / "b", *options, text=TEXT).exit_code == 0
    assert tree(tmp_path / "b") == tree(rendered)
    assert run("compile", "-", *options, text=TEXT).stdout_bytes == (rendered / "score.json").read_bytes()


def test_the_sound_goes_to_stdout(script: Path, rendered: Path) -> None:
    result = spawn("render", script, "-o", "-", "--voice", "tone", "--seed", "5")
    assert result.stdout == (rendered / "mix.wav").read_bytes()
    assert result.stderr == b""
    assert spawn("render", rendered / "score.json", "-o", "-").stdout == result.stdout
    for refused in (["-o", "-", "--json"], [script, "-o", "-"]):
        assert run("render", script, *refused).exit_code == 2


def test_curves_are_those_of_render(rendered: Path, tmp_path: Path) -> None:
    score = rendered / "score.json"
    for kind in ("csv", "json"):
        wanted = (rendered / f"curves.{kind}").read_bytes()
        assert run("curves", score, "-o", tmp_path / f"a.{kind}").exit_code == 0
        assert (tmp_path / f"a.{kind}").read_bytes() == wanted
        assert run("curves", "-", "--format", kind, text=score.read_bytes()).stdout_bytes == wanted
    again = run("curves", score, "-o", tmp_path / "a.csv", "--fps", "30000/1001")
    assert again.exit_code == 2
    assert run("curves", score, "-o", tmp_path / "a.csv", "--fps", "30000/1001", "--force").exit_code == 0
    assert (tmp_path / "a.csv").read_text().splitlines()[31].startswith("1.001000,")


def test_compile_into_curves_is_a_pipe(script: Path, rendered: Path) -> None:
    program = " ".join(f"'{part}'" for part in PROGRAM)
    line = f"{program} compile '{script}' --voice tone --seed 5 | {program} curves -"
    piped = subprocess.run(["/bin/sh", "-c", line], env=ENVIRONMENT, capture_output=True, timeout=120, check=True)
    assert piped.stdout == (rendered / "curves.csv").read_bytes()


def test_a_take_is_as_good_as_a_score(rendered: Path, tmp_path: Path) -> None:
    score, _ = load(rendered / "score.json")
    shutil.copytree(rendered / "speech", tmp_path / "take" / "speech")
    with TakeWriter(tmp_path / "take", score) as take:
        for name, info in score.media.items():
            take.sound(name, info)
        for group in score.groups:
            take.group(group)
        for event in score.events:
            take.event(event)
    assert run("render", tmp_path / "take", "-o", tmp_path / "b").exit_code == 0
    for name in ("mix.wav", "curves.csv"):
        assert (tmp_path / "b" / name).read_bytes() == (rendered / name).read_bytes()
    assert run("curves", tmp_path / "take").stdout_bytes == (rendered / "curves.csv").read_bytes()


def test_engine_rate_and_frames_are_obeyed(rendered: Path, tmp_path: Path) -> None:
    options = ["--rate", 22050, "--fps", "29.97"]
    assert run("render", rendered / "score.json", "-o", tmp_path / "b", *options).exit_code == 0
    with wave.open(str(tmp_path / "b" / "mix.wav")) as sound:
        assert sound.getframerate() == 22050
    assert json.loads((tmp_path / "b" / "curves.json").read_bytes())["fps"] == [2997, 100]


@pytest.mark.scsynth
def test_an_external_engine_is_used(rendered: Path, tmp_path: Path) -> None:
    assert run("render", rendered / "score.json", "-o", tmp_path / "b", "--engine", "scsynth").exit_code == 0
    with wave.open(str(tmp_path / "b" / "mix.wav")) as ours, wave.open(str(rendered / "mix.wav")) as theirs:
        assert ours.getnframes() == theirs.getnframes()


def test_what_is_not_heard_or_seen_takes_its_time_all_the_same(script: Path, rendered: Path, tmp_path: Path) -> None:
    options = ["--voice", "tone", "--seed", "5", "--no-breath-sound", "--no-breath-motion"]
    assert run("compile", script, "-o", tmp_path / "b.json", *options).exit_code == 0
    quiet, loud = load(tmp_path / "b.json")[0], load(rendered / "score.json")[0]
    assert [(e.id, e.onset, e.duration) for e in quiet.events] == [(e.id, e.onset, e.duration) for e in loud.events]
    assert quiet.bodies[0].parameters == {"breath_sound": False, "breath_motion": False}
    assert dumps(quiet) != dumps(loud)


@pytest.mark.parametrize("model", MODELS)
def test_explain_gives_the_groups_of_the_score(script: Path, tmp_path: Path, model: str) -> None:
    assert run("compile", script, "-o", tmp_path / "s.json", "--voice", "tone", "--model", model).exit_code == 0
    score = loads((tmp_path / "s.json").read_bytes())
    *told, done = events(run("explain", script, "--json", "--voice", "tone", "--model", model).stdout)
    assert (done["event"], done["groups"]) == ("done", len(score.groups))
    assert [(e["text"], e["start"], e["end"], e["syllables"]) for e in told] == [
        (group.text, *group.source, group.syllables) for group in score.groups
    ]
    for row in told:
        assert sum(other["chosen"] for other in row["candidates"]) == 1
        assert row["rule"]
    assert events(run("explain", tmp_path / "s.json", "--json").stdout) == [*told, done]
    said = run("explain", tmp_path / "s.json").stdout
    for row in told:
        assert " ".join(row["text"].split()) in said
        assert f"{row['syllables']} syllables" in said
        assert row["rule"] in said


def test_explain_does_not_speak(script: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from scorebreath import pipeline

    def spoken(*_: object) -> None:
        raise AssertionError("spoken")

    monkeypatch.setattr(pipeline, "speak", spoken)
    assert run("explain", script, "--voice", "tone").exit_code == 0


def test_json_tells_the_whole_story(script: Path, tmp_path: Path) -> None:
    told = events(spawn("render", script, "-o", tmp_path / "b", "--voice", "tone", "--json").stdout)
    assert told[0] == {
        "schema": "scorebreath.event/1", "event": "started", "source": str(script), "output": str(tmp_path / "b"),
    }  # fmt: skip
    assert (told[-1]["event"], told[-1]["status"]) == ("done", 0)
    written = [event for event in told if event["event"] == "written"]
    assert {event["path"] for event in written} == {str(tmp_path / "b" / name) for name in SET_FILES}
    assert all(Path(event["path"]).stat().st_size == event["bytes"] for event in written)
    stages: dict[str, list[float]] = {}
    for event in told:
        if event["event"] == "progress":
            stages.setdefault(event["stage"], []).append(event["fraction"])
    assert list(stages) == [stage for stage in STAGES if stage != "listen"]
    for fractions in stages.values():
        assert fractions == sorted(set(fractions))
        assert fractions[-1] == 1


def test_several_scripts_are_one_run(script: Path, tmp_path: Path) -> None:
    (tmp_path / "two.txt").write_text("One more thing.")
    (tmp_path / "bad.txt").write_bytes(b"caf\xe9\n")
    (tmp_path / "empty.txt").write_text(" \n")
    inputs = [script, tmp_path / "bad.txt", tmp_path / "two.txt", tmp_path / "empty.txt"]
    result = run("render", *inputs, "-o", tmp_path / "out", "--voice", "tone", "--seed", 5)
    assert result.exit_code == 2
    assert {p.name for p in (tmp_path / "out").iterdir()} == {"speech", "two"}
    *lines, summary = result.stderr.splitlines()
    assert lines[0].startswith(f"scorebreath: {tmp_path / 'bad.txt'}:1:4: ")
    assert any(line.startswith(f"scorebreath: {tmp_path / 'empty.txt'}") for line in lines)
    failed = f"{tmp_path / 'bad.txt'}, {tmp_path / 'empty.txt'}"
    assert summary == f"scorebreath: 2 of 4 rendered; failed: {failed}"
    single = run("render", script, "-o", tmp_path / "single", "--voice", "tone", "--seed", 5)
    assert single.exit_code == 0
    assert tree(tmp_path / "single") == tree(tmp_path / "out" / "speech")


def test_several_scripts_of_one_name_are_refused_before_anything_is_made(script: Path, tmp_path: Path) -> None:
    (tmp_path / "speech.txt").write_text("Another.")
    result = run("render", script, tmp_path / "speech.txt", "-o", tmp_path / "out", "--voice", "tone")
    assert result.exit_code == 2
    assert not (tmp_path / "out").exists()
    assert str(script) in result.stderr
    assert str(tmp_path / "speech.txt") in result.stderr


OPTIONS_OF_COMPILING = (
    ["--voice", "tone"], ["--model", "natural"], ["--preset", "nose"], ["--set", "nose_share=1"], ["--seed", "0"],
    ["--language", "en"], ["--poem"], ["--prose"], ["--lead", "1"], ["--tail", "1"], ["--no-breath-sound"],
    ["--breath-motion"],
)  # fmt: skip


@pytest.mark.parametrize("given", OPTIONS_OF_COMPILING, ids=lambda given: given[0])
def test_options_of_compiling_are_refused_on_a_score(rendered: Path, tmp_path: Path, given: list[str]) -> None:
    result = run("render", rendered / "score.json", "-o", tmp_path / "b", *given)
    assert result.exit_code == 2
    assert given[0] in result.stderr
    assert not (tmp_path / "b").exists()


def test_a_score_is_not_compiled_again(rendered: Path) -> None:
    result = run("compile", rendered / "score.json")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "is a score already" in result.stderr


def test_every_command_is_tried_here_or_among_those_that_show(root: Path) -> None:
    tests = "".join(path.read_text() for path in (root / "tests" / "cli").glob("test_*.py"))
    assert [name for name, *_ in COMMANDS if f'run("{name}"' not in tests and f'spawn("{name}"' not in tests] == []


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--language", "de-AT"], "language de-AT: espeak:de has nothing of its own for it; the text is read as de"),
        (["--language", "en_AU"], "language en_AU: espeak:en-us has nothing of its own for it; the text is read as en"),
        (["--language", "de"], ""),
        (["--language", "de-DE"], ""),
        (["--language", "en-GB"], ""),
        (["--language", "de-AT", "--voice", "tone"], ""),
    ],
)
def test_a_region_that_is_not_there_is_said_to_be_left_out(tmp_path: Path, options: list[str], said: str) -> None:
    (tmp_path / "in.txt").write_text("So.")
    result = run("compile", tmp_path / "in.txt", "-o", tmp_path / "score.json", *options)
    assert (result.exit_code, result.stderr) == (0, f"scorebreath: {said}\n" if said else "")


def test_a_score_that_ends_before_its_events_says_what_is_cut(script: Path, tmp_path: Path) -> None:
    path = tmp_path / "score.json"
    assert run("compile", script, "-o", path, "--voice", "tone", "--tail", "0").exit_code == 0
    assert run("curves", path, "-o", tmp_path / "whole.csv").stderr == ""
    score = load(path)[0]
    path.write_bytes(dumps(dataclasses.replace(score, duration=snap(score.duration - 2.25))))
    said = f"{path}: events go on for 2.25 s after its duration of {score.duration - 2.25:g} s; they are cut"
    assert run("curves", path, "-o", tmp_path / "cut.csv").stderr == f"scorebreath: {said}\n"
    result = run("render", path, "-o", tmp_path / "out", "--json")
    assert (result.exit_code, result.stderr) == (0, f"scorebreath: {said}\n")
    assert [(event["source"], event["text"]) for event in events(result.stdout) if event["event"] == "note"] == [
        (str(path), said)
    ]


def test_a_german_voice_reads_german(tmp_path: Path) -> None:
    """`--voice espeak:de` alone is as `--language de` beside it, for what is planned as well; else nothing is."""
    (tmp_path / "a.txt").write_text("Der Mann fragt, ob der Zug um 3 Uhr kommt, z. B. heute.", encoding="utf-8")

    def of(command: str, *options: str) -> str:
        done = run(command, tmp_path / "a.txt", *options, *(["-o", "-"] if command == "compile" else []))
        assert done.exit_code == 0, done.stderr
        return done.stdout

    assert of("compile", "--voice", "espeak:de") == of("compile", "--voice", "espeak:de", "--language", "de")
    assert json.loads(of("compile", "--voice", "espeak:de+f3"))["language"] == "de"
    assert json.loads(of("compile", "--voice", "espeak:de", "--language", "en"))["language"] == "en"
    assert json.loads(of("compile", "--voice", "espeak"))["language"] == "en"
    assert of("explain", "--voice", "espeak:de") == of("explain", "--language", "de")
