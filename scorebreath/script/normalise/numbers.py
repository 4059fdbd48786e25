"""Numbers in words: a thin layer over num2words that never gives it more than it can say."""

from __future__ import annotations

import unicodedata
from functools import lru_cache

LARGEST = 15
"""Digits of a number that is said as one; longer ones are said digit by digit."""


@lru_cache(maxsize=8192)
def cardinal(number: int, language: str) -> str:
    """A whole number in words, without commas.

    >>> cardinal(1234, "en")
    'one thousand two hundred and thirty-four'
    """
    return _say(number, language, "cardinal")


@lru_cache(maxsize=1024)
def ordinal(number: int, language: str) -> str:
    """The place in an order: `third`, `dritte`."""
    return _say(number, language, "ordinal")


@lru_cache(maxsize=1024)
def year(number: int, language: str) -> str:
    """A year as it is said: `nineteen eighty-four`, `neunzehnhundertvierundachtzig`."""
    return _say(number, language, "year")


def digits(figures: str, language: str) -> str:
    """Figures one by one.

    >>> digits("007", "en")
    'zero zero seven'
    """
    return " ".join(cardinal(unicodedata.digit(figure), language) for figure in figures)


def whole(figures: str, language: str) -> str:
    """Figures as a number, or one by one where they are too many or start with a zero."""
    if len(figures) > LARGEST or (len(figures) > 1 and figures[0] == "0"):
        return digits(figures, language)
    return cardinal(int(figures), language)


def is_number_word(word: str, language: str) -> bool:
    """Whether a word alone is a number up to a hundred, or ends one with a hyphen in it: `two`, `zwanzig`.

    >>> is_number_word("Forty", "en"), is_number_word("came", "en")
    (True, False)
    """
    return word.lower() in _number_words(language)


@lru_cache(maxsize=8)
def _number_words(language: str) -> frozenset[str]:
    """The last words of numbers up to a hundred, a thousand, and a million."""
    numbers = (*range(101), 1000, 1_000_000)
    return frozenset(cardinal(number, language).lower().replace("-", " ").split()[-1] for number in numbers)


def _say(number: int, language: str, kind: str) -> str:
    """What num2words says."""
    import num2words

    return str(num2words.num2words(number, lang=language, to=kind)).replace(",", "")
