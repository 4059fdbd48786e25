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


BALLAD = """The sun was shining on the sea,
Shining with all his might:
He did his very best to make
The billows smooth and bright--
And this was odd, because it was
The middle of the night."""


def test_capitals_tell_a_ballad_whose_lines_are_full() -> None:
    assert is_verse(BALLAD)
    assert not is_verse(BALLAD.lower())
    assert not is_verse(BALLAD.upper())


@given(st.integers(12, 120))
def test_wrapped_german_is_prose(width: int) -> None:
    """Its nouns have capitals."""
    text = (
        "Der Zug fuhr am Morgen durch das Tal, und die Reisenden sahen hinaus auf Wiesen, Bäche und kleine Dörfer, in "
        "denen noch kein Licht brannte. Ein alter Mann schlief; seine Tochter las einen Brief der Mutter, faltete ihn "
        "und legte das Papier wieder in die Tasche aus Leder, die neben dem Koffer auf dem Sitz am Fenster stand."
    )
    assert not is_verse(textwrap.fill(text, width, break_long_words=False))


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
