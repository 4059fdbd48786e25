"""Which words bear accents, which hesitate, and what questions ask for: the tables, walked (A7, A32)."""

from __future__ import annotations

import tomllib
import unicodedata
from importlib.resources import files

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.planning.sites import function_words
from scorebreath.script.accents import is_content, is_hesitation
from scorebreath.script.asking import asks_for_word
from scorebreath.script.lexicon import lexicon
from scorebreath.script.normalise.numbers import cardinal

LANGUAGES = ("en", "de")
ACCENTED = {
    "en": "all almost both everybody everyone everything few half less many more most neither no nobody not nothing "
    "off one only out several very quite rather once mr mrs ms dr st & + plus",
    "de": "alle allen aller alles beide beiden beinahe einige einigen kein keine keinem keinen keiner keines mehr "
    "nicht niemand viele vielen sehr fast kaum ganz plus & + bzw dr frau herr",
}
"""Small words of the planner that speakers do accent, and what is read as another word."""
NEGATED = "ain aren couldn didn doesn don hadn hasn haven isn mustn needn shouldn wasn weren wouldn"
"""Auxiliaries as the planner has them, without "'t"."""


def rows(language: str) -> dict[str, dict[str, list[str]]]:
    table = files("scorebreath.script").joinpath("tables", f"{language}.toml").read_text(encoding="utf-8")
    return tomllib.loads(table)


@pytest.mark.parametrize("language", LANGUAGES)
def test_tables_hold_words_as_they_are_looked_up(language: str) -> None:
    for name, part in rows(language).items():
        for kind, lines in part.items():
            words = " ".join(lines).split()
            assert len(words) == len(set(words)), (name, kind)
            for word in words:
                assert word == unicodedata.normalize("NFC", word).lower(), word
                assert "’" not in word, word


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_function_word_bears_none_however_it_is_written(language: str) -> None:
    for word in lexicon(language).function:
        for written in (word, word.upper(), word.capitalize(), f"“{word},”", unicodedata.normalize("NFD", word)):
            assert not is_content(written.replace("'", "’"), language), written


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_planner_s_small_words_are_known_here_or_bear_accents(language: str) -> None:
    """Two tables for two questions: neither may forget what the other knows."""
    small = function_words(language)
    words = small.clause | small.coordinators | small.before_subject | small.subjects | small.phrase | small.clinging
    unknown = {word for word in words | small.pairing if is_content(word, language)}
    assert unknown <= {*ACCENTED[language].split(), *NEGATED.split()}


@pytest.mark.parametrize("language", LANGUAGES)
def test_numbers_are_content_words(language: str) -> None:
    for number in (*range(1, 101), 1000, 1_000_000):
        said = cardinal(number, language)
        assert is_content(said, language), said
        assert is_content(str(number), language)
    assert not is_content("and" if language == "en" else "und", language)  # in "one hundred and five"


@pytest.mark.parametrize(
    ("language", "content", "function"),
    [
        (
            "en",
            "garden Alice's don't couldn't not rose-tree off gives seven o'clock nobody well-to-do",
            "she's it’s I'll you'd 'tis they’re that's who'd of.the o'",
        ),
        (
            "de",
            "Haus nicht Parallelen ewiges hinaus wußtens geht's U-Bahn kein eins sieben",
            "ich's ist's war’s 'ne daß über zum hätte das.war",
        ),
    ],
)
def test_words_of_either_kind(language: str, content: str, function: str) -> None:
    for word in content.split():
        assert is_content(word, language), word
    for word in function.split():
        assert not is_content(word.replace(".", " "), language), word


def test_a_word_of_several_counts_if_one_of_them_does() -> None:
    assert is_content("did not", "en") and is_content("the garden", "en")
    assert not is_content("was the", "en")
    assert is_content("noch nicht", "de")


def test_a_language_without_a_table_has_content_words_alone() -> None:
    assert is_content("il", "it") and is_content("the", "xx") and not is_content("", "xx")


@pytest.mark.parametrize(
    ("language", "words"),
    [("en", "er errr erm uhm um uh hmm Er... UMMM uuuh"), ("de", "äh ähm öhm aeh aehm Ääähm hm oehm ÄHMMM öööh")],
)
def test_hesitations(language: str, words: str) -> None:
    for word in words.split():
        assert is_hesitation(word, language), word
        assert is_hesitation(unicodedata.normalize("NFD", word), language), word
        assert not is_content(word, language), word


@pytest.mark.parametrize(
    ("language", "words"), [("en", "err hum her ear umber the"), ("de", "er um ehe eh Uhr ahm hin")]
)
def test_words_that_only_look_like_hesitations(language: str, words: str) -> None:
    for word in words.split():
        assert not is_hesitation(word, language), word


@given(st.sampled_from(LANGUAGES), st.data())
def test_any_number_of_repeated_letters_hesitates_alike(language: str, data: st.DataObject) -> None:
    word = data.draw(st.sampled_from(sorted(lexicon(language).sounds)))
    times = data.draw(st.lists(st.integers(1, 6), min_size=len(word), max_size=len(word)))
    written = "".join(letter * count for letter, count in zip(word, times, strict=True))
    assert is_hesitation(written, language) == (written not in lexicon(language).no_sounds)


def test_people_hesitate_alike_in_all_languages() -> None:
    for language in ("en", "de", "sv", "xx"):
        assert all(is_hesitation(word, language) for word in ("errr", "uhm", "aehm", "Ähm"))
    assert not any(is_hesitation(word, "da") for word in ("er", "um", "uh"))  # words there, for all we know


@pytest.mark.parametrize(
    ("language", "question"),
    [
        ("en", "Who came?"),
        ("en", "And to whom did you give it?"),
        ("en", "What’s your name?"),
        ("en", "When did you come?"),
        ("en", "Why?"),
        ("en", "He asked | when?"),
        ("en", "Very | where’s the Duchess?"),
        ("en", "And besides | what would be the use?"),
        ("de", "Was soll aus uns werden?"),
        ("de", "Von wem hab ich es?"),
        ("de", "Aber wenn es so wäre | wer wäre schuld?"),
        ("de", "Warum?"),
        ("de", "Hallo wie geht es | wie geht es dir?"),
        ("de", "Sag mal | was machst du da?"),
        ("de", "Peter | wie alt bist du?"),
    ],
)
def test_questions_for_a_word(language: str, question: str) -> None:
    assert asks_for_word([phrase.split() for phrase in question.split("|")], language)


@pytest.mark.parametrize(
    ("language", "question"),
    [
        ("en", "Can you show me the way to the conference hall?"),
        ("en", "Would you tell me | why you are painting those roses?"),
        ("en", "When she came | did you see her?"),
        ("en", "Didn't she say | who was there?"),
        ("en", "And is it you?"),
        ("en", "You know the man | who came?"),
        ("de", "Warn sie noch Parallelen?"),
        ("de", "Sollte der Wecker nicht geschlagen haben?"),
        ("de", "Weißt du | wo er ist?"),
        ("de", "Weißt du | wie alt er ist?"),
        ("de", "Siehst du was | was geschehen ist?"),
        ("it", "Chi è?"),
        ("en", ""),
    ],
)
def test_questions_for_yes_or_no(language: str, question: str) -> None:
    assert not asks_for_word([phrase.split() for phrase in question.split("|")], language)
