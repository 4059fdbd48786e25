"""Breath groups of a recording: cut where it is silent, and nowhere else.

A breath that is heard ends a group, and so does a long silence. Among the shorter ones those are chosen that make the
best groups: about as long as a speaker's (physiology 1.1), in silences with room for a breath. The choice is the
cheapest of all, found by dynamic programming over the silences.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from scorebreath.planning.chunker import Chunker, Cut, cut_at
from scorebreath.planning.markers import LONGEST_WORD
from scorebreath.planning.model import SyllableCounter
from scorebreath.planning.units import Unit

NAME = "heard"
LEAST = 0.16
"""s; in a shorter silence nobody breathes: the shortest catch breath, and 20 ms on both sides"""
CERTAIN = 0.9
"""s; a longer silence ends a group in any case"""
ROOMY = 0.5
"""s of silence that make room for an ordinary breath (physiology 1.3, 1.4)"""
TIGHT = 1.0
"""Cost of a silence without any room; one of `ROOMY` or more costs nothing"""
LONG, SHORT = 2.0, 0.7
"""Costs of a group twice as long as preferred, and of one of no syllables: (n / preferred - 1)^2 times as much"""
REACH = 60
"""silences that one group may go over at most"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Silence:
    """A silence between two words of a recording."""

    place: int
    """code points of the text: where the word before it begins"""
    duration: float
    """s"""
    syllables: float
    """said since the silence before"""
    breath: bool
    """whether a breath is heard in it"""


def choose(silences: Sequence[Silence], rest: float, preferred: float) -> dict[int, str]:
    """The silences that end a breath group.

    Args:
        silences: All of them, in order.
        rest: Syllables behind the last one.
        preferred: Syllables of a group.

    Returns:
        The reason by the place.

    >>> said = [Silence(place=9, duration=0.3, syllables=9, breath=False),
    ...         Silence(place=19, duration=0.5, syllables=9, breath=False)]
    >>> choose(said, 18, 18)
    {19: 'heard: 0.50 s of silence'}
    """
    best: list[tuple[float, int]] = [(0.0, -1)]
    counts = [0.0]
    for silence in silences:
        counts.append(counts[-1] + silence.syllables)
    counts.append(counts[-1] + rest)
    sure = [number for number, silence in enumerate(silences) if _certain(silence)]
    for end in range(len(silences) + 1):
        floor = max((number + 1 for number in sure if number < end), default=0)
        own = _tightness(silences[end]) if end < len(silences) else 0.0
        options = (
            (best[start][0] + own + _length_cost(counts[end + 1] - counts[start], preferred), start)
            for start in range(max(floor, end - REACH), end + 1)
        )
        best.append(min(options))
    chosen: dict[int, str] = {}
    at = len(silences) + 1
    while (at := best[at][1]) > 0:
        silence = silences[at - 1]
        chosen[silence.place] = f"{NAME}: {_why(silence)}"
    return dict(sorted(chosen.items()))


def _certain(silence: Silence) -> bool:
    return silence.breath or silence.duration >= CERTAIN


def _why(silence: Silence) -> str:
    return f"{'a breath in ' if silence.breath else ''}{silence.duration:.2f} s of silence"


def _tightness(silence: Silence) -> float:
    if _certain(silence):
        return 0.0
    return TIGHT * max(0.0, (ROOMY - silence.duration) / (ROOMY - LEAST))


def _length_cost(syllables: float, preferred: float) -> float:
    off = syllables / preferred - 1.0
    return (LONG if off > 0 else SHORT) * off * off


class Heard(Chunker):
    """Cuts a text where its recording is silent."""

    def __init__(self, places: Mapping[int, str], count: SyllableCounter, poem: bool = False) -> None:
        """Start with an empty text.

        Args:
            places: Where the last word of each group begins, code points of the text, with the reason.
            count: Counts syllables.
            poem: Whether lines are lines of verse.
        """
        super().__init__(count, LONGEST_WORD, poem)
        self._places = places

    def cut(self, text: Sequence[Unit], over: bool) -> Cut | None:
        """The next place."""
        for count, unit in enumerate(text, 1):
            rule = next((self._places[w.source.start] for w in unit.words if w.source.start in self._places), None)
            if rule is not None:
                return cut_at(text, [(count, 0.0)], rule)
        return cut_at(text, [(len(text), 0.0)], f"{NAME}: the end") if over else None
