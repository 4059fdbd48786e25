"""How tokens become text again: which stand beside each other without a space."""

from __future__ import annotations

import re
from typing import Literal

Side = Literal["before", "behind", "both"]
"""Where a token has a space: before it, behind it, on both sides."""

_ENCLITIC = re.compile(r"(?:['’](?:s|m|re|ve|ll|d|t)|n['’]t)", re.IGNORECASE)
_CLOSING = re.compile(r"[.,;:!?…‥)\]}”’。，、！？；]+[\"'»”’)]*")
_OPENING = frozenset("([{‚„‘¿¡")
_QUOTES = frozenset("\"'“«»‹›")
_OPENED = re.compile(r"(?:\A|\s)[(\[{‚„‘“«»\"'¿¡]+\Z")
PART = re.compile(r"[^\W_]+")
"""What of a token may become a word of its own: a compound is cut behind its hyphen."""


def is_word(token: str) -> bool:
    """Whether a token holds a letter or a figure.

    >>> is_word("Welt"), is_word("?!")
    (True, False)
    """
    return any(letter.isalnum() for letter in token)


def spaces(token: str, quoted: bool) -> tuple[Side, bool]:
    """Where a token has spaces, and whether a quotation is open behind it.

    >>> spaces("Hi", False), spaces(",", False), spaces("(", False), spaces("'s", False)
    (('both', False), ('behind', False), ('before', False), ('behind', False))
    >>> spaces('"', False), spaces('"', True), spaces("-", False)
    (('before', True), ('behind', False), ('both', False))
    """
    if _ENCLITIC.fullmatch(token) or _CLOSING.fullmatch(token):
        return "behind", quoted
    if token in _OPENING:
        return "before", quoted or token in "„‚"
    if token in _QUOTES:
        return ("behind", False) if quoted else ("before", True)
    return "both", quoted


def opens(text: str) -> bool:
    """Whether text between tokens ends with what opens something, so that the next token stands close to it.

    >>> opens('he said "'), opens("he said "), opens('said"')
    (True, False, False)
    """
    return _OPENED.search(text) is not None
