"""`--voice recording:FILE` as it is typed."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import soundfile

from scorebreath.media.store import MemoryStore
from scorebreath.pipeline import compile_text
from scorebreath.score.events import Utterance
from scorebreath.speech.voices import open_voice
from tests.cli.running import events, run
from tests.speech.takes import speech_of

TEXT = "Es regnet heute. Der alte Mann steht am Fenster, und er wartet auf seine Kinder."


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A take, its transcript, and its words as JSON."""
    where = tmp_path_factory.mktemp("takes")
    media = MemoryStore()
    with open_voice("espeak:de+f3", "de") as voice:
        score = compile_text(TEXT, voice=voice, media=media, language="de")
    samples, rate = speech_of(score, media)
    soundfile.write(where / "take.wav", samples, rate, subtype="PCM_16")
    (where / "text.txt").write_text(TEXT + "\n")
    words = [
        {"word": word.text, "start": event.onset + word.onset, "end": event.onset + word.onset + word.duration}
        for event in score.of(Utterance)
        for word in event.words
    ]
    (where / "words.json").write_text(json.dumps({"segments": [{"words": words}]}))
    return where


def voice(folder: Path) -> tuple[str, ...]:
    return ("--voice", f"recording:{folder / 'take.wav'}", "--language", "de")


@pytest.mark.parametrize("how", ["script", "transcript", "words", "transcript and words"])
def test_a_recording_becomes_everything(folder: Path, tmp_path: Path, how: str) -> None:
    given: list[object] = [folder / "text.txt"] if how == "script" else []
    if "transcript" in how:
        given += ["--transcript", folder / "text.txt"]
    if "words" in how:
        given += ["--words", folder / "words.json"]
    done = run("render", *given, *voice(folder), "-o", tmp_path / "out", "--json")
    assert done.exit_code == 0, done.output
    told = {event["event"]: event for event in events(done.stdout)}
    assert told["heard"]["words"] == len(TEXT.split())
    assert told["heard"]["breaths"] == 0
    score = json.loads((tmp_path / "out" / "score.json").read_text())
    assert score["bodies"][0]["voice"]["engine"] == "recording"
    said = [word["text"] for event in score["events"] if event["type"] == "utterance" for word in event["words"]]
    assert len(said) == len(TEXT.split())
    assert (tmp_path / "out" / "curves.csv").stat().st_size > 1000
    assert run("render", tmp_path / "out" / "score.json", "-o", tmp_path / "again").exit_code == 0


def test_mismatches_are_told_word_by_word(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "text.txt").write_text(TEXT.replace("heute", "heute sehr stark"))
    given = ("--transcript", tmp_path / "text.txt", "--words", folder / "words.json")
    done = run("compile", *given, *voice(folder), "-o", tmp_path / "score.json")
    assert done.exit_code == 0
    assert "'sehr stark' is written and not heard" in done.stderr
    again = run("compile", *given, *voice(folder), "-o", tmp_path / "score.json", "--force", "--json")
    (told,) = [event for event in events(again.stdout) if event["event"] == "mismatch"]
    assert (told["kind"], told["written"]) == ("missing", "sehr stark")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--voice", "recording:"), "expected the file of a recording"),
        (("--voice", "recording:TAKE"), "expected what it says: --transcript FILE"),
        (("--voice", "recording:none.wav", "TEXT"), "none.wav: no such file"),
        (("--voice", "recording:TEXT", "TEXT"), "Expected a sound file"),
        (("--voice", "recording:TAKE", "TEXT", "--transcript", "TEXT"), "expected one of them"),
        (("--voice", "recording:TAKE", "--words", "WORDS", "--textgrid", "TEXT"), "--words beside --textgrid"),
        (("--voice", "recording:TAKE", "TEXT", "--own-breaths", "kepp"), "did you mean keep?"),
        (("--voice", "recording:TAKE", "TEXT", "--cast", "a=b"), "--cast: nobody else speaks"),
        (("--voice", "recording:TAKE", "--textgrid", "TEXT"), "is no TextGrid"),
        (("--voice", "recording:TAKE", "TEXT", "--words", "TEXT"), "is no JSON: line 1, column 1"),
        (("--voice", "espeak", "TEXT", "--textgrid", "TEXT"), "--textgrid: belongs to --voice recording:FILE"),
        (("--voice", "espeak", "--transcript", "TEXT"), "--transcript: belongs to --voice recording:FILE"),
        ((), "nothing to do"),
    ],
)
@pytest.mark.parametrize("command", ["render", "compile"])
def test_what_cannot_be_is_refused_in_a_line(
    folder: Path, tmp_path: Path, command: str, arguments: tuple[str, ...], said: str
) -> None:
    places = {"TAKE": "take.wav", "TEXT": "text.txt", "WORDS": "words.json"}
    given = []
    for argument in arguments:
        family, colon, name = argument.rpartition(":")
        known = places.get(name)
        given.append(f"{family}{colon}{folder / known}" if known else argument)
    done = run(command, *given, "-o", tmp_path / "out")
    assert done.exit_code == 2, done.output
    assert said in done.stderr
    assert "Traceback" not in done.output
    assert not (tmp_path / "out").exists()


def test_a_take_is_never_written_over(folder: Path, tmp_path: Path) -> None:
    take = tmp_path / "mix.wav"
    take.write_bytes((folder / "take.wav").read_bytes())
    done = run("render", folder / "text.txt", "--voice", f"recording:{take}", "-o", tmp_path, "--force")
    assert done.exit_code == 2
    assert take.read_bytes() == (folder / "take.wav").read_bytes()


@pytest.mark.parametrize("command", ["live", "explain"])
def test_where_nothing_was_recorded_yet_it_is_refused(folder: Path, command: str) -> None:
    done = run(command, folder / "text.txt", "--voice", f"recording:{folder / 'take.wav'}")
    assert done.exit_code == 2
    assert "a recording says nothing but what was recorded" in done.stderr
