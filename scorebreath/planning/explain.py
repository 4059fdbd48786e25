"""Why each group ends where it does, as rows for whoever prints them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal, Protocol

from scorebreath.planning import bernardet_2017, bernardet_2019
from scorebreath.score.document import CutReason, Site

Measure = Literal["characters", "cost"]


class Explained(Protocol):
    """What has a reason: a `BreathGroup`, or a Score's `Group`."""

    @property
    def source(self) -> tuple[int, int]:
        """Code points of the text."""

    @property
    def text(self) -> str:
        """As written."""

    @property
    def syllables(self) -> int:
        """Of all words."""

    @property
    def cut(self) -> CutReason:
        """Where it was cut, and why there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CandidateRow:
    """A place where the group might have ended."""

    chosen: bool
    site: Site
    position: int
    """code points of the text"""
    cost: float
    """a distance from the split point in characters (Bernardet), or a cost (natural); see `measure`"""
    ending: str
    """the last words before it, as written; empty if the text was not given"""


@dataclass(frozen=True, slots=True, kw_only=True)
class GroupRow:
    """One group and its reason."""

    index: int
    """from 0"""
    start: int
    end: int
    """code points of the text"""
    text: str
    syllables: int
    site: Site
    rule: str
    measure: Measure
    """what the candidates' costs are"""
    candidates: tuple[CandidateRow, ...]
    """best first"""


SHOWN = 24
"""Characters shown before a candidate, at most."""


def explain(groups: Iterable[Explained], text: str = "") -> Iterator[GroupRow]:
    """A row for each group, as they come.

    Args:
        groups: Of a planner, or of a Score.
        text: The whole text, to show the words at each candidate.
    """
    for index, group in enumerate(groups):
        start, end = group.source
        papers = group.cut.rule.startswith((bernardet_2017.NAME, bernardet_2019.NAME))
        yield GroupRow(
            index=index,
            start=start,
            end=end,
            text=group.text,
            syllables=group.syllables,
            site=group.cut.site,
            rule=group.cut.rule,
            measure="characters" if papers else "cost",
            candidates=tuple(
                CandidateRow(
                    chosen=other.position == end,
                    site=other.site,
                    position=other.position,
                    cost=other.cost,
                    ending=_ending(text, other.position),
                )
                for other in group.cut.candidates
            ),
        )


def _ending(text: str, position: int) -> str:
    """The last whole words before a place.

    >>> _ending("It was a bright cold day in April, and the clocks", 34)
    'cold day in April,'
    """
    shown = " ".join(text[max(0, position - SHOWN) : position].split())
    return shown if position <= SHOWN or " " not in shown else shown.split(" ", 1)[1]
