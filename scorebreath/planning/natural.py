"""Breath groups as people make them: the cheapest way to breathe through a paragraph (physiology 1.1, 1.2).

Four costs, all of them negative logarithms of probabilities: how readily one breathes at a boundary of that kind, or
passes it by with some of the budget used (`sites.HABITS`, by style); how far a group is from the length that is
preferred where it begins, in the body's state there (lognormal); the breath: what it takes beyond an easy one, up to a
limit that is never exceeded; and recovering from a group that used much. `lattice` finds the optimum. In spontaneous
speech keyed chance makes each boundary easier or harder (`variation`).

What the markup asks for is certain: a breath, a sound of one or another voice ends a group, a breath that it forbids
costs more than all others together, and a pause is a place to breathe.

A group is released when it is certain. Within a paragraph that is when all plans that later text could still make the
cheapest begin with it: every plan has a cut among the last words, as many as one breath holds, so the cheapest plans to
those few places are all that matters, and what they share cannot change. A paragraph's end always ends a group, so it
settles everything before it, unless what follows is too short and too soon for a breath of its own. Where plans never
agree (endless text without punctuation), the text after the last cut is bounded by `WINDOW` breaths: then the first
half of the cheapest plan is settled, with the other half as look-ahead.
All depends on the text alone, not on how it arrives. Time O(words * words in a breath).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import inf

from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning.chunker import Chunker, Cut, cut_at
from scorebreath.planning.lattice import Lattice
from scorebreath.planning.markers import LONGEST_WORD
from scorebreath.planning.model import SyllableCounter
from scorebreath.planning.sites import FORBIDDEN, HABITS, Boundary, boundary, eased, function_words
from scorebreath.planning.starts import RATE, most_syllables
from scorebreath.planning.timeline import Timeline
from scorebreath.planning.units import Unit, dividing
from scorebreath.planning.variation import Variation
from scorebreath.script.marks import Mark

NAME = "natural"
WINDOW = 4
"""Breaths of text that may be left without a certain cut."""
SHORT = 3
"""Syllables for which nobody breathes in again ..."""
SOON = 1.5
"""... within so many seconds since the last inspiration (physiology 1.2, from Scobbie et al. 2011)."""


class Natural(Chunker):
    """The optimum over a paragraph.

    Args:
        parameters: `style`, what `starts` needs, and all that modifies breathing (`parameters.modifiers`).
        language: BCP 47; one without a table of function words is cut at punctuation, else between any words.
        count: Counts syllables, best as the voice says them.
        poem: Whether lines are lines of verse.
        blend: The states at the beginning of the text.
        time: When it begins, on the blend's clock, s.
        seed: Of chance.
        body: Whose chance it is.
        cast: Parameters of those who speak with another voice, by its name.
    """

    def __init__(
        self,
        parameters: Parameters,
        language: str,
        count: SyllableCounter,
        poem: bool = False,
        *,
        blend: Blend | None = None,
        time: float = 0.0,
        seed: int = 0,
        body: str = "body",
        cast: Mapping[str, Parameters] | None = None,
    ) -> None:
        """Start with an empty text."""
        self.most = most_syllables(parameters)
        super().__init__(count, max(self.most, LONGEST_WORD), poem, sentences_apart=True)
        self._soon_over = min(SOON * RATE * parameters.prosody_rate, self.most - SHORT + 1)
        self._words = function_words(language)
        self._habits = HABITS[parameters.style]
        self._timeline = Timeline(parameters, blend or Blend(), time=time, habits=self._habits, cast=cast)
        self._variation = Variation(seed, body, self._habits.variation, self._habits.unevenness)
        self._settled: deque[Cut] = deque()
        self._lattice = Lattice(self._timeline.start())

    def begin(self, marks: Sequence[Mark]) -> None:
        """Marks before the first word of a text."""
        super().begin(marks)
        self._timeline.heed(marks)
        if not len(self._lattice):
            self._lattice = Lattice(self._timeline.start())

    def cut(self, text: Sequence[Unit], over: bool) -> Cut | None:
        """The next cut of the cheapest plan, once it is certain."""
        while True:
            while len(self._settled) < 2 and (not self._settled or self._soon(text, self._settled[0])):
                known = sum(cut.count for cut in self._settled)
                if not self._advance(text[known:] if known else text, over):
                    break
            if not self._settled:
                return None
            first = self._settled[0]
            if not self._soon(text, first):
                return self._settled.popleft()
            if len(self._settled) < 2:
                return self._settled.popleft() if over else None
            second = self._settled[1]
            if _syllables(text[first.count : first.count + second.count]) > SHORT:
                return self._settled.popleft()
            self._settled.popleft()
            self._settled[0] = self._joined(text, first, second)

    def _soon(self, text: Sequence[Unit], cut: Cut) -> bool:
        """Whether the next breath would come soon after the last, and nothing asks for it."""
        syllables = _syllables(text[: cut.count])
        return syllables < self._soon_over and not dividing(text[cut.count - 1].after)

    def _joined(self, text: Sequence[Unit], first: Cut, second: Cut) -> Cut:
        syllables = _syllables(text[: first.count])
        rule = f"{NAME}: no breath {syllables} syllables after the last for {SHORT} more or less; "
        rest = second.reason.rule.removeprefix(f"{NAME}: ")
        return Cut(count=first.count + second.count, reason=replace(second.reason, rule=rule + rest))

    def _advance(self, text: Sequence[Unit], over: bool) -> bool:
        """Settle a cut, or take one unit more; False where more text is needed. Node j lies after text[j - 1]."""
        lattice, known = self._lattice, len(self._lattice)
        if known and (_ends(lattice.boundaries[known]) or (over and known == len(text))):
            cuts = lattice.plan()
            tired = self._settle(text, cuts)
            tired = tired and lattice.boundaries[known].site == "tag"
            self._lattice = Lattice(lattice.start(known), recovering=tired)
        elif lattice.certain():
            self._settle(text, lattice.plan(), 1)
            lattice.reroot()
        elif lattice.syllables > WINDOW * lattice.most:
            cuts = lattice.plan()
            half = max(1, sum(cut <= known // 2 for cut in cuts))
            tired = self._settle(text, cuts, half)
            self._lattice = lattice.restarted(cuts[half - 1], recovering=tired)
        elif known < len(text) and (over or _clear(text, known)):
            self._add(text, known)
        else:
            return False
        return True

    def _add(self, text: Sequence[Unit], index: int) -> None:
        """One unit more."""
        unit = text[index]
        found = boundary(text, index, self._words, self._habits)
        harder, longer = self._variation.after(unit)
        if not _ends(found):
            found = eased(found, self._timeline.shortness)
            found = found._replace(breathing=found.breathing + harder)
        self._lattice.add(unit.syllables, found, self._timeline.say(unit, longer))

    def _settle(self, text: Sequence[Unit], cuts: Sequence[int], count: int | None = None) -> bool:
        """The first `count` cuts of a plan (all by default) become decisions; whether the last of them tires."""
        recovering = self._lattice.recovering
        starts = [0, *cuts]
        for place, start in enumerate(starts[:-1][:count]):
            self._settled.append(self._decide(text, starts[place : place + 4], recovering))
            recovering = self._lattice.tires(start, starts[place + 1])
        return recovering

    def _decide(self, text: Sequence[Unit], nodes: Sequence[int], recovering: bool) -> Cut:
        """The cut at the second of the nodes, and what another place for it would have cost while the others stay.

        By the optimality of the plan none is cheaper. A place at the third stands for not breathing at the second at
        all. What other places mean for the group that ends at the fourth is counted, too.
        """
        start, end = nodes[:2]
        following = nodes[2] if len(nodes) > 2 else end
        lattice = self._lattice
        boundaries = lattice.boundaries

        def cost(other: int) -> float:
            total, tired = lattice.cost(start, other, recovering=recovering), lattice.tires(start, other)
            if other < following:
                total += lattice.cost(other, following, recovering=tired)
                tired = lattice.tires(other, following)
            if len(nodes) > 3:
                lengths = (lattice.cost(following, nodes[3], recovering=one) for one in (tired, False))
                total += next(lengths) - next(lengths)
            return total

        costs = [
            (other - start, cost(other))
            for other in range(start + 1, following + 1)
            if other == end or boundaries[other].site != "word"
        ]
        places = sorted((place for place in costs if place[1] < inf), key=lambda p: (p[0] != end - start, p[1]))
        units = text[start:following]
        body = lattice.start(start)
        asked = dividing(units[end - start - 1].after)
        return cut_at(
            units,
            places,
            f"{NAME}: {f'{asked.written} asks for it, ' if asked else ''}"
            f"after {_syllables(units[: end - start])} syllables, {body.preferred:.3g} preferred, {body.most} at most; "
            + _comparison(places),
            lambda count: boundaries[start + count].site,
        )


def _ends(found: Boundary) -> bool:
    """Whether a group ends there whatever it costs."""
    return found.site == "tag" or (found.site == "paragraph" and found.breathing < FORBIDDEN / 2.0)


def _syllables(units: Sequence[Unit]) -> int:
    return sum(unit.syllables for unit in units)


def _clear(text: Sequence[Unit], index: int) -> bool:
    """Whether what follows `text[index]` is certain: a function word, and whether more than one word follows it."""
    after = text[index + 1 : index + 3]
    return text[index].edge not in ("comma", "word") or len(after) == 2 or (len(after) == 1 and after[0].edge != "word")


def _comparison(places: Sequence[tuple[int, float]]) -> str:
    if len(places) == 1:
        return "nothing else fits"
    return f"cheapest of {len(places)} places, the next costs {places[1][1] - places[0][1]:.2f} more"
