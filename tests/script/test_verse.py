from __future__ import annotations

import textwrap
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.script.verse import is_verse

EXAMPLES = Path(__file__).parents[2] / "examples"
PROSE = (EXAMPLES / "prose.txt").read_text("utf-8").replace("\n\n", "\0").replace("\n", " ").replace("\0", "\n\n")


@pytest.mark.parametrize("name", ["parallelen", "parallelen_emoticons"])
def test_poems_are_poems(name: str) -> None:
    assert is_verse((EXAMPLES / f"{name}.txt").read_text("utf-8"))


@pytest.mark.parametrize("name", ["prose", "forecast", "radio_chat", "markers"])
def test_prose_is_prose(name: str) -> None:
    assert not is_verse((EXAMPLES / f"{name}.txt").read_text("utf-8"))


@given(st.integers(12, 120))
def test_wrapped_prose_is_prose_at_any_width(width: int) -> None:
    paragraphs = PROSE.split("\n\n")[:12]
    wrapped = "\n\n".join(
        textwrap.fill(part, width, break_long_words=False, break_on_hyphens=False) for part in paragraphs
    )
    assert not is_verse(wrapped)


def test_too_short_to_tell() -> None:
    assert not is_verse("a rose\nis a rose\nis a rose")
    assert is_verse("a rose\nis a rose\nis a rose that\nis one")


def test_a_list_of_sentences_is_no_poem() -> None:
    assert not is_verse("I came home late.\nIt rained.\nNobody was there at all.\nI slept.\nThen I woke.")


def test_long_lines_are_no_verse() -> None:
    line = "a line that goes on and on and on, much longer than a line of verse would ever be"
    assert not is_verse("\n".join([line, line + " indeed", line, line + " more", line]))


def test_empty() -> None:
    assert not is_verse("")
