"""What all planners share: text comes in by the sentence, groups go out as soon as they are certain."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from scorebreath.planning.assemble import SITES, Assembler
from scorebreath.planning.model import BreathGroup, SyllableCounter
from scorebreath.planning.units import Unit, UnitReader
from scorebreath.score.document import Candidate, CutReason, Site
from scorebreath.script.marks import Mark
from scorebreath.script.model import Sentence
from scorebreath.units import snap

MOST_CANDIDATES = 6
"""Candidates kept with a cut, best first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Cut:
    """A planner's decision: the group is the first `count` units."""

    count: int
    reason: CutReason


class Chunker(ABC):
    """A `Planner` whose subclass says where to cut next.

    What the markup asks for comes first: a group ends where a breath, a sound of one or another voice stands
    (`marks.DIVIDING`), and does not where `NoBreath` stands. Contradictory markup: the breath is taken.

    The last group known is held back until more text comes or the text is over: only then is it known whether its
    cut is the end of the text. After `finish` it can be fed again; indices go on.

    Args:
        count: Counts syllables.
        longest: Syllables one breath can hold; only joined words beyond this are divided.
        poem: Whether lines are lines of verse.
        sentences_apart: Whether a sentence's end inside a group divides it into parts.
    """

    def __init__(
        self, count: SyllableCounter, longest: int, poem: bool = False, *, sentences_apart: bool = False
    ) -> None:
        """Start with an empty text."""
        self._reader = UnitReader(count, longest, poem)
        self._units: list[Unit] = []
        self._held: Cut | None = None
        self._assembler = Assembler(sentences_apart=sentences_apart)

    def feed(self, sentence: Sentence) -> Iterator[BreathGroup]:
        """Take one sentence more (at once, whether or not the result is used); give the groups that are now certain."""
        if sentence.before:
            self.begin(sentence.before)
        self._units.extend(self._reader.read(sentence))
        return self._release(over=False)

    def finish(self) -> Iterator[BreathGroup]:
        """The text is over; give all that is left."""
        self._units.extend(self._reader.rest())
        return self._release(over=True)

    def begin(self, marks: Sequence[Mark]) -> None:
        """Marks before the first word of a text."""
        self._assembler.begin(marks)

    @abstractmethod
    def cut(self, text: Sequence[Unit], over: bool) -> Cut | None:
        """Where to cut the text that is left.

        Args:
            text: Units from the last cut on, at least one.
            over: Whether that is all the text there will be.

        Returns:
            The cut, or None where more text could change it; never None when the text is over.
        """

    def _release(self, over: bool) -> Iterator[BreathGroup]:
        while self._units:
            cut = self._held or self.cut(self._units, over)
            if cut is None:
                return
            if cut.count == len(self._units) and not over:
                self._held = cut
                return
            self._held = None
            last = cut.count == len(self._units)
            units = self._units[: cut.count]
            group = self._assembler.group(units, _ending(cut.reason, units[-1].end) if last else cut.reason, last=last)
            del self._units[: cut.count]
            yield group


def _ending(reason: CutReason, end: int) -> CutReason:
    """The reason for the last cut: whatever stands there, the text ends."""
    site: Site = "text end"
    candidates = (replace(one, site=site) if one.position == end else one for one in reason.candidates)
    return replace(reason, site=site, candidates=tuple(candidates))


def cut_at(
    text: Sequence[Unit],
    places: Sequence[tuple[int, float]],
    rule: str,
    site: Callable[[int], Site] | None = None,
) -> Cut:
    """The cut at the first of some places.

    Args:
        text: Units that are left.
        places: Units the group would have, and what that costs; best first. The first of equal places counts.
        rule: The rule's name and why.
        site: What stands after so many units, where their edges alone do not say it.
    """
    costs: dict[int, float] = {}
    for count, cost in places[:MOST_CANDIDATES]:
        costs.setdefault(count, cost)
    candidates = tuple(
        Candidate(
            site=site(count) if site else SITES[text[count - 1].edge], position=text[count - 1].end, cost=snap(cost)
        )
        for count, cost in costs.items()
    )
    return Cut(count=places[0][0], reason=CutReason(site=candidates[0].site, rule=rule, candidates=candidates))
