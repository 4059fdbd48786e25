"""`say-as` of SSML: what is written short, said in the way the document asks for.

What comes out is text that the reader then reads like any other: words, or a form that it reads in one way only.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from scorebreath.errors import shortened
from scorebreath.script.markup.say_date import DATE_FORMATS, say_date
from scorebreath.script.normalise.figures import amount, plain
from scorebreath.script.normalise.numbers import LARGEST, digits, ordinal
from scorebreath.script.normalise.tables import Tables, tables

Say = Callable[[str, str, Tables], str | None]
"""The text, the format, the language's tables; None where the text is no such thing."""

LONGEST = 1000
"""Code points that are said in a special way."""

_TOKEN = re.compile(r"[A-Za-z]+|[0-9]+|\s+|.", re.DOTALL)
_FIGURES = re.compile(r"[0-9][0-9 .,/-]*")
_NUMBER = re.compile(r"([+-]?)([0-9]*)([0-9.,' \u00a0\u202f]*)")
_ORDINAL = re.compile(rf"([0-9]{{1,{LARGEST}}})(?:st|nd|rd|th|\.)?", re.IGNORECASE)
_TIME = re.compile(r"([0-9]{1,2})(?:[:.]([0-9]{2}))?(?:[:.]([0-9]{2}))?\s*(?:([ap])\.?m\.?)?", re.IGNORECASE)
_TELEPHONE = re.compile(r"[+(]?[0-9][0-9 ()./\u2011\u2013-]*")
_NAMES: Mapping[str, Mapping[str, str]] = {
    "de": {
        "!": "Ausrufezeichen", "?": "Fragezeichen", ";": "Semikolon", '"': "Anführungszeichen", "'": "Apostroph",
        "(": "Klammer auf", ")": "Klammer zu", "*": "Stern", "\\": "Backslash", "|": "senkrechter Strich",
    }
}  # fmt: skip
"""Signs that are in no table of the reader's; English has Unicode's own names."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Interpretation:
    """One row of the table."""

    say: Say
    expected: str
    """what the element must hold"""
    formats: str = ""
    """values of `format`, separated by a comma and a space; empty: none"""
    any_figures: bool = False
    """whether `format` may be a number, as a telephone's country"""

    def takes(self, form: str) -> bool:
        """Whether `format` may have that value."""
        return form in self.formats.split(", ") or (self.any_figures and form.isdecimal())


def say_as(kind: Interpretation, text: str, form: str, language: str) -> str | tuple[str, str]:
    """How a text is to be written so that it is said as asked, or the problem and what was expected.

    Args:
        kind: A row of `INTERPRETATIONS`.
        text: With single spaces.
        form: The value of `format`.
        language: BCP 47.

    >>> say_as(INTERPRETATIONS["digits"], "007", "", "en"), say_as(INTERPRETATIONS["ordinal"], "3", "", "de")
    ('zero zero seven', 'dritte')
    """
    if not text:
        return ""
    said = None
    if len(text) <= LONGEST:
        try:
            said = kind.say(plain(text), form, tables(re.split("[-_]", language)[0].lower()))
        except RuntimeError:  # num2words does not know the language, or such numbers in it: the voice will
            said = text
    return (f"say-as of {shortened(text, 40)!r}", kind.expected) if said is None else said


def _characters(text: str, _: str, table: Tables) -> str:
    """HTML is H.T.M.L, B52 is B five two, a.b is A dot B."""
    said: list[str] = []
    for token in _TOKEN.findall(text):
        if token.isascii() and token.isalpha():
            said.append(".".join(token.upper()))
        elif token.isascii() and token.isdecimal():
            said.append(digits(token, table.language))
        elif token.isalnum():
            said.append(token.upper() if len(token.upper()) == 1 else token)
        elif not token.isspace():
            said.append(_sign(token, table))
    return " ".join(filter(None, said))


def _sign(sign: str, table: Tables) -> str:
    """A sign by its name."""
    settings = table.settings
    named = {
        ".": settings.get("dot", ""), "-": settings.get("dash", ""), "/": settings.get("slash", ""),
        "_": settings.get("underscore", ""), ":": settings.get("colon", ""), ",": settings.get("comma", ""),
        "@": settings.get("at", ""), **_NAMES.get(table.language, {}),
    }  # fmt: skip
    own = unicodedata.name(sign, "").lower() if table.language == "en" else ""
    return named.get(sign) or table.symbol.get(sign) or own


