"""Which words bear a pitch accent: content words, as opposed to function words (A7); and which only hesitate (A32)."""

from __future__ import annotations

import re
import unicodedata

from scorebreath.script.lexicon import Lexicon, lexicon

_APOSTROPHES = str.maketrans("\u2019\u2018\u02bc`\u00b4", "'''''")
_AT_EDGES = re.compile(r"^[^\w']+|[^\w']+$")
_APART = re.compile(r"[\s/\u2010-\u2015-]+")
_AGAIN = re.compile(r"(.)\1+")


def is_content(spoken: str, language: str) -> bool:
    """Whether what is spoken as one word holds a content word: one that no table of function words knows.

    Numbers are content words. In a language without a table every word is one: then stress alone decides.

    Args:
        spoken: One word, a compound with hyphens, or several that a voice merges ("was the").
        language: BCP 47.

    >>> [is_content(word, "en") for word in ("The", "garden", "she's", "Alice's", "was the", "well-known", "7")]
    [False, True, False, True, False, True, True]
    """
    known = lexicon(language)
    return any(_content(piece, known) for piece in _APART.split(plain(spoken)) if piece.strip("'"))


def is_hesitation(word: str, language: str) -> bool:
    """Whether a word only fills a pause, with any number of repeated letters: `errr`, `uhm`, `ähm` (A32, Y2).

    >>> [is_hesitation(word, "de") for word in ("Errrr...", "er", "Ääähm")], is_hesitation("aehm", "en")
    ([True, False, True], True)
    """
    known = lexicon(language)
    bare = plain(word)
    return bare not in known.no_sounds and _AGAIN.sub(r"\1", bare) in known.sounds


def plain(word: str) -> str:
    """A word as a `Lexicon` has it: case folded, straight apostrophes, no punctuation around it."""
    return _AT_EDGES.sub("", unicodedata.normalize("NFC", word).casefold().translate(_APOSTROPHES))


def _content(word: str, known: Lexicon) -> bool:
    if word in known.function or word.strip("'") in known.function:
        return False
    if _AGAIN.sub(r"\1", word) in known.sounds and word not in known.no_sounds:
        return False
    stem, apostrophe, hanging = word.rpartition("'")
    if apostrophe and hanging in known.clitics:
        return bool(stem.strip("'")) and _content(stem, known)
    return True
