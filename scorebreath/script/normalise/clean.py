"""Words without figures and abbreviations, as a voice can read them: composed letters, no joiners, symbols as words."""

from __future__ import annotations

import re
import unicodedata

from scorebreath.script.kinds import kinds
from scorebreath.script.normalise.context import Part
from scorebreath.script.normalise.numbers import whole
from scorebreath.script.normalise.tables import Tables
from scorebreath.spans import Span

_MARKS = 4
"""Combining marks a letter may carry; more are ornament."""

_CLUSTER = re.compile(r"m*[^m]m*|m+")
_LINK = re.compile(r"https?://|www\.", re.IGNORECASE)
_MAIL = re.compile(r"[^@/]+@[^@/]+\.[^@/]+")
_LINK_TOKEN = re.compile(r"[^\W_]+|.", re.DOTALL)


def is_link(text: str) -> bool:
    """Whether a word is an address of the web or of mail."""
    return _LINK.match(text) is not None or ("@" in text and _MAIL.fullmatch(text) is not None)


def read_link(text: str, start: int, tables: Tables) -> list[Part]:
    """An address, mark by mark: "example dot com slash news"."""
    settings = tables.settings
    named = {
        ".": settings["dot"], "/": settings["slash"], "-": settings["dash"], "_": settings["underscore"],
        ":": settings["colon"], **tables.symbol, "@": settings["at"],
    }  # fmt: skip
    scheme = re.match(r"https?://", text, re.IGNORECASE)
    at = scheme.end() if scheme else 0
    parts: list[Part] = []
    for token in _LINK_TOKEN.finditer(text.rstrip("/"), at):
        said = named.get(token.group(), "")
        if token.group().isdecimal():
            said = whole(token.group(), tables.language)
        elif token.group().isalnum():
            said = "W.W.W" if token.group().lower() == "www" else token.group()
        if said:
            parts += [(" ", None)] if parts else []
            parts.append((said, Span(start + token.start(), start + token.end())))
    return parts


def clean(text: str, start: int, tables: Tables) -> list[Part]:
    """A word, letter by letter, each with its place.

    Letters are composed and made plain (NFKC); joiners, variation selectors and soft hyphens go; apostrophes become
    straight. Where the language has a table, symbols become words, and slashes and underscores spaces.
    """
    parts: list[Part] = []
    shown = kinds(text)
    for match in _CLUSTER.finditer(shown):
        place = Span(start + match.start(), start + match.end())
        said = _say(text[match.start() : match.end()], match.group(), tables)
        if said == "":
            continue
        if said == " " or said[0] == " ":
            if not parts or parts[-1][0][-1] == " ":
                said = said.lstrip(" ")
            if not said:
                continue
        parts.append((said, place))
    while parts and parts[-1][0].rstrip(" ") == "":
        parts.pop()
    if parts and parts[-1][0].endswith(" "):
        parts[-1] = (parts[-1][0].rstrip(" "), parts[-1][1])
    return _merged(parts)


def _say(cluster: str, kind: str, tables: Tables) -> str:
    """One letter with its marks, or one symbol."""
    base = kind.strip("m")
    symbol = next((tables.symbol[character] for character in cluster if character in tables.symbol), "")
    if symbol:
        return f" {symbol} "
    if base == "'":
        return "'"
    if base in ("-", "N"):
        return "-"
    if base in ("_", "(", ")", "n") or (base in ("/", "S") and tables.known):
        return " "
    if base in (".", ",", ":"):
        return base
    kept = [character for character in cluster if unicodedata.category(character) not in ("Cf", "Me")]
    kept = [character for character in kept if not 0xFE00 <= ord(character) <= 0xFE0F]
    return unicodedata.normalize("NFKC", "".join(kept[: _MARKS + 1]))


def _merged(parts: list[Part]) -> list[Part]:
    """Neighbours that correspond one to one, as one part."""
    merged: list[Part] = []
    for said, place in parts:
        if merged and place and len(said) == place.length:
            before, source = merged[-1]
            if source and len(before) == source.length and source.end == place.start:
                merged[-1] = (before + said, source.hull(place))
                continue
        merged.append((said, place))
    return merged
