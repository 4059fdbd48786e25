"""Words of letters that are not said as they are written: abbreviations, units, capitals, Roman numerals."""

from __future__ import annotations

import re

from scorebreath.script.normalise.context import Context, Part, Said
from scorebreath.script.normalise.figures import has_figures, unit_of
from scorebreath.script.normalise.numbers import cardinal, is_number_word, ordinal
from scorebreath.spans import Span

_CAPITALS = re.compile(r"([A-Z]{2,5})('?s)?")
_JOINED = re.compile(r"([A-Z]{1,4})&([A-Z]{1,4})")
_DOTTED = re.compile(r"[A-Za-z](?:\.[A-Za-z])+")
_ROMAN = re.compile(r"M{0,3}(?:CM|CD|D?C{0,3})(?:XC|XL|L?X{0,3})(?:IX|IV|V?I{0,3})")
_ROMAN_DIGITS = {"I": 1, "V": 5, "X": 10, "L": 50, "C": 100, "D": 500, "M": 1000}
_LONGEST_PHRASE = 4
"""Words of the longest abbreviation written with spaces: i. d. R."""


def say_name(context: Context) -> Said | None:
    """How a word of letters is said if not as written, by the first of the rules that knows it."""
    for rule in (_unit, _numbered, _phrase, _month, _suffix, _title, _saint, _roman, _capitals, _joined, _dotted):
        if said := rule(context):
            return said
    return None


def _unit(context: Context) -> Said | None:
    """The km of "5 km"."""
    tables, index = context.tables, context.index
    unit = unit_of(context.word.text, tables)
    if unit is None and context.word.stopped:
        unit = tables.unit.get(f"{context.word.text}.")
    if unit is None:
        return None
    if not index or not context.words[index - 1].spaced:
        return None if context.word.text.isalpha() else context.one(unit[1])
    amount = context.words[index - 1].text
    counted = context.inner_stop and is_number_word(amount, tables.language)
    if not has_figures(amount[-1:], tables) and not counted:
        return None
    single = amount in ("1", "-1", "+1") or amount in tables.fraction or amount.lower() == cardinal(1, tables.language)
    return context.one(unit[0] if single else unit[1], stop=context.inner_stop)


def _phrase(context: Context) -> Said | None:
    """The longest abbreviation that starts here: "etc.", "e.g.", "z. B."; its full stop is needed, or one inside."""
    tables, word = context.tables, context.word
    if not word.stopped and "." not in word.text:
        return None
    for count in range(_LONGEST_PHRASE, 0, -1):
        last = context.follower(count - 1) if count > 1 else word
        if last is None:
            continue
        chosen = context.words[context.index : context.index + count]
        key = ".".join(one.text for one in chosen).lower()
        said = tables.abbreviation.get(key)
        if context.before == "1":
            said = tables.one.get(key, said)
        stopped = all(one.stopped for one in chosen)
        if said and (stopped or (count == 1 and "." in key)):
            return context.one(said, count=count, stop=last.stopped)
    return None


def _month(context: Context) -> Said | None:
    """The Mar of "3 Mar 2025", without its full stop."""
    key, following = context.word.text.lower(), context.follower()
    if key not in context.tables.lists["month_names"] or key not in context.tables.abbreviation:
        return None
    if context.before[-1:].isdecimal() or (following and following.text[0].isdecimal()):
        return context.one(context.tables.abbreviation[key])
    return None


def _suffix(context: Context) -> Said | None:
    """The Hauptstr. is the Hauptstraße."""
    word = context.word
    for short, said in context.tables.suffix.items():
        if word.stopped and word.text.endswith(short) and len(word.text) > len(short):
            start, end = word.core.start, word.core.end
            parts = ((word.text[: -len(short)], Span(start, end - len(short))), (said, Span(end - len(short), end + 1)))
            return Said(parts, 1, True)
    return None


def _title(context: Context) -> Said | None:
    """Dr. Smith, Dr Smith: a capital must follow."""
    said = context.tables.title.get(context.word.text.lower())
    if said is None or not context.word.text[0].isupper():
        return None
    following = context.follower()
    if following is None or not following.text[0].isupper():
        return None
    return context.one(said, stop=context.word.stopped)


