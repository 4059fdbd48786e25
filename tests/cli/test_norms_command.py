"""`norms`: what it takes, what it tells, what it refuses."""

from __future__ import annotations

import dataclasses
import shutil
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import pytest
import soundfile

from scorebreath.errors import EngineError
from scorebreath.media.store import MemoryStore
from scorebreath.report.norms.acoustics import SOUND
from scorebreath.report.norms.table import ROWS
from scorebreath.score.codec import dumps
from scorebreath.score.document import Score
from scorebreath.score.take import TakeWriter
from scorebreath_cli import printers
from scorebreath_cli.commands import norms as command
from tests.cli.running import events, run, spawn
from tests.cli.test_looking import complete
from tests.report.people import person
from tests.report.test_norms_sound import RATE, sound_of
from tests.report.test_norms_verdicts import ABOUT, EVENT


@pytest.fixture(scope="module")
def rendered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder as `render` leaves it, as far as `norms` looks."""
    folder = tmp_path_factory.mktemp("rendered") / "out"
    folder.mkdir()
    score = person(12)
    (folder / "score.json").write_bytes(dumps(score))
    soundfile.write(folder / "mix.wav", sound_of(score, breath_db=-44, speech_db=-20), RATE, subtype="PCM_24")
    return folder


@pytest.fixture
def alone(tmp_path: Path) -> Path:
    """A Score without anything beside it."""
    (tmp_path / "score.json").write_bytes(dumps(person(12)))
    return tmp_path / "score.json"


def rows(output: str) -> dict[str, dict[str, object]]:
    return {event["name"]: event for event in events(output) if event["event"] == "norm"}


def test_every_row_is_told(rendered: Path) -> None:
    result = run("norms", rendered)
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert lines[0].startswith("12 breath groups in ") and lines[1].split()[:4] == ["measure", "unit", "n", "median"]
    assert [line[: len(row.title)] for line, row in zip(lines[2:], ROWS, strict=False)] == [row.title for row in ROWS]
    assert "within" in result.stderr and result.stderr.startswith("scorebreath: ")


def test_what_is_outside_says_why(rendered: Path) -> None:
    lines = run("norms", rendered).stdout.splitlines()
    assert "outside: Breath group, speech alone: SD 0.00 is below 1 to 2.2 s" in lines


def test_programs_are_told_everything(rendered: Path) -> None:
    result = run("norms", rendered, "--json")
    told = events(result.stdout)
    assert [event["event"] for event in told] == ["about", *["norm"] * len(ROWS), "done"]
    assert set(told[0]) - {"schema", "event"} == ABOUT
    assert all(set(event) - {"schema", "event"} == EVENT for event in told[1:-1])
    done = told[-1]
    assert set(done) == {"schema", "event", "status", "within", "outside", "no_figure_to_compare", "too_few"}
    assert sum(done[word] for word in ("within", "outside", "no_figure_to_compare", "too_few")) == len(ROWS)
    assert result.stderr == ""


def test_the_sound_beside_the_score_is_listened_to(rendered: Path) -> None:
    for given in (rendered, rendered / "score.json"):
        found = rows(run("norms", given, "--json").stdout)
        assert found["breath_level"]["value"] == pytest.approx(-24, abs=0.3)
        assert found["centroid"]["n"] == 12
    unheard = rows(run("norms", rendered, "--json", "--no-sound").stdout)
    assert {unheard[row.name]["n"] for row in ROWS if row.part == SOUND} == {0}


def test_another_sound_is_listened_to(rendered: Path, tmp_path: Path) -> None:
    loud = tmp_path / "loud.wav"
    soundfile.write(loud, sound_of(person(12), breath_db=-30, speech_db=-20), RATE)
    result = run("norms", rendered, "--wav", loud, "--json")
    assert rows(result.stdout)["breath_level"]["value"] == pytest.approx(-10, abs=0.3)
    assert result.stderr == ""


def test_a_sound_of_another_length_is_told(rendered: Path, tmp_path: Path) -> None:
    short = tmp_path / "short.wav"
    soundfile.write(short, sound_of(person(12), breath_db=-44, speech_db=-20)[: 20 * RATE], RATE)
    result = run("norms", rendered, "--wav", short)
    assert result.exit_code == 0
    assert "short.wav: is 20 s long, the score " in result.stderr and "is it of this score?" in result.stderr


def test_breaths_are_rendered_where_there_is_no_sound(alone: Path) -> None:
    result = run("norms", alone, "--json")
    found = rows(result.stdout)
    assert result.exit_code == 0
    assert found["breath_level"]["n"] == found["centroid"]["n"] == 12
    assert -40 < float(str(found["breath_level"]["value"])) < -10
    assert float(str(found["centroid"]["value"])) > 500
    assert list(alone.parent.iterdir()) == [alone]


def test_an_old_mix_is_left_alone(alone: Path) -> None:
    mix = alone.with_name("mix.wav")
    soundfile.write(mix, sound_of(person(12), breath_db=-20, speech_db=-20)[: 10 * RATE], RATE)
    before = mix.read_bytes()
    result = run("norms", alone, "--json")
    assert "it is left alone, and breaths are rendered" in result.stderr
    assert float(str(rows(result.stdout)["breath_level"]["value"])) < -10
    assert mix.read_bytes() == before


def test_without_an_engine_the_rest_is_told(alone: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise EngineError("no engine today")

    monkeypatch.setattr("scorebreath.engine.offline.render", broken)
    result = run("norms", alone)
    assert result.exit_code == 0
    assert "scorebreath: the breaths are not listened to: no engine today" in result.stderr


def test_a_score_from_stdin(alone: Path) -> None:
    result = run("norms", "-", "--no-sound", "--json", text=alone.read_bytes())
    assert (result.exit_code, len(rows(result.stdout))) == (0, len(ROWS))


def test_a_take_is_a_score(tmp_path: Path) -> None:
    score = person(12)
    with TakeWriter(tmp_path / "take", dataclasses.replace(score, groups=(), events=(), duration=0.0)) as take:
        for name, info in score.media.items():
            take.sound(name, info)
        for group in score.groups:
            take.group(group)
        for event in score.events:
            take.event(event)
    for given in (tmp_path / "take", tmp_path / "take" / "take.jsonl"):
        result = run("norms", given, "--no-sound", "--json")
        assert result.exit_code == 0, result.output
        assert rows(result.stdout)["group_speech"]["n"] == 12


def test_a_score_in_which_nobody_breathes(tmp_path: Path) -> None:
    score = person(1)
    empty = dataclasses.replace(score, groups=(), events=(), duration=1.0)
    (tmp_path / "score.json").write_bytes(dumps(empty))
    result = run("norms", tmp_path / "score.json")
    assert (result.exit_code, result.stderr) == (0, f"scorebreath: {len(ROWS)} too few\n")


def test_the_page_is_written_whole(rendered: Path, tmp_path: Path) -> None:
    page = tmp_path / "pages" / "norms.html"
    result = run("norms", rendered, "--html", page, "--json")
    assert result.exit_code == 0, result.output
    (written,) = [event for event in events(result.stdout) if event["event"] == "written"]
    assert (written["path"], written["bytes"]) == (str(page), page.stat().st_size)
    root = ElementTree.fromstring(page.read_text(encoding="utf-8").removeprefix("<!DOCTYPE html>"))
    assert sum(each.tag.endswith("article") for each in root.iter()) == len(ROWS)
    assert list(page.parent.iterdir()) == [page]


def test_a_page_that_is_there_stays(rendered: Path, tmp_path: Path) -> None:
    page = tmp_path / "norms.html"
    page.write_text("mine", encoding="utf-8")
    result = run("norms", rendered, "--html", page)
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr == f"scorebreath: {page} exists already; --force replaces it\n"
    assert page.read_text(encoding="utf-8") == "mine"
    assert run("norms", rendered, "--html", page, "--force").exit_code == 0
    assert page.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")


def _refused() -> Iterator[tuple[list[str], str]]:
    yield ["norms", "nowhere"], "nowhere: no such file"
    yield ["norms", "{empty}"], "is a folder without take.jsonl"
    yield ["norms", "{text}"], "is not a score"
    yield ["norms", "{score}", "--body", "nobody"], "nobody"
    yield ["norms", "{score}", "--html", "-"], "--html -: the table goes to stdout; expected a file for the page"
    yield ["norms", "{score}", "--html", "{score}", "--force"], "would replace its own input"
    yield ["norms", "{folder}", "--html", "{score}", "--force"], "would replace its own input"
    yield ["norms", "{score}", "--wav", "{wav}", "--html", "{wav}", "--force"], "would replace its own input"
    yield ["norms", "{score}", "--html", "{empty}"], "is a folder"
    yield ["norms", "{score}", "--wav", "nowhere.wav"], "nowhere.wav: no such file"
    yield ["norms", "{score}", "--wav", "{text}"], "Expected a sound file"
    yield ["norms", "{score}", "--wav", "{empty}"], "is a folder"
    yield ["norms", "{score}", "--wav", "{wav}", "--no-sound"], "--wav and --no-sound contradict each other"
    yield ["norms", "{score}", "--engine", "embeded"], "embedded"
    yield ["norms", "a\0b"], "a\\x00b"


@pytest.mark.parametrize(("line", "said"), tuple(_refused()))
def test_what_is_wrong_is_one_line(line: list[str], said: str, rendered: Path, tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    (tmp_path / "text.txt").write_text("Hello there.", encoding="utf-8")
    shutil.copytree(rendered, tmp_path / "out")
    places = {
        "empty": tmp_path / "empty", "text": tmp_path / "text.txt", "score": tmp_path / "out" / "score.json",
        "wav": tmp_path / "out" / "mix.wav", "folder": tmp_path / "out",
    }  # fmt: skip
    result = run(*(each.format(**places) for each in line))
    assert (result.exit_code, result.stdout) == (2, "")
    (told,) = result.stderr.splitlines()
    assert told.startswith("scorebreath: ") and said in told
    assert (tmp_path / "out" / "score.json").read_bytes() == (rendered / "score.json").read_bytes()


def test_breaths_that_overlap_are_bad_input(tmp_path: Path) -> None:
    score = person(3)
    twice = tuple(dataclasses.replace(event, id=f"{event.id}.again") for event in score.events if event.id == "g1.in")
    (tmp_path / "score.json").write_bytes(dumps(dataclasses.replace(score, events=score.events + twice)))
    result = run("norms", tmp_path / "score.json", "--html", tmp_path / "n.html")
    assert result.exit_code == 2 and "overlap" in result.stderr
    assert not (tmp_path / "n.html").exists()


def test_only_a_few_of_many_breaths_are_rendered(monkeypatch: pytest.MonkeyPatch) -> None:
    rendered: list[Score] = []

    def render(score: Score, *_: object, **__: object) -> None:
        rendered.append(score)
        raise EngineError("enough")

    monkeypatch.setattr("scorebreath.engine.offline.render", render)
    printer = printers.make(json_lines=False)
    assert command._heard(
        person(450), MemoryStore(), given="-", wav=None, body=None, engine="embedded", printer=printer
    ) is None  # fmt: skip
    assert len(rendered[0].events) == 400


def test_it_runs_as_its_users_start_it(rendered: Path) -> None:
    result = spawn("norms", rendered)
    assert result.returncode == 0
    assert result.stdout.decode().splitlines()[2].startswith("Breath group, speech alone")


@pytest.mark.parametrize(
    ("line", "offered"),
    [("scorebreath nor", ["norms"]), ("scorebreath norms --no-s", ["--no-sound"]),
     ("scorebreath norms x --engine emb", ["embedded"])],
)  # fmt: skip
def test_the_command_completes(line: str, offered: list[str]) -> None:
    assert complete(line) == offered


def test_of_several_bodies_one_must_be_named(tmp_path: Path) -> None:
    score = person(3)
    (only,) = score.bodies
    two = dataclasses.replace(score, bodies=(only, dataclasses.replace(only, id="other")))
    (tmp_path / "score.json").write_bytes(dumps(two))
    result = run("norms", tmp_path, "--no-sound")
    assert result.exit_code == 2
    assert f"expected --body with one of {only.id}, other" in result.stderr
    assert run("norms", tmp_path, "--no-sound", "--body", only.id).exit_code == 0
