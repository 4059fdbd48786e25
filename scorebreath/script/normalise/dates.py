"""Dates, times of day, decades, years; and numbers that their neighbours make one of these, or an ordinal."""

from __future__ import annotations

import re

from scorebreath.script.normalise.context import Context, Said
from scorebreath.script.normalise.figures import counting
from scorebreath.script.normalise.numbers import LARGEST, cardinal, ordinal, whole, year


def _day(number: int, context: Context) -> str:
    """A day of the month, after "am" with German's ending."""
    said = ordinal(number, context.tables.language)
    lists = context.tables.lists
    dative = context.before == "der" and context.before_that in lists["dative"]
    return said + "n" if dative or context.before in lists["date_before"] else said


def date(match: re.Match[str], context: Context) -> Said | None:
    """2024-05-17, and what `dotted_date` passes on."""
    day, month, stated = int(match["day"]), int(match["month"]), match["year"]
    tables = context.tables
    if not (1 <= month <= 12 and 1 <= day <= 31):
        return None
    name = tables.lists["months"][month - 1]
    said = f"{name} {_day(day, context)}" if tables.language == "en" else f"{_day(day, context)} {name}"
    if stated:
        said += " " + (year(int(stated), tables.language) if len(stated) == 4 else whole(stated, tables.language))
    return context.one(said, stop=context.inner_stop and not stated)


def dotted_date(match: re.Match[str], context: Context) -> Said | None:
    """17.5.2024 and 17.5., as German writes dates."""
    if context.tables.language != "de" or not (match["year"] or context.inner_stop):
        return None
    return date(match, context)


def slashed_date(match: re.Match[str], context: Context) -> Said | None:
    """12/25/2024 and 25/12/2024; where day and month cannot be told apart, English says the two numbers."""
    tables = context.tables
    left, right, stated = int(match["left"]), int(match["right"]), year(int(match["year"]), tables.language)
    day, month = (left, right) if tables.language == "de" or left > 12 else (right, left)
    if not (1 <= day <= 31 and 1 <= month <= 12):
        return None
    if tables.language == "de":
        return context.one(f"{_day(day, context)} {tables.lists['months'][month - 1]} {stated}")
    if day <= 12 and day != month:
        return context.one(f"{cardinal(left, 'en')} {cardinal(right, 'en')} {stated}")
    return context.one(f"{tables.lists['months'][month - 1]} {ordinal(day, 'en')} {stated}")


def time_of_day(match: re.Match[str], context: Context) -> Said | None:
    """7:30, 7:30pm, 19.30 Uhr."""
    tables = context.tables
    hour, minute, suffix = int(match["hour"]), int(match["minute"]), match["suffix"]
    following = context.follower()
    named = following is not None and following.text.lower().rstrip(".") in tables.lists["clock"]
    if hour > 24 or minute > 59 or ("." in match[0][:3] and not named and not suffix):
        return None
    said = cardinal(hour, tables.language)
    if tables.language == "de":
        clock = f"{'ein' if hour == 1 else said} Uhr"
        return context.one(f"{clock} {cardinal(minute, 'de')}" if minute else clock, count=2 if named else 1)
    if minute:
        said += f" {tables.settings['oh']}" if minute < 10 else ""
        said += " " + cardinal(minute, tables.language)
    elif not suffix and not named:
        said += " o'clock" if 1 <= hour <= 12 else " hundred"
    return context.one(f"{said} {suffix[0].upper()}.M" if suffix else said)


def stopwatch(match: re.Match[str], context: Context) -> Said | None:
    """7:30:15."""
    language = context.tables.language
    return context.one(" ".join(cardinal(int(part), language) for part in match.groups()))


def suffixed(match: re.Match[str], context: Context) -> Said | None:
    """3rd."""
    if context.tables.language != "en":
        return None
    figures = match["number"].replace(",", "")
    return context.one(ordinal(int(figures), "en")) if len(figures) <= LARGEST else None


def decade(match: re.Match[str], context: Context) -> Said | None:
    """1990s, 90s, '90s, 90er, 1990ern."""
    number, language = int(match["number"]), context.tables.language
    ending = match["ending"]
    german = ending != "s"
    if german != (language == "de") or (number % 10 and not german) or (len(match["number"]) == 4 and number < 1100):
        return None
    said = year(number, language) if number >= 100 else cardinal(number, language)
    return context.one(said + ending if german else said[:-1] + "ies" if said.endswith("y") else said + "s")


def in_context(match: re.Match[str], context: Context) -> Said | None:
    """Whole numbers that their neighbours make an ordinal, a day, or a year."""
    tables, figures = context.tables, match["number"]
    lists, language, number = tables.lists, tables.language, int(figures[:LARGEST])
    following = context.follower()
    after = following.text if following else ""
    if language == "de" and context.inner_stop and len(figures) <= 3:
        return context.one(_day(number, context), stop=True)
    if language == "en" and 1 <= number <= 31 and len(figures) <= 2:
        if context.before in lists["month_names"]:
            return context.one(ordinal(number, "en"))
        if after.lower() in lists["month_names"] and after[0].isupper() and not context.inner_stop:
            return context.one(("" if context.before == "the" else "the ") + ordinal(number, "en") + " of")
    if len(figures) == 4 and 1001 <= number <= 2099:
        dated = context.before in lists["year_before"] or context.before in lists["month_names"]
        counted = after[:1].isupper() if language == "de" else _plural(after, lists["verbs"])
        if dated or (number >= 1500 and not counted and after not in tables.unit):
            return context.one(year(number, language))
    if after and after[0].isalpha() and after not in tables.unit:
        return context.one(counting(figures, after, tables))
    return None


def _plural(word: str, verbs: tuple[str, ...]) -> bool:
    """Whether an English word may be what is counted."""
    return word[:1].islower() and word.endswith("s") and word not in verbs
