"""What all planners share: text comes in by the sentence, groups go out as soon as they are certain."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from scorebreath.planning.model import BreathGroup, Part, SyllableCounter
from scorebreath.planning.units import Unit, UnitReader
from scorebreath.score.document import Candidate, CutReason, Site
from scorebreath.script.model import Edge, ScriptWord, Sentence
from scorebreath.spans import Run, Span, SpokenText
from scorebreath.units import snap

SITES: dict[Edge, Site] = {
    "paragraph": "paragraph",
    "sentence": "sentence",
    "semicolon": "semicolon",
    "comma": "comma",
    "line": "line",
    "marker": "marker",
    "word": "word",
    "joint": "word",
}
"""What a cut after each edge is called: by what stands there, whichever rule chose it; `text end` at the end of all."""

MOST_CANDIDATES = 6
"""Candidates kept with a cut, best first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Cut:
    """A planner's decision: the group is the first `count` units."""

    count: int
    reason: CutReason


class Chunker(ABC):
    """A `Planner` whose subclass says where to cut next.

    The last group known is held back until more text comes or the text is over: only then is it known whether its
    cut is the end of the text. After `finish` it can be fed again; indices go on.

    Args:
        count: Counts syllables.
        longest: Syllables one breath can hold; only joined words beyond this are divided.
        poem: Whether lines are lines of verse.
    """

    def __init__(self, count: SyllableCounter, longest: int, poem: bool = False) -> None:
        """Start with an empty text."""
        self._reader = UnitReader(count, longest, poem)
        self._units: list[Unit] = []
        self._held: Cut | None = None
        self._index = 0

    def feed(self, sentence: Sentence) -> Iterator[BreathGroup]:
        """Take one sentence more (at once, whether or not the result is used); give the groups that are now certain."""
        self._units.extend(self._reader.read(sentence))
        return self._release(over=False)

    def finish(self) -> Iterator[BreathGroup]:
        """The text is over; give all that is left."""
        self._units.extend(self._reader.rest())
        return self._release(over=True)

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
            group = self._group(cut, last=cut.count == len(self._units))
            del self._units[: cut.count]
            self._index += 1
            yield group

    def _group(self, cut: Cut, last: bool) -> BreathGroup:
        units = self._units[: cut.count]
        words = tuple(word for unit in units for word in unit.words)
        whole = Part(
            source=Span(units[0].start, units[-1].end),
            spoken=say(words),
            words=words,
            syllables=sum(unit.syllables for unit in units),
            sentence_type=units[-1].sentence_type,
            ends_sentence=units[-1].closes,
        )
        source = whole.source
        return BreathGroup(
            index=self._index,
            source=source,
            text="".join(unit.written for unit in units)[: source.length],
            spoken=whole.spoken,
            words=words,
            syllables=whole.syllables,
            sentence_type=whole.sentence_type,
            ends_sentence=whole.ends_sentence,
            parts=(whole,),
            cut=_ending(cut.reason, source.end) if last else cut.reason,
        )


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


def say(words: Sequence[ScriptWord]) -> SpokenText:
    """The words as a voice is to say them, a space between them except after `joint`; spans stay absolute."""
    text: list[str] = []
    runs: list[Run] = []
    at = 0
    space = ""
    for word in words:
        if not word.spoken.text:
            continue
        text += (space, word.spoken.text)
        at += len(space)
        runs += (Run(at + run.start, at + run.end, run.source) for run in word.spoken.runs)
        at += len(word.spoken.text)
        space = "" if word.edge == "joint" else " "
    return SpokenText(text="".join(text), runs=tuple(runs))
