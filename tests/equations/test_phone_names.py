"""IPA and SAMPA (A10): the tables walked, and the names of S3's Table 2."""

from __future__ import annotations

import pytest

from scorebreath.equations.phones import (
    JOINED,
    MARKS,
    MARY,
    ipa_of,
    is_vowel,
    letters_of,
    makings,
    sampa_of,
    sounds_of,
)
from scorebreath.errors import InputError

TABLE_2 = {
    "'?{s": "ˈʔɛs", "'gI-N@n": "ˈɡɪ.ŋən", "' tsvAI": "ˈtsvaɪ", "pa-ra-'le:-l@n": "pa.ʁa.ˈleː.lən",
    "'?Ins": "ˈʔɪns", "'?{nt-lo:z@": "ˈʔɛnt.loːzə", "hi-'naUs": "hi.ˈnaʊs",
}  # fmt: skip
ESPEAK = {
    "en-us": "iː ɛ k s z eɪ d uː n b j t ɪ dʒ l m p f ʌ v ɹ aɪ əl ə ɑːɹ æ ɑː oʊ w ɡ ɚ i ŋ ᵻ h ɾ ʃ ɜː aʊ ɔːɹ ɔː ɐ θ ɔɪ "
    "ʊ ɔ iə ð ʒ ɛɹ ɪɹ ʊɹ aɪɚ aɪə r ʔ n̩ x ɬ tʃ",
    "en-gb": "a əʊ ɒ eə ʊə iːː",
    "de": "eː ts ç yː ʏ œ øː ɛː ɔø ɛɪ ʊɐ pf oː o e ɾ ɑ a ʁ ɑ̃ ɜ",
}  # fmt: skip
"""What eSpeak NG 1.52 gives for every word of three letters and the words of some texts."""


@pytest.mark.parametrize(("sampa", "ipa"), TABLE_2.items())
def test_names_of_table_2(sampa: str, ipa: str) -> None:
    assert ipa_of(sampa, "de") == ipa_of(sampa, "de-AT") == ipa


@pytest.mark.parametrize("letter", makings())
def test_every_letter_has_a_name_that_leads_back(letter: str) -> None:
    name = sampa_of(letter)
    assert name.isascii()
    assert [sound.ipa for sound in sounds_of(name)] == [letter]


def test_names_are_unique() -> None:
    names = [sampa_of(letter) for letter in makings()]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("mark", [mark for mark in MARKS if mark not in "ˈˌ."])
def test_marks_hang_on_the_phone_before(mark: str) -> None:
    (sound,) = sounds_of("t" + MARKS[mark])
    assert sound.ipa[0] == "t"
    assert MARKS[sound.ipa[1:]] == MARKS[mark]


@pytest.mark.parametrize("joined", JOINED)
def test_diphthongs_and_affricates_are_one_phone(joined: str) -> None:
    (sound,) = sounds_of(joined)
    assert 2 <= len(letters_of(sound.ipa)) <= 3


@pytest.mark.parametrize(("language", "name"), [(language, name) for language, row in MARY.items() for name in row])
def test_what_a_language_says_wins(language: str, name: str) -> None:
    assert "".join(sound.ipa for sound in sounds_of(name, language)) == MARY[language][name]


@pytest.mark.parametrize("language", ESPEAK)
def test_every_phone_of_espeak_is_made_of_known_letters(language: str) -> None:
    for ipa in ESPEAK[language].split():
        letters = letters_of(ipa)
        assert letters, ipa
        assert set(letters) <= set(makings()), ipa


def test_stress_and_syllables() -> None:
    sounds = sounds_of("h @ - ' l @U", "en-US")
    assert [(sound.ipa, sound.stress, sound.syllable) for sound in sounds] == [
        ("h", 0, 0), ("ə", 0, 0), ("l", 1, 1), ("əʊ", 1, 1),
    ]  # fmt: skip
    assert sounds_of("'bVt,@")[-1].stress == 2


@pytest.mark.parametrize("wrong", ["t;", "ŋ", "'a€"])
def test_what_is_no_sampa_is_said(wrong: str) -> None:
    with pytest.raises(InputError, match="sampa="):
        sounds_of(wrong)


def test_vowels() -> None:
    assert is_vowel("ɐ̃ʊ̃")
    assert not is_vowel("ʔœ")
    assert not is_vowel("ˈ")
