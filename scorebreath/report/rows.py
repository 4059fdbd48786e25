"""Where things go in the timeline: rows of time, and words that do not overprint each other."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from scorebreath.curves.performed import performed
from scorebreath.score.document import Group, Score
from scorebreath.score.spoken import spoken_groups
from scorebreath.units import snap


class Row(NamedTuple):
    """A stretch of time drawn in one line."""

    start: float
    """s"""
    end: float
    """s"""


def wrap(duration: float, limits: Sequence[float], longest: float, most: int) -> tuple[Row, ...]:
    """Rows like lines of text: broken before a breath where one begins in a row's second half.

    Args:
        duration: Of the Score, s.
        limits: Where breath groups begin, ascending, s.
        longest: Of a row, s.
        most: Rows at most; the rest of the time is left out.

    >>> wrap(25.0, [0.1, 4.0, 8.0, 13.0], 10.0, 9)
    (Row(start=0.0, end=8.0), Row(start=8.0, end=18.0), Row(start=18.0, end=25.0))
    """
    rows: list[Row] = []
    start = 0.0
    while len(rows) < most and (start < duration or not rows):
        end = min(start + longest, duration)
        if end < duration:
            before = bisect_right(limits, end)
            if before and limits[before - 1] > start + longest / 2:
                end = limits[before - 1]
        rows.append(Row(start, end))
        start = end
    return tuple(rows)


@dataclass(frozen=True, slots=True, kw_only=True)
class Breath:
    """A breath group as the timeline shows it."""

    onset: float
    """s; of its inspiration, or of its speech where it has none"""
    end: float
    """s; of the last phone (B52)"""
    inspired: float
    """s; end of the inspiration, or `onset`"""
    group: Group


def breaths(score: Score, body: str) -> tuple[Breath, ...]:
    """The breath groups of one body that have a time, in order of time."""
    spoken = spoken_groups(performed(score))
    found: list[Breath] = []
    for group in score.groups:
        own = spoken[group.id]
        if group.body != body or own.onset is None:
            continue
        inspired = own.onset if own.inspiration is None else snap(own.inspiration.end)
        end = inspired if own.end is None else snap(own.end)
        found.append(Breath(onset=own.onset, end=end, inspired=inspired, group=group))
    return tuple(sorted(found, key=lambda each: each.onset))


class Label(NamedTuple):
    """A word in its place."""

    text: str
    x: float
    line: int


def place(words: Sequence[tuple[str, float]], em: float, lines: int) -> list[Label]:
    """Put each word at its onset, in the first of some lines where there is room, else in the emptiest.

    Args:
        words: Text and x of each, ascending x.
        em: Width of the letter m, in the unit of x.
        lines: How many lines there are.

    >>> [label.line for label in place([("one", 0.0), ("and", 10.0), ("two", 60.0)], 20.0, 2)]
    [0, 1, 0]
    """
    free = [float("-inf")] * lines
    labels: list[Label] = []
    for text, x in words:
        roomy = [line for line in range(lines) if free[line] <= x]
        line = roomy[0] if roomy else free.index(min(free))
        free[line] = x + (width(text) + 0.35) * em
        labels.append(Label(text, x, line))
    return labels


_WIDTHS = {0.34: "iljtfrI.,;:!'|()[]-\" ", 0.9: "mwMWQO@%&—…"}
_WIDTH = {letter: width for width, letters in _WIDTHS.items() for letter in letters}


def width(text: str) -> float:
    """About how wide a text is in a sans serif, in em; letters of full-width scripts count whole.

    >>> round(width("mill"), 2), width("世界")
    (1.92, 2.0)
    """
    return sum(
        _WIDTH.get(letter, 1.0 if ord(letter) >= 0x2E80 else 0.72 if letter.isupper() else 0.6) for letter in text
    )


def clock(seconds: float) -> str:
    """Minutes and seconds.

    >>> clock(65.2)
    '1:05'
    """
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}:{rest:02d}"


def groups_counted(count: int) -> str:
    """So many breath groups, in words.

    >>> groups_counted(1), groups_counted(0)
    ('1 breath group', '0 breath groups')
    """
    return f"{count} breath group{'' if count == 1 else 's'}"
