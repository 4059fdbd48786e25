"""Words with figures in them: dates, times, money, measures, ranges, years, ordinals, or just numbers.

Rules are tried from the most special to the plainest; the last one reads anything.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import lru_cache

from scorebreath.script import telephone
from scorebreath.script.normalise.context import Context, Part, Said
from scorebreath.script.normalise.dates import (
    date,
    decade,
    dotted_date,
    in_context,
    slashed_date,
    stopwatch,
    suffixed,
    time_of_day,
)
from scorebreath.script.normalise.figures import amount, counting, mixture, plain, unit_of
from scorebreath.script.normalise.money import foreign_money, money, money_behind
from scorebreath.script.normalise.numbers import cardinal, digits, ordinal, whole, year
from scorebreath.script.normalise.tables import tables as tables_of
from scorebreath.spans import Span

_DENOMINATORS = (3, 4, 5, 6, 7, 8, 9, 10, 12, 16, 100, 1000)

Rule = Callable[[re.Match[str], Context], Said | None]


def say_amount(context: Context) -> Said:
    """How a word with figures is said."""
    if telephone.is_number(context.word.text):
        return _telephone(context)
    text = plain(context.word.text)
    for pattern, rule in _rules(context.tables.language):
        if (match := pattern.fullmatch(text)) and (said := rule(match, context)):
            return said
    return context.one(mixture(text, context.tables))


@lru_cache(maxsize=8)
def _rules(language: str) -> tuple[tuple[re.Pattern[str], Rule], ...]:
    """Patterns of a language, and what reads them."""
    tables = tables_of(language)
    decimal, thousands = re.escape(tables.settings["decimal"]), re.escape(tables.settings["thousands"])
    number = rf"(?:\d{{1,3}}(?:{thousands}\d{{3}})+(?!\d)|\d+)(?:{decimal}\d+)?|{decimal}\d+"
    number = f"(?:{number})"
    symbols = "[" + re.escape("".join(tables.currency)) + "]"
    fraction = "|".join(re.escape(key) for key in tables.fraction)
    return tuple(
        (re.compile(pattern), rule)
        for pattern, rule in (
            (r"(?P<year>\d{4})-(?P<month>\d\d)-(?P<day>\d\d)", date),
            (r"(?P<left>\d{1,2})/(?P<right>\d{1,2})/(?P<year>\d{4})", slashed_date),
            (r"(?P<day>\d{1,2})\.(?P<month>\d{1,2})(?:\.(?P<year>\d{4}|\d\d))?", dotted_date),
            (r"(?P<hour>\d{1,2})[:.](?P<minute>\d\d)(?P<suffix>[ap]\.?m)?", time_of_day),
            (r"(?P<hour>\d{1,2}):(?P<minute>\d\d):(?P<second>\d\d)", stopwatch),
            (r"(?P<left>\d+):(?P<right>\d+)", _ratio),
            (rf"(?P<whole>\d*)(?P<fraction>{fraction})", _fraction),
            (rf"(?P<minus>-?)(?P<money>{symbols})(?P<number>{number})(?P<unit>\D*)", money),
            (rf"(?P<number>{number})(?P<money>{symbols})", money),
            (rf"(?P<land>[A-Z]{{1,3}})(?P<money>\$)(?P<number>{number})", foreign_money),
            (rf"(?P<number>{number})", money_behind),
            (r"#(?P<number>\d+)", _numbered),
            (r"(?P<number>\d{1,3}(?:,\d{3})*)(?:st|nd|rd|th)", suffixed),
            (r"'?(?P<number>\d{2}|\d{4})'?(?P<ending>s|ern?)", decade),
            (rf"(?P<number>{number})[eE](?P<sign>[+-])(?P<power>\d{{1,3}})", _power),
            (rf"(?P<left>{number})(?P<sign>\D?)-(?P<right>\S+)", _range),
            (r"(?P<sign>[+§±≈≤≥√@=~-]+)(?P<rest>\.?\d\S*)", _signed),
            (r"(?P<number>\d{1,3})", _spaced_thousands),
            (r"(?P<number>\d+)", in_context),
            (rf"(?P<number>{number})", _number),
            (rf"(?P<number>{number})(?P<unit>\D\S*)", _measure),
            (r"(?P<left>\d+)[x×](?P<right>\d+)", _product),
            (r"(?P<left>\d{1,2})/(?P<right>\d{1,4})", _broken),
        )
    )


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
        before = "ein" if before == "eins" else before
        return context.one(before + behind if behind == "einhalb" else f"{before} {behind}")
    return context.one(f"{before} and {behind}")


def _broken(match: re.Match[str], context: Context) -> Said | None:
    """5/8 is five eighths; 9/11 and 24/7 are two numbers."""
    left, right, language = int(match["left"]), int(match["right"]), context.tables.language
    if not (left < right and right in _DENOMINATORS):
        return None
    part = ordinal(right, language).removeprefix("one ")
    share = part.capitalize() + "l" if language == "de" else part if left == 1 else part + "s"
    return context.one(f"{_counting(left, language)} {share}")


def _counting(number: int, language: str) -> str:
    """A number of shares."""
    return "ein" if language == "de" and number == 1 else cardinal(number, language)


def _numbered(match: re.Match[str], context: Context) -> Said | None:
    """#1."""
    settings = context.tables.settings
    return context.one(f"{settings['number']} {whole(match['number'], context.tables.language)}")


