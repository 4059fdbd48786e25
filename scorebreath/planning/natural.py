"""Breath groups as people make them: the cheapest way to breathe through a paragraph (physiology 1.1, 1.2).

Three costs, all of them negative logarithms of probabilities: how readily one breathes at a boundary of that kind, or
passes it by with some of the budget used (`sites.READINESS`); how far a group is from the preferred length (lognormal);
and the breath: what it takes beyond an easy one, up to a limit that is never exceeded. `lattice` finds the optimum.

A group is released when it is certain. Within a paragraph that is when all plans that later text could still make the
cheapest begin with it: every plan has a cut among the last words, as many as one breath holds, so the cheapest plans to
those few places are all that matters, and what they share cannot change. A paragraph's end always ends a group, so it
settles everything before it. Where plans never agree (endless text without punctuation), the text after the last cut is
bounded by `WINDOW` breaths: then the first half of the cheapest plan is settled, with the other half as look-ahead.
Both depend on the text alone, not on how it arrives. Time O(words * words in a breath).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from math import exp, inf, log

from scorebreath.parameters.derive import derive
from scorebreath.parameters.table import Parameters
from scorebreath.planning.chunker import Chunker, Cut, cut_at
from scorebreath.planning.lattice import Lattice
from scorebreath.planning.model import SyllableCounter
from scorebreath.planning.sites import boundary, function_words
from scorebreath.planning.units import Unit

NAME = "natural"
SPREAD = 0.45
"""Sigma of the lognormal cost of a group's length. Measured groups spread by 0.385 (physiology 1.1), but those are
outcomes, and the cheapest plan keeps clear of the tails: a milder cost makes its groups spread as widely."""
BUDGET = 0.35
"""Share of the preferred length from which on a boundary is passed at a cost (physiology 1.2: 0.6)."""
EASY = 0.27
"""Vital capacity that a breath uses with ease: from 52 % (usual initiation) to 25 % (lowest termination;
physiology 2.2)."""
DEEPER = 0.05
"""Standard deviation of what deeper breaths take on top (physiology 2.2: SD of the initiation)."""
DEEPEST = 0.40
"""The most one breath can use: from 65 % (initiation, loud) to 25 %."""
LONGEST = 12.5
"""Seconds from the inspiration's onset to the last phone (physiology 1.1; B52: 12.6)."""
RATE = 5.0
"""Syllables a second at prosody_rate 1 (physiology 1.1)."""
WINDOW = 4
"""Breaths of text that may be left without a certain cut."""


