"""The examples, read: counts that a person checked, and the poem of S3 with and without its emoticons."""

from __future__ import annotations

from pathlib import Path

import pytest

from scorebreath.script.decode import decode
from scorebreath.script.model import Script
from scorebreath.script.reader import read

EXAMPLES = Path(__file__).parents[2] / "examples"


def example(name: str, language: str = "en") -> Script:
    return read(decode((EXAMPLES / f"{name}.txt").read_bytes(), name), language=language, file=name)


@pytest.mark.parametrize(
    ("name", "language", "least", "most"),
    [
        ("forecast", "en", 150, 300),
        ("radio_chat", "en", 150, 300),
        ("markers", "en", 100, 300),
        ("prose", "en", 2000, 3000),
        ("parallelen", "de", 90, 92),
    ],
)
def test_lengths(name: str, language: str, least: int, most: int) -> None:
    assert least <= len(example(name, language).text.split()) <= most


def test_prose_is_prose_and_the_poem_a_poem() -> None:
    assert [example(name).poem for name in ("forecast", "radio_chat", "markers", "prose", "parallelen")] == [
        False
    ] * 4 + [True]


def test_the_poem_has_an_edge_at_every_line_and_its_emoticons_change_no_word() -> None:
    """A6 and A11; Table 1 of S3."""
    plain, marked = example("parallelen", "de"), example("parallelen_emoticons", "de")
    words = [word for sentence in plain.sentences for word in sentence.words]
    lines = plain.text.split("\n")
    for line, text in enumerate(lines):
        edges = [word.edge for word in words if word.line == line]
        assert ("word" not in edges[-1:]) if text else not edges
    assert [sentence.stanza for sentence in plain.sentences] == [0, 1, 2, 3, 3, 4]
    kept = [word for sentence in marked.sentences for word in sentence.words]
    assert [word.text for word in kept] == [word.text for word in words]
    assert [word.line for word in kept] == [word.line for word in words]
    differing = [
        (word.text, word.edge, other.edge) for word, other in zip(words, kept, strict=True) if word.edge != other.edge
    ]
    assert not differing  # nor does the full stop behind the emoticon of "Grab:"
    assert all("-" not in word.spoken.text and ")" not in word.spoken.text for word in kept)


def test_every_marker_is_heard_by_the_planner() -> None:
    script = example("markers")
    words = [word for sentence in script.sentences for word in sentence.words]
    assert sum(word.marked for word in words) == script.text.count("_") > 10


def test_the_forecast_says_its_figures() -> None:
    spoken = " ".join(word.spoken.text for sentence in example("forecast").sentences for word in sentence.words)
    for phrase in (
        "four degrees Celsius",
        "two hundred meters",
        "nine thirty.",
        "ten kilometers per hour.",
        "twenty-five",
    ):
        assert phrase in spoken
    assert not any(character.isdecimal() for character in spoken)
