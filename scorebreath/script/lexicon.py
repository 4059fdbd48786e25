"""What is known of a language's small words (`tables/LANGUAGE.toml`): which bear no accent, hesitate, ask.

The tables of `planning` say what a word does at a boundary, whatever its accent; these say what it is.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any

_NOTHING: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True, kw_only=True)
class Lexicon:
    """A language's small words, case folded ("ß" is "ss"), apostrophes straight; little where there is no table."""

    known: bool = False
    """whether there is a table"""
    function: frozenset[str] = _NOTHING
    """words without an accent of their own"""
    auxiliaries: frozenset[str] = _NOTHING
    """those of them that are auxiliary verbs"""
    clitics: frozenset[str] = _NOTHING
    """what hangs on a word behind an apostrophe and changes nothing about it"""
    sounds: frozenset[str] = _NOTHING
    """hesitations, each letter once; the same in all languages (`tables/hesitations.toml`)"""
    no_sounds: frozenset[str] = _NOTHING
    """words that look like hesitations"""
    questions: frozenset[str] = _NOTHING
    """words a question for a word begins with"""
    clauses: frozenset[str] = _NOTHING
    """those of them that also open a clause before the question"""
    leading: frozenset[str] = _NOTHING
    """what may stand before a question word"""
    subjects: frozenset[str] = _NOTHING
    """pronouns that a verb is about, where the verb of a question stands right behind its question word"""


@cache
def lexicon(language: str) -> Lexicon:
    """The table of a language.

    Args:
        language: BCP 47; its region is of no meaning.

    >>> "the" in lexicon("en-us").function, lexicon("xx").known
    (True, False)
    """
    name = language.split("-", maxsplit=1)[0].lower()
    fillers = _rows("hesitations")
    sounds = _words(fillers["sounds"])
    if not _table(name).is_file():
        return Lexicon(sounds=sounds, no_sounds=_words(fillers["words"]))
    rows = _rows(name)
    return Lexicon(
        known=True,
        function=frozenset().union(*(_words(lines) for lines in rows["function"].values())),
        auxiliaries=_words(rows["function"]["auxiliaries"]),
        clitics=_words(rows["clitics"]["behind"]),
        sounds=sounds,
        no_sounds=_words(rows["hesitations"]["words"]),
        questions=_words(rows["questions"]["words"]),
        clauses=_words(rows["questions"]["clauses"]),
        leading=_words(rows["questions"]["leading"]),
        subjects=_words(rows["questions"].get("subjects", [])),
    )


def _table(name: str) -> Traversable:
    return files("scorebreath.script").joinpath("tables", f"{name}.toml")


def _rows(name: str) -> dict[str, Any]:
    return tomllib.loads(_table(name).read_text(encoding="utf-8"))


def _words(lines: list[str]) -> frozenset[str]:
    return frozenset(" ".join(lines).casefold().split())
