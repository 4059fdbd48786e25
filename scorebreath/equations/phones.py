r"""Phones by name: the letters of the IPA, their X-SAMPA names, and how they are made (A10).

The table stands in `phones.toml`. MARY's SAMPA is X-SAMPA with stress and syllables in it: `'` and `,` before a
syllable, `-` between two; some of its names mean something else in a language, see `MARY`.
"""

from __future__ import annotations

import tomllib
import unicodedata
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import NamedTuple

from scorebreath.errors import InputError

WRITTEN_OTHERWISE: Mapping[str, str] = MappingProxyType(
    {
        "g": "ɡ", "ε": "ɛ", "?": "ʔ", ":": "ː", "ʦ": "ts", "ʣ": "dz", "ʧ": "tʃ", "ʤ": "dʒ", "ʨ": "tɕ", "ʥ": "dʑ",
        "ı": "ɪ", "ɩ": "ɪ", "ɷ": "ʊ", "ǝ": "ə", "ᵊ": "ə",
    }
)  # fmt: skip
"""Letters that are not the alphabet's own."""
MARKS: Mapping[str, str] = MappingProxyType(
    {
        "ː": ":", "ˑ": ":\\", "ʰ": "_h", "ʲ": "_j", "ʷ": "_w", "ˠ": "_G", "ˤ": "_?\\", "\u0303": "~", "\u0329": "=",
        "\u030d": "=", "\u032f": "_^", "\u0325": "_0", "\u030a": "_0", "\u032a": "_d", "\u031e": "_o", "\u031d": "_r",
        "\u0308": '_"', "ˈ": '"', "ˌ": "%", ".": ".",
    }
)  # fmt: skip
"""Marks of the IPA and their X-SAMPA names; any other is left out in SAMPA."""
STRESS: Mapping[str, int] = MappingProxyType({"'": 1, '"': 1, "ˈ": 1, ",": 2, "%": 2, "ˌ": 2})
"""Marks of stress before a syllable; `'` as MARY has it, not X-SAMPA's palatalisation."""
JOINED: tuple[str, ...] = (
    "aI@", "aU@", "aI", "AI", "aU", "eI", "EI", "OI", "OY", "O6", "@U", "oU", "I@", "e@", "U@", "E@",
    "tS", "dZ", "ts", "dz", "pf", "ts\\", "dz\\",
)  # fmt: skip
"""Diphthongs and affricates: two letters, one phone."""
MARY: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {
        "de": {"{": "ɛ", "r": "ʁ", "OY": "ɔʏ", "AI": "aɪ"},
        "en": {"r": "ɹ", "r=": "ɝ", "AI": "aɪ", "EI": "eɪ", "@U": "əʊ", "rr": "ɹ"},
    }
)
"""What a name means in a language where that is not X-SAMPA's meaning; S3 Table 2 writes `'?{s` for "es"."""


class Sound(NamedTuple):
    """A phone of a word."""

    ipa: str
    """without stress"""
    stress: int
    """of its syllable: 0 none, 1 primary, 2 secondary"""
    syllable: int
    """from 0 in its word"""


@cache
def makings() -> Mapping[str, str]:
    """How each letter of the IPA is made: the names of the tables of `phones.toml`.

    >>> makings()["m"], makings()["ʊ"]
    ('bilabial', 'vowel')
    """
    return MappingProxyType({letter: making for making, row in _table().items() for letter in row})


def is_vowel(ipa: str) -> bool:
    """Whether a phone begins as a vowel.

    >>> is_vowel("aʊ"), is_vowel("tʃ"), is_vowel("")
    (True, False, False)
    """
    first = letters_of(ipa)[:1]
    return bool(first) and makings().get(first[0]) == "vowel"


SYLLABIC = frozenset("\u0329\u030d")
"""Marks of a consonant that is a nucleus."""


def is_nucleus(ipa: str) -> bool:
    """Whether a phone is the nucleus of a syllable: a vowel, or a consonant marked as syllabic.

    >>> [is_nucleus(ipa) for ipa in ("oʊ", "ɹ", "n̩", "")]
    [True, False, True, False]
    """
    return is_vowel(ipa) or not SYLLABIC.isdisjoint(ipa)


def letters_of(ipa: str) -> tuple[str, ...]:
    """The letters of a phone, one after the other, without marks of length, tone or manner; doubled ones once.

    >>> letters_of("aɪ"), letters_of("tʃʲ"), letters_of("ɐ̃ʊ̃"), letters_of("kː"), letters_of("")
    (('a', 'ɪ'), ('t', 'ʃ'), ('ɐ', 'ʊ'), ('k',), ())
    """
    written = "".join(WRITTEN_OTHERWISE.get(symbol, symbol) for symbol in ipa)
    written = unicodedata.normalize("NFD", written).replace("c\u0327", "ç")
    known, found = makings(), list[str]()
    for symbol in written:
        stands = symbol in known or (symbol.isalpha() and unicodedata.category(symbol) in ("Ll", "Lo"))
        if stands and (not found or found[-1] != symbol):
            found.append(symbol)
    return tuple(found)


