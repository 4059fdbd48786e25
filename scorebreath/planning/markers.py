"""The pause markers of Bernardet et al., as characters of the text as written, and how far away they are.

What the papers leave open, and what is done here:

- X4, X5: distances are characters, from the split point: the end of the last letter of the word in which the syllables
  were complete. Its own full stop is 0 characters ahead.
- X10: the marker stays in the chunk. A break falls after the whole word a marker stands in or hangs on (a full stop
  inside "3.14" breaks after "3.14"), or before the word it stands in front of.
- `_` is a marker outside words, not in "snake_case". With `period_marker` "bare", "." is every full stop of the text,
  in "Dr." and "3.14" too; with "sentence" it is the end of a sentence, whatever its mark.
- The end of a line of verse counts as "_", whatever its punctuation. A paragraph's end, a stanza's, and the end of the
  text count as ".", with or without a full stop: the papers have no paragraphs, and no place is better to breathe.
- An emoticon is no marker, nor is a full stop behind it that ends nothing; their characters do not count (A11).
- Of two markers in the same place, which only line ends and paragraphs can make, "." comes first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from scorebreath.planning.units import Unit

Kind = Literal[".", "_"]
PeriodMarker = Literal["bare", "sentence"]
LONGEST_WORD = 60
"""Syllables: joined words beyond this (12 s) are divided; the papers have no words that long."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Marker:
    """A pause marker, seen from the split point."""

    kind: Kind
    distance: int
    """characters from the split point; 0 for the one that hangs on the split word, negative behind it"""
    count: int
    """units the chunk would have"""

    def __str__(self) -> str:
        """E.g. `'.' 12 characters ahead`."""
        return f"{self.kind!r} {abs(self.distance)} characters {'behind' if self.distance < 0 else 'ahead'}"


def ahead(text: Sequence[Unit], split: int, period: PeriodMarker, reach: float) -> Iterator[Marker]:
    """Markers from the split point on, the nearest first, up to `reach` characters away, as far as the text is known.

    Args:
        text: Units that are left.
        split: How many of them lie before the split point, at least 1.
        period: What counts as ".".
        reach: Characters.
    """
    point = _point(text, split)
    for index in range(split - 1, len(text)):
        if text[index].heard(text[index].start) - point > reach:
            return
        for kind, place, count in _of(text, index, period):
            if point <= place <= point + reach:
                yield Marker(kind=kind, distance=place - point, count=count)


def behind(text: Sequence[Unit], split: int, period: PeriodMarker, reach: float) -> Iterator[Marker]:
    """Markers before the split point, the nearest first, up to `reach` characters away.

    One at the very start is no marker: its chunk would be empty.
    """
    point = _point(text, split)
    for index in range(split - 1, -1, -1):
        for kind, place, count in reversed(_of(text, index, period)):
            if count and point - reach <= place < point:
                yield Marker(kind=kind, distance=place - point, count=count)
        if point - text[index].heard(text[index].start) > reach:
            return


def known(text: Sequence[Unit], split: int) -> int:
    """Characters from the split point that are known: a marker nearer than that has been seen."""
    return text[-1].heard(text[-1].frontier) - _point(text, split)


def _point(text: Sequence[Unit], split: int) -> int:
    """The split point."""
    return text[split - 1].heard(text[split - 1].letters.end)


def _of(text: Sequence[Unit], index: int, period: PeriodMarker) -> list[tuple[Kind, int, int]]:
    """Markers of one unit, in order: kind, place in the text without emoticons, units up to the break."""
    unit = text[index]
    first, last = unit.letters
    bare = period == "bare"
    found: list[tuple[Kind, int, int]] = []
    if unit.edge == "paragraph" or (not bare and unit.edge == "sentence"):
        found.append((".", last, index + 1))
    if unit.ends_line:
        found.append(("_", last, index + 1))
    if "." in unit.written or "_" in unit.written:
        for place, character in enumerate(unit.shown, unit.start):
            count = index if place < first else index + 1
            if character == "." and bare:
                found.append((".", place, count))
            elif character == "_" and not first <= place < last:
                found.append(("_", place, count))
    heard = ((kind, unit.heard(place), count) for kind, place, count in found)
    return sorted(heard, key=lambda marker: (marker[1], marker[0]))
