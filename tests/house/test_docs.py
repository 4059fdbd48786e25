"""The documents keep up with the code: every decision is there, every citation leads somewhere, every path exists."""

from __future__ import annotations

import dataclasses
import io
import re
import tokenize
from pathlib import Path

import pytest

from scorebreath.score.document import Score
from scorebreath.score.events import EVENTS, Event

ROOT = Path(__file__).resolve().parents[2]
SOURCES = (ROOT / "docs" / "sources.md").read_text(encoding="utf-8")
DECISIONS = (ROOT / "docs" / "decisions.md").read_text(encoding="utf-8")
DOCUMENTS = sorted([*(ROOT / "docs").glob("*.md"), ROOT / "README.md", ROOT / "CHANGELOG.md"])
CODE = sorted(path for top in ("scorebreath", "cli", "synthdefs", "tests") for path in (ROOT / top).rglob("*.py"))

NUMBERED = {"B": 62, "X": 18, "E": 10, "A": 60, "Y": 7}
"""Letter of a citation, and how many there are."""
CITATION = re.compile(r"\b([ABEXY])([1-9]\d?)\b")
PHYSIOLOGY = re.compile(r"physiology(?:\.md)? (\d+(?:\.\d+)?)")


def said(path: Path) -> str:
    """Comments and strings of a Python file."""
    tokens = tokenize.generate_tokens(io.StringIO(path.read_text(encoding="utf-8")).readline)
    return "\n".join(t.string for t in tokens if t.type in (tokenize.COMMENT, tokenize.STRING))


def listed() -> set[str]:
    rows = re.findall(r"^\| ([ABEX]\d+) \|", SOURCES, re.MULTILINE)
    open_points = SOURCES[SOURCES.index("Open in S3:") :].split("\n\n")[0]
    return {*rows, *re.findall(r"\bY\d+\b", open_points)}


def test_every_number_is_listed_once() -> None:
    rows = re.findall(r"^\| ([ABEX]\d+) \|", SOURCES, re.MULTILINE)
    assert len(rows) == len(set(rows))
    assert listed() == {f"{letter}{n}" for letter, count in NUMBERED.items() for n in range(1, count + 1)}


@pytest.mark.parametrize("number", range(1, NUMBERED["X"] + 1))
def test_every_open_question_is_decided(number: int) -> None:
    entry = re.search(rf"^### X{number}: .*?(?=^##|\Z)", DECISIONS, re.MULTILINE | re.DOTALL)
    assert entry, f"X{number} has no entry in docs/decisions.md"
    for part in ("Question:", "Answer:", "Because:", "Where:"):
        assert f"\n{part} " in entry.group(0), f"X{number} lacks {part}"


def test_every_open_question_of_the_face_is_decided() -> None:
    assert set(re.findall(r"^- (Y\d+|A11),", DECISIONS, re.MULTILINE)) == {"A11", *(f"Y{n}" for n in range(1, 8))}


def test_every_citation_in_the_code_leads_to_the_sources() -> None:
    known = listed()
    lost = {f"{p.relative_to(ROOT)}: {a}{n}" for p in CODE for a, n in CITATION.findall(said(p)) if a + n not in known}
    assert lost == set()


def test_every_physiology_section_cited_is_in_the_sources() -> None:
    known = set(re.findall(r"^### (\d+(?:\.\d+)?) ", SOURCES, re.MULTILINE))
    texts = {p: said(p) for p in CODE} | {p: p.read_text(encoding="utf-8") for p in DOCUMENTS}
    lost = {
        f"{p.relative_to(ROOT)}: {n}" for p, text in texts.items() for n in PHYSIOLOGY.findall(text) if n not in known
    }
    assert lost == set()


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda p: p.name)
def test_every_path_and_link_in_a_document_exists(document: Path) -> None:
    text = document.read_text(encoding="utf-8")
    prose = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    paths = re.findall(r"`((?:scorebreath|cli|synthdefs|tests|docs|examples|benchmarks)/[\w./-]*)`", prose)
    links = [link.partition("#")[0] for link in re.findall(r"\]\(([^)\s]+)\)", prose) if "://" not in link]
    lost = [path for path in paths if not (ROOT / path).exists()]
    lost += [link for link in links if link and not (document.parent / link).exists()]
    assert lost == []


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda p: p.name)
def test_every_name_said_to_be_in_a_file_is_there(document: Path) -> None:
    """`name` in `file.py`: the name is a word of that file."""
    pairs = re.findall(r"`(\w+)`(?:, `(\w+)`)* in `([\w/]+\.py)`", document.read_text(encoding="utf-8"))
    for *names, path in pairs:
        for name in filter(None, names):
            assert re.search(rf"\b{name}\b", (ROOT / path).read_text(encoding="utf-8")), f"{name} is not in {path}"


def test_the_score_document_lists_every_event_and_its_fields() -> None:
    text = (ROOT / "docs" / "score.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(\w+)` \| [^|]+ \| ([^|]+) \|$", text, re.MULTILINE)
    told = {kind: set(re.findall(r"`(\w+)`", own)) for kind, own in rows}
    common = {field.name for field in dataclasses.fields(Event)}
    assert told == {
        name: {field.name for field in dataclasses.fields(kind)} - common for name, (kind, _) in EVENTS.items()
    }


def test_the_score_document_lists_every_key() -> None:
    text = (ROOT / "docs" / "score.md").read_text(encoding="utf-8")
    rows = set(re.findall(r"^\| `(\w+)` \| [^|]+ \|$", text, re.MULTILINE))
    assert rows == {field.name for field in dataclasses.fields(Score)} - {"x"} | {"schema"}
