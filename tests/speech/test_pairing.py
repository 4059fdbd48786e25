"""Phonemes of a whole text, given to its words."""

from __future__ import annotations

from itertools import chain

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.speech.pairing import owners

PHONEMES = "aɪʊəɛiptkbdɡmnszʃfvlɹ"
words = st.lists(st.text(PHONEMES, min_size=1, max_size=6), min_size=1, max_size=8)


@given(words)
def test_words_said_as_they_are_alone_own_their_phonemes(said: list[str]) -> None:
    spoken = list(" ".join(said))
    expected: list[int | None] = list(chain.from_iterable([*([n] * len(word)), None] for n, word in enumerate(said)))
    assert owners(spoken, said) == expected[:-1]


@given(st.text(f"{PHONEMES}ːˈ ,.", max_size=40), words)
def test_every_phoneme_has_an_owner_and_they_ascend(spoken: str, said: list[str]) -> None:
    found = owners(list(spoken), said)
    assert len(found) == len(spoken)
    for symbol, owner in zip(spoken, found, strict=True):
        assert (owner is None) == (symbol in " ,.")
    known = [owner for owner in found if owner is not None]
    assert known == sorted(known)
    assert set(known) <= set(range(len(said)))


CASES = {
    "joined": ("ʌvðə ɹoʊd", ["ʌv", "ðə", "ɹoʊd"], "00 11 2222".replace(" ", "")),
    "changed": ("ɐ haʊs", ["eɪ", "haʊs"], "01111"),
    "a linking glide": ("ðɪʲ ɛnd", ["ðə", "ɛnd"], "000111"),
    "read as two": ("twɛnti θɹiː", ["twɛnti θɹiː"], "0000000000"),
    "nothing is heard of one": ("jɛs sɜː", ["jɛs", "", "sɜː"], "000222"),
    "a stress on each": ("ðə ˈoʊld", ["ðə", "ˈoʊld"], "001" + "1111"),
}


@pytest.mark.parametrize("case", CASES)
def test_what_is_spoken_otherwise_is_still_its_word_s(case: str) -> None:
    spoken, said, expected = CASES[case]
    found = owners(list(spoken), [list(word) for word in said])
    assert "".join(str(owner) for owner in found if owner is not None) == expected


def test_without_words_nothing_is_owned() -> None:
    assert owners(list("abc"), []) == [None, None, None]
