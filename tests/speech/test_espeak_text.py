"""What eSpeak NG is given to read."""

from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.score.events import Closing
from scorebreath.speech.espeak.text import prepare

ENDS: list[tuple[str, Closing, str]] = [
    ("along the river", "continuing", "along the river,"),
    ("along the river.", "continuing", "along the river,"),
    ("along the river;", "final", "along the river."),
    ('he said: "No!"', "final", 'he said: "No!'),
    ('he said: "No!"', "continuing", 'he said: "No,'),
    ("Really?!", "question", "Really?"),
    ("Is it?", "final", "Is it."),
    ("so ...", "final", "so."),
    ("(in brackets)", "continuing", "(in brackets,"),
    ("今日は。", "question", "今日は?"),
]


@pytest.mark.parametrize(("text", "closing", "said"), ENDS)
def test_the_end_tells_how_to_close(text: str, closing: Closing, said: str) -> None:
    assert prepare(text, closing).text == said


@pytest.mark.parametrize("text", ["", " ", "...", "—", '"?"', "\u200b", "\x00\x01", "\ud800"])
def test_what_says_nothing_is_empty(text: str) -> None:
    assert prepare(text, "final").text == ""


@given(st.text(st.characters(exclude_categories=()), max_size=40), st.sampled_from(["final", "continuing", "question"]))
def test_nothing_is_left_that_could_be_a_command_and_every_place_is_right(text: str, closing: Closing) -> None:
    said = prepare(text, closing)
    body = said.text[:-1]
    assert len(body) == len(said.places)
    assert not any(unicodedata.category(character) in ("Cc", "Cs", "Cn", "Co") for character in said.text)
    said.text.encode("utf-8")
    for character, place in zip(body, said.places, strict=True):
        assert character in (text[place], " ")
    for start in range(len(body)):
        first, last = said.span(start, start + 1)
        assert (first, last) == (said.places[start], said.places[start] + 1)


def test_a_soft_hyphen_is_left_out_and_a_span_goes_over_it() -> None:
    said = prepare("Schiff\u00adfahrt ja", "final")
    assert said.text == "Schifffahrt ja."
    assert said.span(0, 11) == (0, 12)