def _digits(text: str, _: str, table: Tables) -> str | None:
    """Figures one by one."""
    return digits(re.sub("[^0-9]", "", text), table.language) if _FIGURES.fullmatch(text) else None


def _cardinal(text: str, _: str, table: Tables) -> str | None:
    """How many."""
    decimal, thousands = table.settings.get("decimal", "."), table.settings.get("thousands", ",")
    match = _NUMBER.fullmatch(text)
    if match is None:
        return None
    figures = re.sub("['\\s]", "", match[2] + match[3]).replace(thousands, "")
    whole, mark, parts = figures.partition(decimal)
    if not (whole + parts).isdecimal() or (mark and not parts):
        return None
    if not table.known:
        return digits(whole, table.language) if whole.startswith("0") and len(whole) > 1 else _plainly(text, table)
    said = amount((whole.lstrip("0") or "0") + mark + parts, table)
    sign = {"-": table.settings["minus"], "+": table.settings["plus"]}.get(match[1], "")
    return f"{sign} {said}".strip()


def _plainly(text: str, table: Tables) -> str:
    """A whole number in a language that only num2words knows; others stay."""
    from scorebreath.script.normalise.numbers import cardinal

    return cardinal(int(text), table.language) if text.isdecimal() and len(text) <= LARGEST else text


def _ordinal(text: str, _: str, table: Tables) -> str | None:
    """Which in an order."""
    match = _ORDINAL.fullmatch(text)
    return ordinal(int(match[1]), table.language) if match else None


def _time(text: str, form: str, _: Tables) -> str | None:
    """A time of day, in the form that the reader reads as one."""
    match = _TIME.fullmatch(text)
    if match is None or (match[2] is None and not match[4] and not form):
        return None
    hour, minute, second = int(match[1]), match[2] or "00", match[3]
    most = 12 if match[4] or form == "hms12" else 24
    if hour > most or int(minute) > 59 or int(second or 0) > 59:
        return None
    suffix = f"{match[4].lower()}m" if match[4] else ""
    return f"{hour}:{minute}:{second} {suffix}".rstrip() if second else f"{hour}:{minute}{suffix}"


def _telephone(text: str, _: str, table: Tables) -> str | None:
    """Figure by figure."""
    if not _TELEPHONE.fullmatch(text):
        return None
    groups = re.findall(r"\+|[0-9]+", text)
    plus = table.settings.get("plus", "+")
    return " ".join(plus if group == "+" else digits(group, table.language) for group in groups)


def _number(text: str, form: str, table: Tables) -> str | None:
    """A number of a kind that `format` tells."""
    return _NUMBERS[form or "cardinal"](text, "", table)


def _as_written(text: str, _: str, __: Tables) -> str:
    """The reader knows how."""
    return text


_NUMBERS: Mapping[str, Say] = {
    "cardinal": _cardinal, "ordinal": _ordinal, "digits": _digits, "telephone": _telephone,
}  # fmt: skip
_CHARACTERS = Interpretation(say=_characters, expected=f"at most {LONGEST} characters", formats="characters, glyphs")
_WRITTEN = Interpretation(say=_as_written, expected=f"at most {LONGEST} characters")

INTERPRETATIONS: Mapping[str, Interpretation] = {
    "characters": _CHARACTERS,
    "spell-out": _CHARACTERS,
    "verbatim": _CHARACTERS,
    "digits": Interpretation(say=_digits, expected="figures, such as 007"),
    "cardinal": Interpretation(say=_cardinal, expected="a number, such as 1234 or 2.5"),
    "ordinal": Interpretation(say=_ordinal, expected=f"a number of at most {LARGEST} figures, such as 3 or 3rd"),
    "number": Interpretation(
        say=_number, expected="a number of the kind that format tells", formats=", ".join(_NUMBERS)
    ),
    "date": Interpretation(
        say=say_date, expected="a date in the order that format tells, such as 24.12.2024 for dmy", formats=DATE_FORMATS
    ),
    "time": Interpretation(say=_time, expected="a time of day, such as 7:30 or 7:30pm", formats="hms12, hms24"),
    "telephone": Interpretation(say=_telephone, expected="a telephone number, such as +1 555 0199", any_figures=True),
    "address": _WRITTEN,
    "currency": _WRITTEN,
    "fraction": _WRITTEN,
    "unit": _WRITTEN,
}
"""Values of `interpret-as`; the last four are read as they would be without it."""
