"""Syllables by spelling: hyphenation (the papers' way, in the Bernardet models), or groups of vowels."""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from functools import cache

from scorebreath.errors import InputError
from scorebreath.planning.model import SyllableCounter

VOWELS = frozenset("aeiouyæœøıαεηιουωаеиоуыэюяєіїў")
"""Letters that make a syllable, after accents are taken off: Latin, Greek, Cyrillic."""
SYLLABARIES = ("CJK ", "HIRAGANA ", "KATAKANA ", "HANGUL SYLLABLE")
"""Scripts with a syllable to a character, by how their Unicode names begin."""
LONGEST = 100
"""Characters of a word that are hyphenated at a time: the patterns look no farther, and the time stays linear."""


def pyphen_counter(language: str) -> SyllableCounter:
    """A counter of the places where a word may be hyphenated, plus one (B16; speech, Syllables).

    It undercounts short edges ("open", "idea" give 1), as the papers' models do. A language without patterns gets
    `vowel_counter`.

    Args:
        language: BCP 47, e.g. `en`, `de-AT`.

    Raises:
        InputError: `language` is no language tag.

    >>> pyphen_counter("en")(["breathing", "understand", "1.5", "--"])
    [2, 3, 1, 0]
    """
    tag = language.replace("-", "_")
    if not tag.isascii() or not tag.replace("_", "").isalnum():
        raise InputError(f"language={language!r} must be a language tag such as 'en' or 'de'")
    import pyphen

    known = pyphen.language_fallback(tag)
    if known is None:
        return vowel_counter
    hyphenator = pyphen.Pyphen(lang=known)

    @cache
    def syllables(word: str) -> int:
        pieces = (word[start : start + LONGEST] for start in range(0, len(word), LONGEST))
        return sum(len(hyphenator.positions(piece)) + 1 for piece in pieces)

    def count(words: Sequence[str]) -> list[int]:
        return [syllables(word) if any(map(str.isalnum, word)) else 0 for word in words]

    return count


def vowel_counter(words: Sequence[str]) -> list[int]:
    """Groups of vowels in each word, at least 1 where there is a letter or a digit; a syllable to a Chinese character.

    >>> vowel_counter(["idea", "été", "strč", "привет", "日本", "..."])
    [2, 2, 1, 2, 2, 0]
    """
    return [_groups(word) for word in words]


def _groups(word: str) -> int:
    groups, inside = 0, False
    for character in unicodedata.normalize("NFC", word).lower():
        if unicodedata.name(character, "").startswith(SYLLABARIES):
            groups, inside = groups + 1, False
            continue
        vowel = unicodedata.normalize("NFD", character)[0] in VOWELS
        groups += vowel and not inside
        inside = vowel
    return max(groups, int(any(map(str.isalnum, word))))