def _numbered(context: Context) -> Said | None:
    """No. 5, p. 7."""
    said = context.tables.numbered.get(context.word.text.lower())
    following = context.follower()
    if said is None or following is None or not following.text[0].isdecimal():
        return None
    return context.one(said, stop=True) if context.word.stopped or context.word.text == "№" else None


def _saint(context: Context) -> Said | None:
    """St. Mary is a saint, Main St. a street."""
    tables, word = context.tables, context.word
    if word.text.lower() != tables.saint.get("key") or not word.stopped:
        return None
    following = context.follower()
    before = context.words[context.index - 1].text if context.index else ""
    street = before[:1].isupper() or (before[:1].isdecimal() and not before.isdecimal())
    named = following is not None and following.text[0].isupper() and (not street or context.index == 1)
    return context.one(tables.saint["before_name" if named else "otherwise"], stop=True)


def _roman(context: Context) -> Said | None:
    """Chapter IV, World War II, Louis XIV, Henry VIII's, Ludwig XIV., II. Weltkrieg."""
    whole, tables = context.word.text, context.tables
    text = whole.replace("’", "'").removesuffix("'s")
    ending = "'s" if text != whole else ""
    if not text.isupper() or len(text) > 9 or not _ROMAN.fullmatch(text):
        return None
    values = [_ROMAN_DIGITS[letter] for letter in text]
    number = sum(-one if one < after else one for one, after in zip(values, [*values[1:], 0], strict=True))
    language = tables.language
    if context.before in tables.counted:
        return context.one(cardinal(number, language) + ending)
    ruler = context.before in tables.rulers
    if ruler and (text != "I" or (language == "de" and context.inner_stop)):
        return context.one(f"{tables.article} {ordinal(number, language)}{ending}", stop=context.inner_stop)
    following = context.follower()
    if language == "de" and context.inner_stop and following and following.text.lower() in tables.counted:
        inflected = "n" if context.before in tables.lists["date_before"] else ""
        return context.one(ordinal(number, language) + inflected, stop=True)
    if len(text) >= 3 and set(text) <= set("IVX") and text != "XXX":
        return context.one(cardinal(number, language))
    return None


def _capitals(context: Context) -> Said | None:
    """FBI letter by letter, NASA as a word; nothing where somebody SHOUTS."""
    match, tables = _CAPITALS.fullmatch(context.word.text), context.tables
    if match is None:
        return None
    capitals = match[1]
    vowels = set(capitals) & set("AEIOUY")
    if capitals not in tables.spelled and (vowels or capitals in tables.read):
        return None
    if _shouted(context):
        return None
    return Said(_spelled(capitals, context.word.core.start, match[2] or ""))


def _joined(context: Context) -> Said | None:
    """AT&T, R&D."""
    match, start = _JOINED.fullmatch(context.word.text), context.word.core.start
    if match is None or "&" not in context.tables.symbol:
        return None
    place = Span(start + match.end(1), start + match.start(2))
    sign: list[Part] = [(" ", None), (context.tables.symbol["&"], place), (" ", None)]
    return Said([*_spelled(match[1], start, ""), *sign, *_spelled(match[2], place.end, "")])


def _shouted(context: Context) -> bool:
    """Whether most of the words around are written in capitals."""
    near = [word.text for word in context.words[max(0, context.index - 5) : context.index + 6] if len(word.text) > 1]
    return len(near) > 2 and sum(text.isupper() and text.isalpha() for text in near) * 4 > len(near) * 3


def _dotted(context: Context) -> Said | None:
    """U.S., J.R.R.: letters, without a full stop behind that a voice would pause at."""
    text = context.word.text
    if not _DOTTED.fullmatch(text):
        return None
    place = Span(context.word.core.start, context.word.core.end)
    return Said(((text.upper(), place),), 1, context.word.stopped)


def _spelled(capitals: str, start: int, ending: str) -> list[Part]:
    """Capitals with full stops between, which voices take for letters."""
    parts: list[Part] = []
    for place, letter in enumerate(capitals, start):
        parts += [(".", None)] if parts else []
        parts.append((letter, Span(place, place + 1)))
    end = start + len(capitals)
    if ending:
        parts.append(("'s", Span(end, end + len(ending))))
    return parts
