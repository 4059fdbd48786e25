"""Languages by their BCP 47 tags."""

from __future__ import annotations

import re

from scorebreath.errors import ScriptError


def primary(language: str) -> str:
    """The primary language of a BCP 47 tag, in lower case.

    >>> primary("en-US"), primary("de")
    ('en', 'de')

    Raises:
        ScriptError: It is no such tag.
    """
    first = re.split("[-_]", language)[0].lower()
    if not re.fullmatch("[a-z]{2,8}", first):
        raise ScriptError(f"language {language!r}", expected="a BCP 47 tag such as en, de or pt-BR")
    return first
