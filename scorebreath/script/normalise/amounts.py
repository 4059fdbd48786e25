"""Words with figures in them: dates, times, money, measures, ranges, years, ordinals, or just numbers.

Rules are tried from the most special to the plainest; the last one reads anything.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable
from functools import lru_cache

from scorebreath.script.kinds import kinds
from scorebreath.script.normalise.context import Context, Said
from scorebreath.script.normalise.numbers import LARGEST, cardinal, digits, ordinal, whole, year
from scorebreath.script.normalise.tables import Tables
from scorebreath.script.normalise.tables import tables as tables_of

Rule = Callable[[re.Match[str], Context], Said | None]

_PLAIN = str.maketrans({"\u2212": "-", "\u2013": "-", "\u2010": "-", "\u2011": "-", "’": "'", "′": "'"})
_CLOCK = re.compile(r"(?P<suffix>a\.?m|p\.?m)?", re.IGNORECASE)
_TOKENS = re.compile(r"\d+|[^\W\d_]+|.", re.DOTALL)


def has_figures(text: str, tables: Tables) -> bool:
    """Whether a word is for this module."""
    return any(character.isdecimal() or character in tables.fraction for character in text)


def say_amount(context: Context) -> Said:
    """How a word with figures is said."""
    text = plain(context.word.text)
    for pattern, rule in _rules(context.tables.language):
        if (match := pattern.fullmatch(text)) and (said := rule(match, context)):
            return said
    return context.one(_mixture(text, context.tables))


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


@lru_cache(maxsize=8)
def _rules(language: str) -> tuple[tuple[re.Pattern[str], Rule], ...]:
    """Patterns of a language, and what reads them."""
    tables = tables_of(language)
    decimal, thousands = re.escape(tables.settings["decimal"]), re.escape(tables.settings["thousands"])
    number = rf"(?:\d{{1,3}}(?:{thousands}\d{{3}})+(?!\d)|\d+)(?:{decimal}\d+)?"
    money = "[" + re.escape("".join(tables.currency)) + "]"
    fraction = "|".join(re.escape(key) for key in tables.fraction)
    return tuple(
        (re.compile(pattern), rule)
        for pattern, rule in (
            (r"(?P<year>\d{4})-(?P<month>\d\d)-(?P<day>\d\d)", _date),
            (r"(?P<day>\d{1,2})\.(?P<month>\d{1,2})(?:\.(?P<year>\d{4}|\d\d))?", _dotted_date),
            (r"(?P<hour>\d{1,2})[:.](?P<minute>\d\d)(?P<suffix>[ap]\.?m)?", _time),
            (r"(?P<hour>\d{1,2}):(?P<minute>\d\d):(?P<second>\d\d)", _stopwatch),
            (r"(?P<left>\d+):(?P<right>\d+)", _ratio),
            (rf"(?P<whole>\d*)(?P<fraction>{fraction})", _fraction),
            (rf"(?P<minus>-?)(?P<money>{money})(?P<number>{number})(?P<unit>\D*)", _money),
            (rf"(?P<number>{number})(?P<money>{money})", _money),
            (rf"(?P<number>{number})", _money_behind),
            (r"#(?P<number>\d+)", _numbered),
            (r"(?P<number>\d{1,3}(?:,\d{3})*)(?:st|nd|rd|th)", _ordinal),
            (r"'?(?P<number>\d{2}|\d{4})'?(?:s|er)", _decade),
            (rf"(?P<left>{number})(?P<sign>\D?)-(?P<right>\S+)", _range),
            (rf"(?P<sign>[+§±≈≤≥√@=-]+)(?P<rest>\d\S*)", _signed),
            (r"(?P<number>\d{1,3})", _spaced_thousands),
            (r"(?P<number>\d+)", _in_context),
            (rf"(?P<number>{number})", _number),
            (rf"(?P<number>{number})(?P<unit>\D\S*)", _measure),
            (r"(?P<left>\d+)[x×](?P<right>\d+)", _product),
        )
    )


def _amount(figures: str, tables: Tables) -> str:
    """A number with thousands and decimals, as the language writes them."""
    settings, language = tables.settings, tables.language
    before, _, after = figures.replace(settings["thousands"], "").partition(settings["decimal"])
    said = whole(before, language)
    return f"{said} {settings['point']} {digits(after, language)}" if after else said


def _counting(figures: str, noun: str, tables: Tables) -> str:
    """A number in front of a noun: German says "ein Euro", "eine Million"."""
    if figures == "1" and tables.language == "de":
        return "eine" if noun.lower() in tables.lists["feminine"] else "ein"
    return _amount(figures, tables)


def _day(number: int, context: Context) -> str:
    """A day of the month, after "am" with German's ending."""
    said = ordinal(number, context.tables.language)
    return said + "n" if context.before in context.tables.lists["date_before"] else said


