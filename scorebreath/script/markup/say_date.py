"""Dates in the order that a document tells: `say-as interpret-as="date" format="dmy"`."""

from __future__ import annotations

import re

from scorebreath.script.normalise.numbers import ordinal, whole, year
from scorebreath.script.normalise.tables import Tables

DATE_FORMATS = "mdy, dmy, ymd, ydm, md, dm, my, ym, y, m, d, yyyymmdd"
"""Orders of year, month, day; the last one is `ymd` without marks between."""

_FIELD = re.compile(r"[0-9]+|[^\W\d_]+\.?")
_WIDTHS = {"y": 4, "m": 2, "d": 2}


def say_date(text: str, form: str, table: Tables) -> str | None:
    """A date in words, or None where it is none.

    >>> from scorebreath.script.normalise.tables import tables
    >>> say_date("24.12.1999", "dmy", tables("en")), say_date("12/24/1999", "mdy", tables("de"))
    ('the twenty-fourth of December nineteen ninety-nine', 'vierundzwanzigste Dezember neunzehnhundertneunundneunzig')
    """
    if not form or not table.known:
        return text
    order = "ymd" if form == "yyyymmdd" else form
    fields = _FIELD.findall(text)
    if len(fields) == 1 and len(order) > 1:
        fields = _unmarked(fields[0], order)
    if len(fields) != len(order):
        return None
    given = dict(zip(order, fields, strict=True))
    month = _month(given["m"], table) if "m" in given else 0
    day = int(given.get("d", "1")) if given.get("d", "1").isdecimal() else 0
    stated = given.get("y", "")
    if month is None or not 1 <= day <= 31 or (stated and not (stated.isdecimal() and 1 <= len(stated) <= 4)):
        return None
    name = table.lists["months"][month - 1] if month else ""
    said_day = ordinal(day, table.language) if "d" in given else ""
    said_year = ""
    if stated:
        said_year = year(int(stated), table.language) if len(stated) > 2 else whole(stated, table.language)
    if table.language == "en" and said_day and order.startswith(("d", "yd")) and name:
        return " ".join(filter(None, ("the", said_day, "of", name, said_year)))
    first, second = (said_day, name) if table.language == "de" else (name, said_day)
    return " ".join(filter(None, (first, second, said_year)))


def _unmarked(figures: str, order: str) -> list[str]:
    """The fields of 19991224."""
    if len(figures) != sum(_WIDTHS[field] for field in order):
        return []
    fields, at = [], 0
    for field in order:
        fields.append(figures[at : at + _WIDTHS[field]])
        at += _WIDTHS[field]
    return fields


def _month(field: str, table: Tables) -> int | None:
    """A month's number, from figures or a name."""
    if field.isdecimal():
        return int(field) if len(field) <= 2 and 1 <= int(field) <= 12 else None
    beginnings = [name.lower() for name in table.lists["months"]]
    found = [n for n, name in enumerate(beginnings, 1) if name.startswith(field.rstrip(".").lower())]
    return found[0] if len(found) == 1 and len(field.rstrip(".")) >= 3 else None
