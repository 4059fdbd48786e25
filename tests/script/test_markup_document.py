"""docs/markup.md says what the tables say, and the examples with markup are read as they are meant."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scorebreath.parameters.states import STATES
from scorebreath.script.marks import Act, BreathingMark, NamedMark, NoBreath, ProsodyMark, StateMark, VoiceMark
from scorebreath.script.markup import values
from scorebreath.script.markup.elements import ELEMENTS
from scorebreath.script.markup.marked import is_ssml, marked
from scorebreath.script.markup.names import TAGS, Tag
from scorebreath.script.markup.say_as import INTERPRETATIONS
from scorebreath.script.reader import read

ROOT = Path(__file__).resolve().parents[2]
DOCUMENT = (ROOT / "docs" / "markup.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (.+?) \|$", DOCUMENT, re.MULTILINE)


@pytest.mark.parametrize("tag", TAGS, ids=lambda tag: tag.name)
def test_every_tag_has_a_row_with_its_other_names(tag: Tag) -> None:
    (found,) = [line for line in ROWS if line.startswith(f"`{tag.form}` |")]
    assert re.findall(r"`([\w-]+)`", found.split("|")[1]) == list(tag.aliases)


def test_every_element_has_a_row_with_its_attributes() -> None:
    cells = {line.split(" | ")[0]: line for line in ROWS}
    for name, element in ELEMENTS.items():
        (line,) = [line for cell, line in cells.items() if f"`<{name}>`" in cell or f"`<{name}/>`" in cell]
        assert all(f"`{attribute}`" in line for attribute in element.attributes), name


@pytest.mark.parametrize(
    ("row", "table"),
    [
        ("break strength", values.BREAKS),
        ("prosody rate", values.RATES),
        ("prosody pitch", values.PITCHES),
        ("prosody volume", values.VOLUMES),
        ("amazon: volume", values.BREATH_LEVELS),
        ("amazon: duration", values.BREATH_LENGTHS),
        ("amazon: frequency", values.BREATH_FREQUENCIES),
    ],
)
def test_every_value(row: str, table: dict[str, float]) -> None:
    (found,) = [line for line in ROWS if line.startswith(f"`{row}` |")]
    shown = {name: float(value) for name, value in re.findall(r"([a-z-]+) (-?\d+(?:\.\d+)?)(?=[ ,;])", found)}
    assert {name: shown[name] for name in table} == dict(table)


def test_every_state_and_interpretation_is_named() -> None:
    assert all(re.search(rf"\b{name}\b", DOCUMENT) for name in STATES)
    for name, kind in INTERPRETATIONS.items():
        (line,) = [line for line in ROWS if f"`{name}`" in line.split(" | ")[0]]
        assert all(f"`{form}`" in line for form in kind.formats.split(", ") if form)


def test_the_document_shows_a_text_that_can_be_read() -> None:
    (shown,) = re.findall(r"^## Inline tags\n\n((?: {4}.+\n)+)", DOCUMENT, re.MULTILINE)
    assert [mark.written for mark in marked(shown).marks] == [
        "[state anxious 0.8 over 2]", "[pause 0.6]", "[sigh]", "[/state]", "[laugh]",
    ]  # fmt: skip


def test_the_examples() -> None:
    tagged = (ROOT / "examples" / "tags.txt").read_text(encoding="utf-8")
    script = read(tagged)
    kinds = {type(mark) for mark in script.marks}
    assert kinds == {Act, NoBreath, StateMark, NamedMark}
    assert len(script.marks) == tagged.count("[")
    assert "[" not in script.text
    spoken = (ROOT / "examples" / "two_voices.ssml").read_text(encoding="utf-8")
    assert is_ssml(spoken)
    script = read(spoken)
    assert {type(mark) for mark in script.marks} == {Act, VoiceMark, NamedMark, ProsodyMark, BreathingMark}
    assert [sentence.text for sentence in script.sentences][:4] == [
        "The train now standing at platform twelve is the 19:42 to Aberdeen.",
        "Calling at all stations, except on Sundays.",
        "Excuse me, is this the one with the sleeping car?",
        "I was told coach B.",
    ]