def _date(match: re.Match[str], context: Context) -> Said | None:
    """2024-05-17, and what `_dotted_date` passes on."""
    day, month, stated = int(match["day"]), int(match["month"]), match["year"]
    tables = context.tables
    if not (1 <= month <= 12 and 1 <= day <= 31):
        return None
    name = tables.lists["months"][month - 1]
    said = f"{name} {_day(day, context)}" if tables.language == "en" else f"{_day(day, context)} {name}"
    if stated:
        said += " " + (year(int(stated), tables.language) if len(stated) == 4 else whole(stated, tables.language))
    return context.one(said, stop=context.inner_stop and not stated)


def _dotted_date(match: re.Match[str], context: Context) -> Said | None:
    """17.5.2024 and 17.5., as German writes dates."""
    if context.tables.language != "de" or not (match["year"] or context.inner_stop):
        return None
    return _date(match, context)


def _time(match: re.Match[str], context: Context) -> Said | None:
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


def _stopwatch(match: re.Match[str], context: Context) -> Said | None:
    """7:30:15."""
    language = context.tables.language
    return context.one(" ".join(cardinal(int(part), language) for part in match.groups()))


def _ratio(match: re.Match[str], context: Context) -> Said | None:
    """3:1."""
    language = context.tables.language
    left, right = whole(match["left"], language), whole(match["right"], language)
    return context.one(f"{left} {context.tables.settings['ratio']} {right}")


def _fraction(match: re.Match[str], context: Context) -> Said | None:
    """½, 2½, 3/4."""
    tables = context.tables
    alone, behind = tables.fraction[match["fraction"]]
    if not match["whole"]:
        return context.one(alone)
    if "/" in match["fraction"]:
        return None
    before = whole(match["whole"], tables.language)
    if tables.language == "de":
        return context.one(before + behind if behind == "einhalb" else f"{before} {behind}")
    return context.one(f"{before} and {behind}")


def _money(match: re.Match[str], context: Context) -> Said | None:
    """$5, $5.50, $5 million, €5bn, 5€."""
    tables = context.tables
    one, many, *_ = tables.currency[match["money"]]
    parts = match.groupdict()
    sign = f"{tables.settings['minus']} " if parts.get("minus") else ""
    figures, unit = match["number"], parts.get("unit") or ""
    scale = tables.unit[unit][1] if unit in tables.unit else ""
    if unit and not scale:
        return None
    following = context.follower()
    if not scale and following and following.text.lower() in tables.lists["scales"]:
        scale = following.text
        return context.one(f"{sign}{_counting(figures, scale, tables)} {scale} {many}", count=2)
    if scale:
        return context.one(f"{sign}{_amount(figures, tables)} {scale} {many}")
    if (small := _small_money(figures, match["money"], tables)) is not None:
        return context.one(sign + small)
    noun = one if figures == "1" else many
    return context.one(f"{sign}{_counting(figures, noun, tables)} {noun}")


def _money_behind(match: re.Match[str], context: Context) -> Said | None:
    """5,50 € with a space."""
    following = context.follower()
    if following is None or following.text not in context.tables.currency:
        return None
    small = _small_money(match["number"], following.text, context.tables)
    return None if small is None else context.one(small, count=2)


def _small_money(figures: str, symbol: str, tables: Tables) -> str | None:
    """An amount with two decimals, as money: five dollars and fifty cents, fünf Euro fünfzig."""
    one, many, small_one, small_many, joiner = tables.currency[symbol]
    before, _, after = figures.replace(tables.settings["thousands"], "").partition(tables.settings["decimal"])
    if len(after) != 2:
        return None
    noun = one if before == "1" else many
    said = f"{_counting(before, noun, tables)} {noun}"
    if after == "00":
        return said
    cents = cardinal(int(after), tables.language)
    return " ".join(filter(None, (said, joiner, cents, small_one if after == "01" else small_many)))


def _numbered(match: re.Match[str], context: Context) -> Said | None:
    """#1."""
    settings = context.tables.settings
    return context.one(f"{settings['number']} {whole(match['number'], context.tables.language)}")


def _ordinal(match: re.Match[str], context: Context) -> Said | None:
    """3rd."""
    if context.tables.language != "en":
        return None
    figures = match["number"].replace(",", "")
    return context.one(ordinal(int(figures), "en")) if len(figures) <= LARGEST else None


