"""Turns of a dialogue begin paragraphs; what only looks like one in prose does not."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.script.dialogue import turns
from scorebreath.script.reader import Reader, read

EXAMPLES = Path(__file__).parents[2] / "examples"
TALKS = [
    "HAMLET: To be or not to be.|OPHELIA: Good my lord",
    "HAMLET: To be or not to be|OPHELIA: Good my lord",
    "HAMLET: To be or not to be\nthat is the question|OPHELIA: Good my lord|FIRST LORD (aside): so|HAMLET: no",
    "A room in the castle|HAMLET: words, words\nwords|POLONIUS: What is the matter",
    "Q: Where were you|A: At home|Q: And then",
    "Anna: Wo warst du|Bernd: Zu Hause, wo\nsonst|Anna: Ach so",
    "Mrs. Smith: come in|Mr. O'Neill: thank you|Mrs. Smith: sit down",
]
PROSE = [
    "He bought what she had asked for in the\nmorning: bread, milk and so on, and went\nhome: it was late.",
    "It was as she had always said to him on the\nMonday: nothing lasts, and he had nothing at\nall to say to that: "
    "she was right.",
    "TIME: an essay on what passes us by and on\nwhat stays, if anything does.",
    "See https://a.org: it is\nhttp://b.org at\n10:30 or\n11:45 then.",
    "And he said unto the\nLORD: behold, and again he said to the\nLORD: behold, and went to\nbed "
    + "and slept\n" * 30,
]


def paragraphs(text: str) -> list[str]:
    found: dict[int, list[str]] = {}
    for sentence in read(text, poem=False).sentences:
        found.setdefault(sentence.stanza, []).append(sentence.text)
        assert (sentence.words[-1].edge == "paragraph") == (sentence.gap.strip(" ") in ("\n", ""))
    return [" ".join(parts) for parts in found.values()]


@pytest.mark.parametrize("marked", TALKS)
def test_a_turn_begins_a_paragraph(marked: str) -> None:
    assert paragraphs(marked.replace("|", "\n")) == marked.split("|")


@pytest.mark.parametrize("text", PROSE)
def test_prose_with_colons_stays_as_it_is(text: str) -> None:
    assert turns(text) == ()


@pytest.mark.parametrize("file", sorted(EXAMPLES.glob("*.txt")), ids=lambda file: file.stem)
def test_no_example_is_taken_for_a_dialogue(file: Path) -> None:
    assert turns(file.read_text("utf-8")) == ()


@given(st.integers(16, 120))
def test_wrapped_prose_full_of_colons_is_no_dialogue(width: int) -> None:
    """Names before colons come to stand at the beginnings of lines by chance alone."""
    prose = " ".join((EXAMPLES / "prose.txt").read_text("utf-8").split())
    colons = re.sub(r"(\w+), ", lambda found: found[1].capitalize() + ": ", prose)
    assert colons.count(": ") > 100
    assert turns(textwrap.fill(colons, width)) == ()


def test_turns_do_not_depend_on_how_the_text_arrives() -> None:
    text = TALKS[2].replace("|", "\n")
    reader = Reader(turns=turns(text))
    found = [sentence for letter in text for sentence in reader.feed(letter)] + reader.finish()
    assert tuple(found) == read(text).sentences


def test_a_label_before_a_line_of_verse_begins_a_stanza() -> None:
    text = "ROMEO: O blessed\nnight\nJULIET: Good\nnight"
    script = read(text, poem=True)
    assert [sentence.stanza for sentence in script.sentences] == [0, 1]
    assert [word.edge for sentence in script.sentences for word in sentence.words if word.text == "blessed"] == ["line"]
