"""What each code point is to a reader: one letter for each, so that patterns run on plain ASCII of the same length.

| kind | what |
|---|---|
| `a` `d` `k` | letter, decimal digit, ideograph or kana (a word by itself) |
| `m` | combining mark, joiner, variation selector, soft hyphen: part of the letter before it |
| ` ` `n` `f` | space (control characters too), newline, form feed or paragraph separator |
| `.` `!` `?` `e` `F` | full stop, exclamation mark, question mark, ellipsis, full stops that need no space after |
| `,` `;` `:` | comma, semicolon, colon |
| `-` `N` `M` | hyphen, en dash or minus, em dash |
| `(` `)` `"` `'` | brackets, quotation marks, apostrophe or single quotation mark |
| `_` `/` | pause marker, slash |
| `S` | symbols that are read: & @ % # + = § ° and currencies |
| `c` `p` | symbols that are read in a few places only: < and > between spaces, ~ and ^ before a digit |
| `x` | everything else, emoji too: kept as written, not spoken |

`a`, `d` and `k` together are exactly the code points with `str.isalnum()`.
"""

from __future__ import annotations

import unicodedata

ALNUM = "adk"
"""Kinds of letters and digits."""

_CHARACTERS = {
    "n": "\n\x0b\x85\u2028",
    "f": "\f\u2029",
    " ": "\u200b",
    ".": ".",
    "!": "!‼",
    "?": "?؟⁇⁈⁉‽՞፧",
    "F": "。．｡！？।॥።።။։།",
    "e": "…‥⋯",
    ",": ",،、，﹐､",
    ";": ";；؛\u0387",
    ":": ":：",
    "-": "-\u2010\u2011\ufe63\uff0d",
    "N": "\u2012\u2013\u2212",
    "M": "\u2014\u2015\u2e3a\u2e3b",
    '"': '"“”„‟«»‹›‚「」『』《》',
    "'": "'’‘‛`´",
    "_": "_",
    "/": "/",
    "S": "&@%‰#+=§°±×÷≈≤≥≠√∞′″",
    "c": "<>",
    "p": "~^",
    "m": "\u00b7\u05f3\u05f4",
}
_FIXED = {ord(character): kind for kind, characters in _CHARACTERS.items() for character in characters}
_IDEOGRAPHS = ((0x3040, 0x30FF), (0x3400, 0x4DBF), (0x4E00, 0x9FFF), (0xF900, 0xFAFF), (0x20000, 0x3FFFF))
_CATEGORIES = {"Ps": "(", "Pe": ")", "Pi": '"', "Pf": '"', "Sc": "S", "Cc": " "}
_GROUPS = {"M": "m", "Z": " "}


def _kind(code: int) -> str:
    """The kind of one code point."""
    character = chr(code)
    if character.isalnum():
        if any(first <= code <= last for first, last in _IDEOGRAPHS):
            return "k"
        return "d" if character.isdecimal() else "a"
    category = unicodedata.category(character)
    if category == "Cf":
        return "m"
    return _CATEGORIES.get(category) or _GROUPS.get(category[0], "x")


class _Kinds(dict[int, str]):
    """Kinds by code point, found when first met."""

    def __missing__(self, code: int) -> str:
        """Find, keep."""
        kind = self[code] = _FIXED.get(code) or _kind(code)
        return kind


_KINDS = _Kinds()


def kinds(text: str) -> str:
    """The kind of every code point of `text`, as a string of the same length.

    >>> kinds("Hi, Dr. 9–5 (ok)!")
    'aa, aa. dNd (aa)!'
    """
    return text.translate(_KINDS)
