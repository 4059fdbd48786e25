"""The papers' parsers know no markup: what it asks for goes before what they say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from scorebreath.planning.chunker import Cut, cut_at
from scorebreath.planning.markers import LONGEST_WORD
from scorebreath.planning.units import Unit, dividing, forbids
from scorebreath.script.marks import NoBreath


def obey(text: Sequence[Unit], cut: Cut | None, over: bool, name: str) -> Cut | None:
    """The parser's cut, or the nearer one that a tag asks for, or a later one where a tag forbids it.

    A forbidden cut moves to the next word boundary, as far as a breath may reach; beyond that it stays.

    Args:
        text: Units that are left.
        cut: What the parser says; None where it waits for more text.
        over: Whether that is all the text there will be.
        name: The parser's.

    Returns:
        The cut, or None where more text is needed.
    """
    if cut is None:
        return None
    for count, unit in enumerate(text[: cut.count], 1):
        if mark := dividing(unit.after):
            return _asked(text, count, f"{name}: {mark.written} asks for it")
    moved = cut.count
    syllables = sum(unit.syllables for unit in text[:moved])
    while forbids(text[moved - 1]):
        if moved == len(text):
            if not over:
                return None
            break
        syllables += text[moved].syllables
        if syllables > LONGEST_WORD:
            return cut
        moved += 1
        if mark := dividing(text[moved - 1].after):
            return _asked(text, moved, f"{name}: {mark.written} asks for it")
    if moved == cut.count:
        return cut
    places = [(moved, 0.0), (cut.count, 0.0)]
    return cut_at(text, places, f"{cut.reason.rule}; {_written(text[cut.count - 1])} moves it to the next word")


def _asked(text: Sequence[Unit], count: int, rule: str) -> Cut:
    cut = cut_at(text, [(count, 0.0)], rule)
    if cut.reason.site == "paragraph":
        return cut
    candidates = tuple(replace(one, site="tag") for one in cut.reason.candidates)
    return replace(cut, reason=replace(cut.reason, site="tag", candidates=candidates))


def _written(unit: Unit) -> str:
    return next(mark.written for mark in unit.after if isinstance(mark, NoBreath))
