"""The words a language has for what is written short: one TOML file a language."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Any

LANGUAGES = ("en", "de")
"""Languages with a table; in others words stay as they are written, and the voice reads them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tables:
    """One language's words. Empty for a language without a table."""

    language: str
    title: Mapping[str, str]
    """before a name, with or without full stop: `dr` is Doctor"""
    abbreviation: Mapping[str, str]
    """with its full stop: `e.g` is for example"""
    suffix: Mapping[str, str]
    """with its full stop, at the end of a word: `str` is straße"""
    numbered: Mapping[str, str]
    """before a number: `no` is number"""
    saint: Mapping[str, str]
    symbol: Mapping[str, str]
    one: Mapping[str, str]
    """symbols after 1"""
    currency: Mapping[str, tuple[str, ...]]
    """one, many, one and many of the small ones, what joins them"""
    unit: Mapping[str, tuple[str, ...]]
    """after a number: one, many"""
    measures: frozenset[str]
    """units of letters, in lower case and without a full stop; no times of day"""
    fraction: Mapping[str, tuple[str, ...]]
    """alone, after a whole number"""
    spelled: frozenset[str]
    read: frozenset[str]
    counted: frozenset[str]
    rulers: frozenset[str]
    article: str
    never_last: frozenset[str]
    """written with a full stop that does not end a sentence"""
    beginnings: frozenset[str]
    """abbreviations of several letters, and what they begin with: `i.d` and `i.d.r`"""
    special: frozenset[str]
    """letters and figures that are read as symbols"""
    suffixes: tuple[str, ...]
    """ends of words that are written short"""
    settings: Mapping[str, str]
    """single words and marks: `point`, `decimal`, ..."""
    lists: Mapping[str, tuple[str, ...]]
    """`months`, `scales`, ..."""

    @property
    def known(self) -> bool:
        """Whether there is a table at all."""
        return bool(self.settings)


@lru_cache(maxsize=32)
def tables(language: str) -> Tables:
    """The tables of a BCP 47 primary language."""
    read: dict[str, Any] = {}
    if language in LANGUAGES:
        read = tomllib.loads((files(__package__) / f"{language}.toml").read_text("utf-8"))
    settings = read.get("settings", {})
    title = read.get("title", {})
    abbreviation, suffix = read.get("abbreviation", {}), read.get("suffix", {})
    keys = [key.split(".") for key in abbreviation]
    letters, roman = read.get("letters", {}), read.get("roman", {})
    return Tables(
        language=language,
        title=title,
        abbreviation=abbreviation,
        suffix=suffix,
        numbered=read.get("numbered", {}),
        saint=read.get("saint", {}),
        symbol=read.get("symbol", {}),
        one=read.get("one", {}),
        currency={key: tuple(value) for key, value in read.get("currency", {}).items()},
        unit={key: tuple(value) for key, value in read.get("unit", {}).items()},
        measures=frozenset(key.rstrip(".").lower() for key in read.get("unit", {}) if key.rstrip(".").isalpha())
        - frozenset(settings.get("clock", ())),
        fraction={key: tuple(value) for key, value in read.get("fraction", {}).items()},
        spelled=frozenset(letters.get("spelled", ())),
        read=frozenset(letters.get("read", ())),
        counted=frozenset(roman.get("counted", ())),
        rulers=frozenset(roman.get("rulers", ())),
        article=roman.get("article", ""),
        never_last=frozenset((*settings.get("never_last", ()), *title)),
        beginnings=frozenset(".".join(key[:length]) for key in keys for length in range(2, len(key) + 1)),
        special=frozenset((*read.get("fraction", {}), *read.get("symbol", {}))),
        suffixes=tuple(suffix),
        settings={key: value for key, value in settings.items() if isinstance(value, str)},
        lists={key: tuple(value) for key, value in settings.items() if isinstance(value, list)},
    )
