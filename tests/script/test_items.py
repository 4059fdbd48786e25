"""Items of lists: each is kept apart from the one before, and bullets are not spoken."""

from __future__ import annotations

import pytest

from scorebreath.script.items import items
from scorebreath.script.reader import read


def shown(text: str) -> str:
    words = [word for sentence in read(text, poem=False).sentences for word in sentence.words]
    return " ".join(f"{word.text}:{word.edge}" for word in words)


@pytest.mark.parametrize("bullet", ["-", "–", "*", "•", "◦"])
def test_bullets(bullet: str) -> None:
    text = f"Buy\n{bullet} eggs\n{bullet} milk and\n  honey,\n  {bullet} bread"
    assert shown(text) == "Buy:semicolon eggs:semicolon milk:word and:word honey:semicolon bread:paragraph"
    (sentence,) = read(text, poem=False).sentences
    assert [word.spoken.text for word in sentence.words] == ["Buy,", "eggs,", "milk", "and", "honey,", "bread."]
    assert all(bullet not in word.source.cut(text) for word in sentence.words)


def test_a_list_from_the_beginning() -> None:
    assert shown("* eggs\n* milk") == "eggs:semicolon milk:paragraph"


def test_numbers_are_said_and_begin_items() -> None:
    assert shown("Do:\n1. eat\n2. drink") == "Do:semicolon 1:word eat:semicolon 2:word drink:paragraph"
    assert shown("Do\na) eat\nb) drink") == "Do:semicolon a:semicolon eat:semicolon b:semicolon drink:paragraph"
    assert shown("Do\n(1) eat") == "Do:semicolon 1:semicolon eat:paragraph"


def test_a_line_that_begins_with_a_number_by_chance_is_no_item() -> None:
    text = "It was on the\n3. of May that I\nsaw 5 -\n7 of them\n-but not\n*all* of them"
    assert items(text) == ([], [])
    assert "the:word" in shown(text)


def test_a_stronger_edge_stays() -> None:
    assert "so:sentence" in shown("Is it so?\n- yes")
    assert [word.spoken.text for word in read("Do so;\n- eat", poem=False).sentences[0].words] == ["Do", "so;", "eat."]
    script = read("Eat eggs.\n- Drink milk.\n- Go.", poem=False)
    assert [sentence.text for sentence in script.sentences] == ["Eat eggs.", "Drink milk.", "Go."]


def test_items_of_a_poem_are_more_than_lines() -> None:
    words = [word for sentence in read("Buy\n- eggs\n- milk\nnow", poem=True).sentences for word in sentence.words]
    assert [word.edge for word in words] == ["semicolon", "semicolon", "line", "paragraph"]
