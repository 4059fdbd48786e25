"""What all rules about figures share: amounts, units, and anything at all, read piece by piece."""

from __future__ import annotations

import re
import unicodedata

from scorebreath.script.kinds import kinds
from scorebreath.script.normalise.numbers import digits, whole
from scorebreath.script.normalise.tables import Tables

_PLAIN = str.maketrans({"\u2212": "-", "\u2013": "-", "\u2010": "-", "\u2011": "-", "’": "'", "′": "'"})
_TOKENS = re.compile(r"\d+|[^\W\d_]+|.", re.DOTALL)


def has_figures(text: str, tables: Tables) -> bool:
    """Whether a word is for this module."""
    return any(character.isdecimal() or character in tables.fraction for character in text)


def plain(text: str) -> str:
    """A word with ASCII figures and hyphens, without joiners and marks.

    >>> plain("１２–١٣")
    '12-13'
    """
    if text.isascii():
        return text
    shown = (character for character, kind in zip(text, kinds(text), strict=True) if kind != "m")
    figures = (str(unicodedata.decimal(one)) if one.isdecimal() else one for one in shown)
    return "".join(figures).translate(_PLAIN)


def amount(figures: str, tables: Tables) -> str:
    """A number with thousands and decimals, as the language writes them."""
    settings, language = tables.settings, tables.language
    before, _, after = figures.replace(settings["thousands"], "").partition(settings["decimal"])
    said = whole(before or "0", language)
    return f"{said} {settings['decimal_word']} {digits(after, language)}" if after else said


def counting(figures: str, noun: str, tables: Tables) -> str:
    """A number in front of a noun: German says "ein Euro", "eine Million"."""
    if figures == "1" and tables.language == "de":
        return "eine" if noun.lower() in tables.lists["feminine"] else "ein"
    return amount(figures, tables)


def unit_of(text: str, tables: Tables) -> tuple[str, ...] | None:
    """One and many of a unit as written, `m2` for `m²` too."""
    squared = text[:-1] + {"2": "²", "3": "³"}.get(text[-1:], text[-1:])
    return tables.unit.get(text) or tables.unit.get(squared)


def mixture(text: str, tables: Tables) -> str:
    """Anything with figures: B52, 1.2.3, 0800-123-456, 192.168.0.1."""
    settings = tables.settings
    slash = settings["slash"] if "." in text or "," in text else ""
    named = {"/": slash, ".": settings["point"], ",": settings["comma"], "+": settings["plus"]}
    singly = text.count("-") > 0 and re.fullmatch(r"[\d+/-]+", text) is not None
    said = []
    for token in _TOKENS.findall(text):
        if token.isdecimal():
            said.append(digits(token, tables.language) if singly or len(token) > 4 else whole(token, tables.language))
        elif token.isalnum():
            said.append(".".join(token) if token.isupper() and len(token) <= 3 else token)
        else:
            said.append(named.get(token) or tables.symbol.get(token, ""))
    return " ".join(filter(None, said))
