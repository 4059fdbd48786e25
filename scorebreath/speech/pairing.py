"""Whose phonemes are whose: what a phonemiser made of a whole text, against what it makes of each word alone.

A neural voice speaks phonemes, and its phonemiser joins words that are spoken as one ("of the" is `ʌvðə`), parts others
("23"), and changes them beside each other ("a" is `ɐ` or `eɪ`). So the symbols of the whole are aligned with those of
the words said alone, one after the other, at the least cost (Needleman & Wunsch 1970).
"""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence

from scorebreath.equations.phones import is_vowel

SPACE = " "
"""What parts two words; punctuation among the symbols stands for it as well."""
BORDER = "|"
"""Where one word ends and the next begins, in the words said alone."""
STRESS = frozenset("ˈˌ")
MOVED = 0.8
"""Cost of a symbol that has no partner: less than twice a wrong partner's, so that a changed vowel stays one."""
JOINED = 0.3
"""Cost of a border without a space: words are often spoken as one."""
PARTED = 0.6
"""Cost of a space without a border: seldom."""
SOUND, MANNER, KIND = 0.6, 0.9, 1.7
"""Cost of another vowel, of another consonant, and of a consonant for a vowel."""
MARK = 0.1
"""Cost of a mark (of length, say) without a partner, or for another one."""


def owners(spoken: Sequence[str], words: Sequence[Sequence[str]]) -> list[int | None]:
    """The word that each symbol of a text belongs to.

    Args:
        spoken: Symbols of the whole text: phonemes, marks, spaces, punctuation.
        words: Symbols of each of its words said alone.

    Returns:
        For each symbol the index of its word, ascending; None for spaces, punctuation, and where there are no words.
        A word may own nothing: it is silent, or said with its neighbour.

    >>> owners(list("ʌvðə ɹoʊd"), [list("ʌv"), list("ðə"), list("ɹoʊd")])
    [0, 0, 1, 1, None, 2, 2, 2, 2]
    """
    heard = [SPACE if _parts(symbol) else symbol for symbol in spoken]
    told: list[str] = []
    owner: list[int] = []
    for index, word in enumerate(words):
        if index:
            told.append(BORDER)
            owner.append(index)
        for symbol in word:
            if symbol in STRESS:
                continue
            told.append(SPACE if _parts(symbol) else symbol)
            owner.append(index)
    if not told:
        return [None] * len(heard)
    return _spread(heard, _partners(heard, told), owner)


def _parts(symbol: str) -> bool:
    """Whether a symbol stands between words: a space, or punctuation."""
    return not symbol.strip() or all(unicodedata.category(character)[0] in "PZ" for character in symbol)


def _is_mark(symbol: str) -> bool:
    return symbol in STRESS or all(unicodedata.category(character) in ("Lm", "Mn", "Sk") for character in symbol)


def _cost(heard: str, told: str) -> float:
    """Of one symbol for another."""
    if heard == told or (heard == SPACE and told == BORDER):
        return 0.0
    if SPACE in (heard, told) or told == BORDER:
        return 2 * KIND
    if _is_mark(heard) or _is_mark(told):
        return MARK if _is_mark(heard) and _is_mark(told) else 2 * KIND
    if is_vowel(heard) != is_vowel(told):
        return KIND
    return SOUND if is_vowel(heard) else MANNER


def _alone(symbol: str) -> float:
    """Of a symbol without a partner."""
    if symbol == BORDER:
        return JOINED
    if symbol == SPACE:
        return PARTED
    return MARK if _is_mark(symbol) else MOVED


def _partners(heard: Sequence[str], told: Sequence[str]) -> list[int | None]:
    """For each symbol heard its partner among those told, or None."""
    missing = [_alone(symbol) for symbol in told]
    costs: dict[tuple[str, str], float] = {}
    before = [0.0]
    for cost in missing:
        before.append(before[-1] + cost)
    steps: list[bytearray] = [bytearray([2] * len(before))]
    for symbol in heard:
        extra = _alone(symbol)
        row, step = [before[0] + extra], bytearray(len(before))
        step[0] = 1
        for place, other in enumerate(told):
            pair = symbol, other
            if pair not in costs:
                costs[pair] = _cost(symbol, other)
            best, way = before[place] + costs[pair], 0
            if before[place + 1] + extra < best:
                best, way = before[place + 1] + extra, 1
            if row[place] + missing[place] < best:
                best, way = row[place] + missing[place], 2
            row.append(best)
            step[place + 1] = way
        before = row
        steps.append(step)
    partners: list[int | None] = [None] * len(heard)
    at, place = len(heard), len(told)
    while at or place:
        way = steps[at][place]
        if way == 0:
            at, place = at - 1, place - 1
            partners[at] = place
        elif way == 1:
            at -= 1
        else:
            place -= 1
    return partners


def _spread(heard: Sequence[str], partners: Sequence[int | None], owner: Sequence[int]) -> list[int | None]:
    """Owners by partners; a symbol without one goes with its neighbour in the same stretch between spaces."""
    found: list[int | None] = [
        None if partner is None or symbol == SPACE else owner[partner]
        for symbol, partner in zip(heard, partners, strict=True)
    ]
    last: int | None = None
    for at, symbol in enumerate(heard):
        if symbol == SPACE:
            last = None
        elif found[at] is None:
            found[at] = last
        else:
            last = found[at]
    following: int | None = None
    for at in range(len(heard) - 1, -1, -1):
        if heard[at] == SPACE:
            following = None
        elif found[at] is None:
            found[at] = following
        else:
            following = found[at]
    for at, symbol in enumerate(heard):  # a stretch in which nothing has a partner goes with the word before it
        if symbol != SPACE and found[at] is None:
            found[at] = max((one for one in found[:at] if one is not None), default=owner[0])
    return found
