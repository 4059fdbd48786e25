"""Syllables by spelling."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import InputError
from scorebreath.planning.syllables import LONGEST, pyphen_counter, vowel_counter


def test_hyphenation_counts_as_the_papers_do() -> None:
    """With its known weakness (peers 0.4): a first syllable of one letter is never split off."""
    assert pyphen_counter("en")(["weather", "temperature", "open", "idea"]) == [2, 4, 1, 1]
    assert pyphen_counter("de")(["wunderbar", "aufgegangen", "Abend"]) == [3, 4, 1]


def test_languages_are_found_by_their_primary_tag() -> None:
    assert pyphen_counter("de-AT")(["Nebel"]) == pyphen_counter("de")(["Nebel"]) == [2]


def test_a_language_without_patterns_is_counted_by_vowels() -> None:
    assert pyphen_counter("ja") is vowel_counter
    assert pyphen_counter("xx")(["banana"]) == [3]


@pytest.mark.parametrize("language", ["", "e n", "Deutsch!", "../en"])
def test_what_is_no_language_is_said_to_be_none(language: str) -> None:
    with pytest.raises(InputError, match="must be a language tag"):
        pyphen_counter(language)


@pytest.mark.parametrize("language", ["en", "de", "fr", "xx"])
@given(words=st.lists(st.text(max_size=30), max_size=8))
def test_a_count_for_every_word_and_at_least_one_for_letters(language: str, words: list[str]) -> None:
    counts = pyphen_counter(language)(words)
    assert len(counts) == len(words)
    for word, count in zip(words, counts, strict=True):
        assert (count >= 1) == any(map(str.isalnum, word))
        assert count <= max(1, len(word)) * 2


def test_a_word_of_ten_thousand_letters_is_counted_in_pieces() -> None:
    assert pyphen_counter("en")(["na" * 5000]) == [10_000 // LONGEST * pyphen_counter("en")(["na" * (LONGEST // 2)])[0]]
