"""Syllables from phonemes."""

from __future__ import annotations

import pytest

from scorebreath.speech.espeak.syllables import nuclei
from scorebreath.speech.espeak.voice import EspeakVoice

ENGLISH = {
    "open": 2, "idea": 3, "area": 3, "the": 1, "little": 2, "water": 2, "rhythm": 2, "world": 1, "extraordinary": 5,
    "people": 2, "isn't": 2, "real": 2, "lion": 2, "fire": 2, "walked": 1, "wanted": 2, "breathing": 2, "a": 1,
}  # fmt: skip
GERMAN = {
    "Abend": 2, "Häuser": 2, "gehen": 2, "Familie": 4, "Mädchen": 2, "Ofen": 2, "beobachten": 4, "Theater": 3, "ich": 1,
    "Feuer": 2, "laufen": 2, "Vögel": 2,
}  # fmt: skip


def test_english(english: EspeakVoice) -> None:
    assert dict(zip(ENGLISH, english.syllables(list(ENGLISH)), strict=True)) == ENGLISH


def test_german(german: EspeakVoice) -> None:
    assert dict(zip(GERMAN, german.syllables(list(GERMAN)), strict=True)) == GERMAN


def test_near_is_one_syllable_in_britain() -> None:
    with EspeakVoice("en-gb") as british:
        assert list(british.syllables(["near", "area", "lion"])) == [1, 3, 2]


def test_a_count_depends_on_the_word_alone(english: EspeakVoice) -> None:
    words = [*ENGLISH, "pst", "x" * 30, "1984", "", "—", "42nd"]
    with EspeakVoice("en") as other:
        backwards = dict(zip(reversed(words), other.syllables(list(reversed(words))), strict=True))
    assert [backwards[word] for word in words] == list(english.syllables(words))


def test_thousands_of_words_and_odd_ones(english: EspeakVoice) -> None:
    words = [f"w{'a' * (index % 7)}t{index}" for index in range(2500)]
    counts = english.syllables(words)
    assert len(counts) == len(words)
    assert list(english.syllables(["tsk", "…", "", "🙂", "\ud800"]))[:3] == [1, 0, 0]


@pytest.mark.parametrize(
    ("phonemes", "code", "count"),
    [("p_ˈiː_p_əl", "en-us", 2), ("ˈaʊ_ɚ", "en-us", 2), ("aɪ_d_ˈiə", "en-us", 3), ("n_ˈiə", "en-gb", 1),
     ("l_ˌɛ__ɾ_ɚ w_ˈʌ_n", "en-us", 3), ("(en)_k_ɑː_(de)", "de", 1), ("p_ˈr̩_s_t", "cs", 1), ("", "en", 0)],
)  # fmt: skip
def test_nuclei(phonemes: str, code: str, count: int) -> None:
    assert nuclei(phonemes, code) == count