def _power(match: re.Match[str], context: Context) -> Said | None:
    """1e-3."""
    tables = context.tables
    sign = f"{tables.settings['minus']} " if match["sign"] == "-" else ""
    power = f"{tables.symbol['×']} {cardinal(10, tables.language)} {tables.symbol['^']}"
    return context.one(f"{amount(match['number'], tables)} {power} {sign}{whole(match['power'], tables.language)}")


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
        if rule in (_measure, _number, _fraction, time_of_day) and (match := pattern.fullmatch(text)):
            said = rule(match, alone)
            if said is not None:
                return said.parts[0][0]
    return mixture(text, tables)


def _signed(match: re.Match[str], context: Context) -> Said | None:
    """-5, +5, §5, ±0.1."""
    tables = context.tables
    signs = [tables.settings["minus"] if sign == "-" else tables.symbol.get(sign, "") for sign in match["sign"]]
    return context.one(" ".join((*filter(None, signs), _bare(match["rest"], context))))


def _spaced_thousands(match: re.Match[str], context: Context) -> Said | None:
    """10 000, as German writes it, and English if the thousands are round."""
    language = context.tables.language
    if match["number"][0] == "0":
        return None
    figures, count = match["number"], 1
    while (more := context.follower(count)) and re.fullmatch(r"\d{3}", more.text) and count < 5:
        figures += more.text
        count += 1
    if count == 1 or (language == "en" and not figures.endswith("000")):
        return None
    return context.one(whole(figures, language), count=count)


def _telephone(context: Context) -> Said:
    """+49 30 1234567 and (020) 7946 0958, figure by figure, each group with its place."""
    tables, start, parts = context.tables, context.word.core.start, list[Part]()
    for group in re.finditer(r"\+|\d+", context.word.text):
        parts += [(" ", None)] if parts else []
        said = tables.settings["plus"] if group[0] == "+" else digits(plain(group[0]), tables.language)
        parts.append((said, Span(start + group.start(), start + group.end())))
    return Said(parts)


def _number(match: re.Match[str], context: Context) -> Said | None:
    """5, 1,000,000, 3.14, and "ein" before a unit."""
    following = context.follower()
    nouns = {**context.tables.unit, **context.tables.currency} if following else {}
    noun = nouns.get(following.text, ("",))[0] if following else ""
    return context.one(counting(match["number"], noun, context.tables) if noun else amount(match[0], context.tables))


def _measure(match: re.Match[str], context: Context) -> Said | None:
    """5km, 15°C, 80km/h, 20m2."""
    tables, figures = context.tables, match["number"]
    unit = unit_of(match["unit"], tables)
    if unit is None:
        return None
    noun = unit[0] if figures == "1" else unit[1]
    return context.one(f"{counting(figures, noun, tables)} {noun}")


def _product(match: re.Match[str], context: Context) -> Said | None:
    """1920x1080."""
    language = context.tables.language
    left, right = whole(match["left"], language), whole(match["right"], language)
    return context.one(f"{left} {'by' if language == 'en' else 'mal'} {right}")