class Natural(Chunker):
    """The optimum over a paragraph.

    Args:
        parameters: The preferred length is `length_utterance`, in syllables; `volume_per_syllable`, `capacity_lung`,
            `prosody_rate` and the inspiration's length bound a breath.
        language: BCP 47; one without a table of function words is cut at punctuation, else between any words.
        count: Counts syllables, best as the voice says them.
        poem: Whether lines are lines of verse.
    """

    def __init__(self, parameters: Parameters, language: str, count: SyllableCounter, poem: bool = False) -> None:
        """Start with an empty text."""
        self.most = most_syllables(parameters)
        super().__init__(count, self.most, poem)
        self.preferred = derive(parameters).length_utterance
        self._words = function_words(language)
        self._length = length_costs(self.preferred, self.most, syllable_volume(parameters))
        self._settled: deque[Cut] = deque()
        self._lattice = self._fresh()

    def cut(self, text: Sequence[Unit], over: bool) -> Cut | None:
        """The next cut of the cheapest plan, once it is certain."""
        while not self._settled:
            if not self._advance(text, over):
                return None
        return self._settled.popleft()

    def _advance(self, text: Sequence[Unit], over: bool) -> bool:
        """Settle a cut, or take one unit more; False where more text is needed. Node j lies after text[j - 1]."""
        lattice, known = self._lattice, len(self._lattice)
        if known and (lattice.boundaries[known].site == "paragraph" or (over and known == len(text))):
            self._settle(text, lattice.plan())
            self._lattice = self._fresh()
        elif lattice.certain():
            cuts = lattice.plan()
            self._settle(text, cuts, 1)
            lattice.reroot(cuts[0])
        elif lattice.syllables > WINDOW * self.most:
            cuts = lattice.plan()
            half = max(1, sum(cut <= known // 2 for cut in cuts))
            self._settle(text, cuts, half)
            self._lattice = lattice.restarted(cuts[half - 1])
        elif known < len(text) and (over or _clear(text, known)):
            lattice.add(text[known].syllables, boundary(text, known, self._words))
        else:
            return False
        return True

    def _settle(self, text: Sequence[Unit], cuts: Sequence[int], count: int | None = None) -> None:
        """The first `count` cuts of a plan (all by default) become decisions."""
        starts = [0, *cuts]
        for start, end, following in zip(starts, cuts[:count], [*cuts[1:], cuts[-1]], strict=False):
            self._settled.append(self._decide(text, start, end, following))

    def _decide(self, text: Sequence[Unit], start: int, end: int, following: int) -> Cut:
        """The cut at `end`, and what another place for it would have cost while the next one stays at `following`.

        By the optimality of the plan none is cheaper. A place at `following` stands for not breathing at `end` at all.
        """
        lattice = self._lattice
        boundaries = lattice.boundaries
        costs = [
            (other - start, lattice.cost(start, other) + (lattice.cost(other, following) if other < following else 0.0))
            for other in range(start + 1, following + 1)
            if other == end or boundaries[other].site != "word"
        ]
        places = sorted((place for place in costs if place[1] < inf), key=lambda p: (p[0] != end - start, p[1]))
        units = text[start:following]
        syllables = sum(unit.syllables for unit in units[: end - start])
        return cut_at(
            units,
            places,
            f"{NAME}: after {syllables} syllables, {self.preferred:g} preferred, {self.most} at most; "
            + _comparison(places),
            lambda count: boundaries[start + count].site,
        )

    def _fresh(self) -> Lattice:
        return Lattice(self._length, BUDGET * self.preferred)


def most_syllables(parameters: Parameters) -> int:
    """Syllables one breath holds: as many as the lungs, or the longest group, allow; at least 1.

    >>> most_syllables(Parameters()), most_syllables(Parameters(capacity_lung=64.0))
    (44, 28)
    >>> most_syllables(Parameters(volume_per_syllable=0.001))
    57
    """
    p = parameters
    by_volume = DEEPEST / syllable_volume(p)
    by_time = (LONGEST - p.inspiration_base - p.silence_after_breath) / (
        1.0 / (RATE * p.prosody_rate) + p.inspiration_per_syllable
    )
    return max(1, int(min(by_volume, by_time)))


def syllable_volume(parameters: Parameters) -> float:
    """What one syllable takes of the person's own vital capacity, as a fraction.

    >>> syllable_volume(Parameters(capacity_lung=50.0))
    0.018
    """
    return parameters.volume_per_syllable * 100.0 / parameters.capacity_lung


def length_costs(preferred: float, most: int, volume: float) -> list[float]:
    r"""Cost of groups of 0 to `most` syllables, each taking `volume` of the lungs.

    :math:`\ln^2(n / m) / 2 \sigma^2`, with the median :math:`m = preferred \cdot e^{-\sigma^2 / 2}` that makes
    `preferred` the mean; beyond an easy breath also :math:`(n \cdot volume - EASY)^2 / 2 \cdot DEEPER^2`.

    >>> costs = length_costs(18.0, 44, 0.009)
    >>> costs.index(min(costs)), round(costs[8], 2), round(costs[30], 2), round(costs[41], 2)
    (16, 1.24, 0.93, 4.07)
    """
    median = preferred * exp(-(SPREAD**2) / 2.0)
    return [
        (log(max(1, n) / median) / SPREAD) ** 2 / 2.0 + (max(0.0, n * volume - EASY) / DEEPER) ** 2 / 2.0
        for n in range(most + 1)
    ]


def _clear(text: Sequence[Unit], index: int) -> bool:
    """Whether what follows `text[index]` is certain: a function word, and whether more than one word follows it."""
    after = text[index + 1 : index + 3]
    return text[index].edge not in ("comma", "word") or len(after) == 2 or (len(after) == 1 and after[0].edge != "word")


def _comparison(places: Sequence[tuple[int, float]]) -> str:
    if len(places) == 1:
        return "nothing else fits"
    return f"cheapest of {len(places)} places, the next costs {places[1][1] - places[0][1]:.2f} more"
