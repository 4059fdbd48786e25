"""Money: the symbol before or behind, the amount in words, the small coins after it."""

from __future__ import annotations

import re

from scorebreath.script.normalise.context import Context, Said
from scorebreath.script.normalise.figures import amount, counting, unit_of
from scorebreath.script.normalise.numbers import cardinal
from scorebreath.script.normalise.tables import Tables


def money(match: re.Match[str], context: Context) -> Said | None:
    """$5, $5.50, $5 million, €5bn, 5€."""
    tables = context.tables
    many = tables.currency[match["money"]][1]
    parts = match.groupdict()
    sign = f"{tables.settings['minus']} " if parts.get("minus") else ""
    figures, unit = match["number"], parts.get("unit") or ""
    if unit.startswith("/") and (share := unit_of(unit[1:], tables)):
        return context.one(f"{sign}{spoken_money(figures, match['money'], tables)} {tables.settings['per']} {share[0]}")
    scale = tables.settings.get(f"money_{unit.lower()}", "")
    if unit and not scale:
        return None
    following = context.follower()
    if not scale and following and following.text.lower() in tables.lists["scales"]:
        scale = following.text
        return context.one(f"{sign}{counting(figures, scale, tables)} {scale} {many}", count=2)
    if scale:
        return context.one(f"{sign}{amount(figures, tables)} {scale} {many}")
    return context.one(sign + spoken_money(figures, match["money"], tables))


def foreign_money(match: re.Match[str], context: Context) -> Said | None:
    """US$30, A$5."""
    many = context.tables.currency[match["money"]][1]
    return context.one(f"{amount(match['number'], context.tables)} {'.'.join(match['land'])} {many}")


def spoken_money(figures: str, symbol: str, tables: Tables) -> str:
    """An amount of money, with its small coins where two decimals say so."""
    one, many, *_ = tables.currency[symbol]
    noun = one if figures == "1" else many
    return _small_money(figures, symbol, tables) or f"{counting(figures, noun, tables)} {noun}"


def money_behind(match: re.Match[str], context: Context) -> Said | None:
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
    said = f"{counting(before, noun, tables)} {noun}"
    if after == "00":
        return said
    cents = cardinal(int(after), tables.language)
    return " ".join(filter(None, (said, joiner, cents, small_one if after == "01" else small_many)))