def sampa_of(ipa: str) -> str:
    r"""X-SAMPA of a phone or a word.

    >>> sampa_of("ˈtsvaɪ"), sampa_of("ɡəˈsʊnt"), sampa_of("ʃɛʁ")
    ('"tsvaI', 'g@"sUnt', 'SER')
    """
    names = {letter: name for row in _table().values() for letter, name in row.items()}
    written = "".join(WRITTEN_OTHERWISE.get(symbol, symbol) for symbol in ipa)
    written = unicodedata.normalize("NFD", written).replace("c\u0327", "ç")
    return "".join(names.get(symbol) or MARKS.get(symbol, "") for symbol in written)


def sounds_of(sampa: str, language: str = "") -> tuple[Sound, ...]:
    """The phones of a word in MARY's SAMPA, one after the other; blanks between phones are allowed.

    Args:
        sampa: E.g. `pa-ra-'le:-l@n` (S3 Table 2).
        language: Tag such as `de` or `en-GB`; chooses among `MARY`.

    Raises:
        InputError: A name is no phone's.

    >>> [sound.ipa for sound in sounds_of("'gI-N@n", "de")]
    ['ɡ', 'ɪ', 'ŋ', 'ə', 'n']
    >>> [(sound.ipa, sound.stress, sound.syllable) for sound in sounds_of("' tsvAI", "de")]
    [('ts', 1, 0), ('v', 1, 0), ('aɪ', 1, 0)]
    """
    names = _names(language.partition("-")[0].lower())
    found: list[Sound] = []
    place = stress = syllable = 0
    bare = "".join(sampa.split())
    while place < len(bare):
        if bare[place] in STRESS or bare[place] in "-.":
            starts = bool(found) and found[-1].syllable == syllable
            syllable += 1 if starts else 0
            stress = STRESS.get(bare[place], 0)
            place += 1
            continue
        name = next((bare[place : place + size] for size in range(5, 0, -1) if bare[place : place + size] in names), "")
        if not name:
            raise InputError(f"sampa={sampa!r}: {bare[place:]!r} begins with no phone's name; expected SAMPA")
        ipa, place = names[name], place + len(name)
        if name in _marks() and found:
            found[-1] = found[-1]._replace(ipa=found[-1].ipa + ipa)
        elif name not in _marks():
            found.append(Sound(ipa, stress, syllable))
    return tuple(found)


def ipa_of(sampa: str, language: str = "") -> str:
    """IPA of a word in MARY's SAMPA, with stress, a point between syllables.

    Args:
        sampa: As for `sounds_of`.
        language: As for `sounds_of`.

    Raises:
        InputError: A name is no phone's.

    >>> ipa_of("'?{s", "de"), ipa_of("'gI-N@n", "de"), ipa_of("pa-ra-'le:-l@n", "de")
    ('ˈʔɛs', 'ˈɡɪ.ŋən', 'pa.ʁa.ˈleː.lən')
    """
    parts: list[str] = []
    before = -1
    for sound in sounds_of(sampa, language):
        if sound.syllable != before:
            parts.append(("." if parts else "") + ("", "ˈ", "ˌ")[sound.stress])
        parts.append(sound.ipa)
        before = sound.syllable
    return "".join(parts)


@cache
def _table() -> Mapping[str, Mapping[str, str]]:
    text = files("scorebreath.equations").joinpath("phones.toml").read_text(encoding="utf-8")
    return MappingProxyType(tomllib.loads(text))


@cache
def _marks() -> frozenset[str]:
    return frozenset(name for mark, name in MARKS.items() if mark not in STRESS and mark != ".")


@cache
def _names(language: str) -> Mapping[str, str]:
    """IPA by SAMPA name, of letters, of what is joined of them, and of marks."""
    names = {name: letter for row in _table().values() for letter, name in row.items()}
    names |= {name: mark for mark, name in reversed(tuple(MARKS.items())) if name in _marks()}
    for joined in JOINED:
        names[joined] = "".join(names[part] for part in _parts(joined))
    return MappingProxyType({**names, "v\\": "ʋ", "_n": "\u0329", **MARY.get(language, {})})


def _parts(joined: str) -> list[str]:
    parts: list[str] = []
    for symbol in joined:
        if symbol == "\\":
            parts[-1] += symbol
        else:
            parts.append(symbol)
    return parts
