"""Which word an event means: from positions in the spoken text to words with their places.

eSpeak NG's word events are not the text's words. It merges function words ("was the" is one event, and the gap belongs
to it), gives a number several events that overlap, and an apostrophe or a hyphen may or may not start a new one. So the
text is cut into words here, each event is given to the word it points into, and words without an event join the one
before.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

from scorebreath.speech.espeak.library import Event

_TOKEN = re.compile(r"[^\s–—―…/]+|[–—―…/]+")
"""What may be one word: anything between spaces, dashes, ellipses and slashes; and those, should they be spoken."""
_UNSPACED = re.compile("[\u0e00-\u0eff\u1000-\u109f\u1780-\u17ff\u3040-\u30ff\u3400-\u4dbf\u4e00-\u9fff\uf900-\ufaff]")
"""Thai, Lao, Burmese, Khmer, Japanese, Chinese: written without spaces, so every event there starts a word."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Spoken:
    """A word of the spoken text and the events that belong to it."""

    start: int
    end: int
    events: tuple[int, ...]
    """numbers of its word events, at least one"""
    merged: bool
    """holds more than one written word"""


def words(text: str, events: Sequence[Event]) -> tuple[Spoken, ...]:
    """Words of a text in the order they are spoken.

    Args:
        text: As given to the library.
        events: Its word events, in order.

    Returns:
        Words; together they hold every event once, and they do not overlap.
    """
    tokens = _tokens(text, events)
    if not tokens or not events:
        return ()
    starts = [start for start, _ in tokens]
    owners: list[int] = []
    for event in events:
        found = max(0, bisect_right(starts, event.position - 1) - 1)
        owners.append(max(found, owners[-1] if owners else 0))
    spoken: list[Spoken] = []
    for number, owner in enumerate(owners):
        if number and owner == owners[number - 1]:
            last = spoken.pop()
            spoken.append(Spoken(start=last.start, end=last.end, events=(*last.events, number), merged=last.merged))
            continue
        first = owner if spoken else 0  # what comes before the first event was said with it, or not at all
        following = next((other for other in owners[number + 1 :] if other > owner), len(tokens))
        start, end = tokens[first][0], tokens[following - 1][1]
        spoken.append(Spoken(start=start, end=end, events=(number,), merged=following - first > 1))
    return tuple(spoken)


def _tokens(text: str, events: Sequence[Event]) -> list[tuple[int, int]]:
    """Ranges of what is written as words; cut at each event where the writing has no spaces."""
    places = sorted({event.position - 1 for event in events})
    tokens: list[tuple[int, int]] = []
    for match in _TOKEN.finditer(text):
        if not any(character.isalnum() for character in match.group()) and not _points(places, match.span()):
            continue
        start, end = match.span()
        for place in places[bisect_right(places, start) : bisect_right(places, end - 1)]:
            if _UNSPACED.match(text, place) or _UNSPACED.match(text, place - 1):
                tokens.append((start, place))
                start = place
        tokens.append((start, end))
    return tokens


def _points(places: Sequence[int], span: tuple[int, int]) -> bool:
    index = bisect_right(places, span[0] - 1)
    return index < len(places) and places[index] < span[1]
