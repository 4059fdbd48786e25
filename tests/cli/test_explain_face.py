"""`explain --face`: what the face does, and why."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scorebreath.score import codec
from scorebreath.speech.tone import voice as tone_voice
from tests.cli.running import events, run
from tests.report.faced import faced

TWO = "<speak>One, two. <voice name='tone'>Three, four.</voice></speak>"


@pytest.fixture
def score(tmp_path: Path) -> Path:
    path = tmp_path / "score.json"
    path.write_bytes(codec.dumps(faced()))
    return path


def test_each_event_is_a_line(score: Path) -> None:
    told = run("explain", score, "--face")
    assert told.exit_code == 0
    lines = told.stdout.splitlines()
    wink = next(line for line in lines if "wink: ;-)" in line)
    assert wink.split() == ["2.200", "blink", "right", "lid", "1.00,", "250", "ms", '"bake', 'a"', "wink:", ";-)"]
    first = next(line for line in lines if "blink_by_itself" in line)
    assert "(pause)" in first
    assert any("(markup)" in line and "kidding 1.00 at 2.21 s" in line for line in lines)
    assert "from blink to blink 1.90 s on average" in told.stderr


def test_rules_are_counted_below(score: Path) -> None:
    lines = run("explain", score, "--face").stdout.splitlines()
    start = next(n for n, line in enumerate(lines) if line.split() == ["kind", "rule", "count", "per", "minute"])
    counted = {line.split()[1]: int(line.split()[-2]) for line in lines[start + 1 :]}
    assert counted["brow_at_maximum"] == counted["word_search"] == 1
    assert sum(counted.values()) == start == len(faced().events) - len([e for e in faced().events if e.type in STILL])


STILL = {"utterance", "inspiration", "hold", "expiration", "phrase", "pause"}


def test_each_event_is_an_object(score: Path) -> None:
    told = events(run("explain", score, "--face", "--json").stdout)
    faces = [event for event in told if event["event"] == "face"]
    (wink,) = [event for event in faces if event["id"] == "wink"]
    assert (wink["time"], wink["kind"], wink["words"], wink["origin"]) == (2.2, "blink", "bake a", "rule")
    assert wink["amounts"] == {"left": 0.0, "right": 1.0, "close": 0.075, "hold": 0.015, "open": 0.16}
    assert told[-1]["event"] == "done"
    assert (told[-1]["events"], told[-1]["blink_interval"]) == (len(faces), 1.9)
    assert {event["event"] for event in told} == {"face", "rule", "done"}


def test_a_text_is_spoken_for_it_and_not_without(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    script = tmp_path / "a.txt"
    script.write_text("Poppy may bake a pie. Can you eat a whole apple pie with me tomorrow?")
    told = run("explain", script, "--face", "--voice", "tone", "--json")
    assert told.exit_code == 0
    rows = [event for event in events(told.stdout) if event["event"] == "face"]
    assert {"gaze", "blink"} <= {row["kind"] for row in rows}
    assert all(row["rule"] for row in rows)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.txt"], "everything stays in memory"

    def refuse(*_: object, **__: object) -> None:
        raise AssertionError("spoken")

    monkeypatch.setattr(tone_voice.ToneVoice, "speak_all", refuse)
    assert run("explain", script, "--voice", "tone").exit_code == 0


def test_the_face_may_be_named_behind_the_flag(tmp_path: Path) -> None:
    script = tmp_path / "a.txt"
    script.write_text("One two three four. Five six seven eight nine ten!")
    said = {}
    for place in (["--face", "albrecht-2002", script], [script, "--face", "albrecht-2002"], [script, "--face"]):
        told = run("explain", *place, "--voice", "tone", "--json")
        assert told.exit_code == 0, told.stderr
        said[place[-1], place[0]] = told.stdout
    first, second, default = said.values()
    assert first == second != default
    again = run("explain", script, "--face", "--voice", "tone", "--set", "face=albrecht-2002", "--json")
    assert again.stdout == first


def test_what_is_left_out_is_not_told(tmp_path: Path) -> None:
    script = tmp_path / "a.txt"
    script.write_text("One two three four :-) . Five six seven eight nine ten?")
    told = run("explain", script, "--face", "--voice", "tone", "--without", "gaze,blinks", "--json")
    kinds = {event["kind"] for event in events(told.stdout) if event["event"] == "face"}
    assert kinds
    assert not kinds & {"gaze", "blink"}


def test_one_body_of_several(tmp_path: Path) -> None:
    script = tmp_path / "two.ssml"
    script.write_text(TWO)
    both = events(run("explain", script, "--face", "--json").stdout)
    assert {event["body"] for event in both if event["event"] == "face"} == {"body", "body2"}
    one = events(run("explain", script, "--face", "--json", "--body", "body2").stdout)
    assert {event["body"] for event in one if event["event"] == "face"} == {"body2"}
    assert "body2 " in run("explain", script, "--face").stdout
    wrong = run("explain", script, "--face", "--body", "body3")
    assert wrong.exit_code == 2
    assert "--body body3: expected body, body2; did you mean" in wrong.stderr


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--face", "albrecht"], "albrecht: explain takes one script or score; did you mean albrecht-2002?"),
        (["other.json"], "other.json: explain takes one script or score"),
        (["--body", "body"], "--body"),
        (["--face", "--without", "gaze"], "is a score; --without belongs to compiling a script"),
        (["--face", "restrained"], "is a score; --face belongs to compiling a script"),
    ],
)
def test_what_cannot_be_is_refused(score: Path, arguments: list[str], said: str) -> None:
    wrong = run("explain", score, *arguments)
    assert (wrong.exit_code, wrong.stdout) == (2, "")
    assert said in wrong.stderr
    as_json = run("explain", score, *arguments, "--json")
    assert json.loads(as_json.stdout)["event"] == "error"


def test_a_score_without_a_face_has_nothing_to_tell(tmp_path: Path) -> None:
    script = tmp_path / "a.txt"
    script.write_text("One two three.")
    told = run("explain", script, "--face", "--voice", "tone", "--without", "blinks,brows,head,gaze,emotion")
    assert (told.exit_code, told.stdout) == (0, "")
    assert "0 movements of the face" in told.stderr
