"""Telephone numbers as they are written, in groups: found before brackets and hyphens are read as punctuation.

Of 8 to 15 figures: with a country's code, `+44 (0)20 7946 0958`; with an area code that begins with 0, `(030) 1234567`,
`030/123-4567`; ten figures in threes and a four, `(555) 123-4567`, `1-800-555-0199`. What else is in groups may be a
range, a date or a sum.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from scorebreath.spans import Span

FEWEST, MOST = 8, 15
"""Figures; 15 by ITU-T E.164."""

_GAP = r"[ \n\u00a0\u202f./\u2010\u2011\u2013-]"
_GROUPS = rf"(?:{_GAP}\d{{2,8}}){{0,5}}"
_PATTERN = re.compile(
    rf"""
    (?<![\w+#$€£.,:/-])
    (?: (?:\+?1{_GAP}?)? (?:\(\d{{3}}\){_GAP}?|\d{{3}}{_GAP}) \d{{3}}{_GAP}\d{{4}}
    | \+\d{{1,3}} (?:{_GAP}?\(\d{{1,5}}\){_GAP}?\d{{1,8}} | {_GAP}\d{{1,8}} ) {_GROUPS}
    | \(0\d{{1,5}}\){_GAP}?\d{{2,8}} {_GROUPS}
    | 0\d(?:\ \d{{2,8}}){{1,5}}
    | 0\d{{2,5}}{_GAP}\d{{2,8}} {_GROUPS}
    )
    (?! \w | [.,:/-]\d | \ ?[%‰°€$£] )
    """,
    re.VERBOSE,
)
_FIGURE = re.compile(r"\d")


def spans(text: str) -> Iterator[Span]:
    """Where telephone numbers stand.

    >>> text = "Ring (020) 7946 0958 or +1 555 123-4567, in (2019) 12 or 10-15."
    >>> [span.cut(text) for span in spans(text)]
    ['(020) 7946 0958', '+1 555 123-4567']
    """
    for match in _PATTERN.finditer(text):
        if FEWEST <= len(_FIGURE.findall(match.group())) <= MOST:
            yield Span(*match.span())


def is_number(text: str) -> bool:
    """Whether all of `text` is one."""
    return len(text) >= FEWEST and text[-1].isdecimal() and any(span.length == len(text) for span in spans(text))
