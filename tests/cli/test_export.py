"""`export` and `formats`: a score in any format of the table."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from scorebreath.formats.formats import FORMATS
from scorebreath.script.markup.marked import marked
from scorebreath_cli.choices import CHOICES
from tests.cli.running import events, run

TEXT = "The night is quiet. :-) Who wakes, and who sleeps?\n"


@pytest.fixture(scope="module", name="score")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("export") / "score.json"
    assert run("compile", "-", "--voice", "tone", "-o", path, text=TEXT).exit_code == 0
    return path


def test_formats_are_listed() -> None:
    rows = events(run("formats", "--json").stdout)
    assert [(row["name"], row["suffix"], row["what"]) for row in rows] == [
        (form.name, form.suffix, form.what) for form in FORMATS.values()
    ]
    assert [line.split()[0] for line in run("formats").stdout.splitlines()[1:]] == list(FORMATS)
    assert CHOICES["formats"]() == list(FORMATS)


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_is_written_to_a_file_and_to_stdout(name: str, score: Path, tmp_path: Path) -> None:
    path = tmp_path / f"out{FORMATS[name].suffix}"
    told = run("export", score, "--to", name, "-o", path, "--fps", "25", "--json")
    assert told.exit_code == 0
    assert [event["event"] for event in events(told.stdout)] == ["started", "written", "done"]
    assert path.read_bytes()
    assert run("export", score, "--to", name, "--fps", "25").stdout_bytes == path.read_bytes()


def test_maryxml_from_a_score_is_a_script_again(score: Path, tmp_path: Path) -> None:
    path = tmp_path / "out.xml"
    assert run("export", score, "--to", "maryxml", "-o", path).exit_code == 0
    assert ElementTree.parse(path).getroot().tag == "{http://mary.dfki.de/2002/MaryXML}maryxml"
    assert marked(path.read_text(encoding="utf-8")).text == "The night is quiet. Who wakes, and who sleeps?"
    again = run("compile", path, "--voice", "tone", "--markup", "maryxml", "-o", tmp_path / "again.json")
    assert again.exit_code == 0
    assert (tmp_path / "again.json").read_bytes().count(b'"type":"emotion"') == 1


def test_what_export_refuses(score: Path, tmp_path: Path) -> None:
    wrong = run("export", score, "--to", "maryxm")
    assert (wrong.exit_code, wrong.stdout) == (2, "")
    assert wrong.stderr.startswith("scorebreath: no format is called 'maryxm' (there are curves.csv, ")
    assert wrong.stderr.endswith("; did you mean maryxml?\n")
    script = tmp_path / "a.txt"
    script.write_text(TEXT, encoding="utf-8")
    assert "is not a score" in run("export", script, "--to", "maryxml").stderr
    path = tmp_path / "out.xml"
    path.write_text("mine", encoding="utf-8")
    assert "--force replaces it" in run("export", score, "--to", "maryxml", "-o", path).stderr
    assert path.read_text(encoding="utf-8") == "mine"
    assert run("export", score, "--to", "maryxml", "-o", path, "--force").exit_code == 0
    assert "would replace its own input" in run("export", score, "--to", "maryxml", "-o", score, "--force").stderr
    assert "use -o FILE" in run("export", score, "--to", "maryxml", "--json").stdout
    assert run("export", score).exit_code == 2