def _decade(match: re.Match[str], context: Context) -> Said | None:
    """1990s, 90s, '90s, 90er."""
    number, language = int(match["number"]), context.tables.language
    german = match[0].endswith("er")
    if german != (language == "de") or (number % 10 and not german) or (len(match["number"]) == 4 and number < 1100):
        return None
    said = year(number, language) if number >= 100 else cardinal(number, language)
    return context.one(said + "er" if german else said[:-1] + "ies" if said.endswith("y") else said + "s")


def _range(match: re.Match[str], context: Context) -> Said | None:
    """10-15, 1914-18, 3-0, 50%-80%, 10-15km; not 555-1234 nor 0800-123."""
    tables = context.tables
    left, right, sign = match["left"], match["right"], match["sign"]
    figures = re.match(r"\d+", right)
    if figures is None or "-" in right or (left[0] == "0" < left[1:]) or (right[0] == "0" and len(figures[0]) > 1):
        return None
    if len(left) == 3 and figures[0] == right and len(right) == 4 and not right.endswith("0"):
        return None
    start = _bare(left + sign, context)
    return context.one(f"{start} {tables.settings['range']} {_bare(right, context)}")


def _bare(text: str, context: Context) -> str:
    """A part of a word, read without its neighbours."""
    tables = context.tables
    if re.fullmatch(r"1[1-9]\d\d|20\d\d", text):
        return year(int(text), tables.language)
    alone = Context((context.word,), 0, tables)
    for pattern, rule in _rules(tables.language):
        if rule in (_measure, _number, _fraction, _time) and (match := pattern.fullmatch(text)):
            said = rule(match, alone)
            if said is not None:
                return said.parts[0][0]
    return _mixture(text, tables)


def _signed(match: re.Match[str], context: Context) -> Said | None:
    """-5, +5, §5, ±0.1."""
    tables = context.tables
    signs = [tables.settings["minus"] if sign == "-" else tables.symbol.get(sign, "") for sign in match["sign"]]
    return context.one(" ".join((*filter(None, signs), _bare(match["rest"], context))))


def _spaced_thousands(match: re.Match[str], context: Context) -> Said | None:
    """10 000, as German writes it."""
    if context.tables.language != "de" or match["number"][0] == "0":
        return None
    figures, count = match["number"], 1
    while (more := context.follower(count)) and re.fullmatch(r"\d{3}", more.text) and count < 5:
        figures += more.text
        count += 1
    return context.one(whole(figures, "de"), count=count) if count > 1 else None


def _in_context(match: re.Match[str], context: Context) -> Said | None:
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
    if len(figures) == 4 and 1100 <= number <= 2099:
        dated = context.before in lists["year_before"] or context.before in lists["month_names"]
        counted = after[:1].isupper() if language == "de" else after[:1].islower() and after.endswith("s")
        if dated or (number >= 1500 and not counted and after not in tables.unit):
            return context.one(year(number, language))
    if after and after[0].isalpha() and after not in tables.unit:
        return context.one(_counting(figures, after, tables))
    return None


def _number(match: re.Match[str], context: Context) -> Said | None:
    """5, 1,000,000, 3.14, and "ein" before a unit."""
    following = context.follower()
    noun = context.tables.unit.get(following.text, ("",))[0] if following else ""
    return context.one(_counting(match["number"], noun, context.tables) if noun else _amount(match[0], context.tables))


def _measure(match: re.Match[str], context: Context) -> Said | None:
    """5km, 15°C, 80km/h, 20m2."""
    tables, figures = context.tables, match["number"]
    unit = unit_of(match["unit"], tables)
    if unit is None:
        return None
    noun = unit[0] if figures == "1" else unit[1]
    return context.one(f"{_counting(figures, noun, tables)} {noun}")


def unit_of(text: str, tables: Tables) -> tuple[str, ...] | None:
    """One and many of a unit as written, `m2` for `m²` too."""
    squared = text[:-1] + {"2": "²", "3": "³"}.get(text[-1:], text[-1:])
    return tables.unit.get(text) or tables.unit.get(squared)


def _product(match: re.Match[str], context: Context) -> Said | None:
    """1920x1080."""
    language = context.tables.language
    left, right = whole(match["left"], language), whole(match["right"], language)
    return context.one(f"{left} {'by' if language == 'en' else 'mal'} {right}")


def _mixture(text: str, tables: Tables) -> str:
    """Anything with figures: B52, 1.2.3, 0800-123-456, 192.168.0.1."""
    settings = tables.settings
    named = {".": settings["point"], ",": settings["comma"], "/": settings["slash"], "+": settings["plus"]}
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
