"""All ways to breathe through a stretch of text, and the cheapest: dynamic programming over its boundaries.

Nodes are boundaries: node 0 where the stretch begins, node j after its j-th unit. A group from node i to node j costs

    length(syllables from i to j) + breathing(j) + the passing of every boundary between them at which
                                                     most of the budget was used already

and a plan costs the sum of its groups. A group never exceeds the breath, unless a single unit does.

A node is open while a later group could still start from it in a cheapest plan. It closes when one breath no longer
reaches the next unit from it, or when other nodes are better starts whatever text comes. What the cheapest plans
to all open nodes share can not change any more.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Sequence
from functools import lru_cache
from math import ceil, inf

from scorebreath.planning.sites import Boundary

MARGIN = 1e-9
"""Costs nearer than this count as equal: sums of many terms are not exact."""


class Lattice:
    """The cheapest plan to every node so far.

    Args:
        length: Cost of a group of n syllables, for n up to the most one breath can hold; shape (most + 1,).
        budget: Syllables from which on boundaries are passed at a cost.
    """

    def __init__(self, length: Sequence[float], budget: float) -> None:
        """Begin with node 0 alone."""
        self._length = length
        self._budget = ceil(budget)  # whole, as syllables are: sums with it are exact
        self._saved, self._worse = extremes(tuple(length), 1), extremes(tuple(length), -1)
        self.boundaries: list[Boundary] = [Boundary("paragraph", 0.0, 0.0)]
        self._total = [0]
        """syllables up to each node"""
        self._passed = [0.0]
        """cost of passing all nodes up to and with each"""
        self._best = [0.0]
        """cost of the cheapest plan to each node"""
        self._ahead = [0.0]
        """the same, less what lies before the first boundary that would be passed at a cost from there"""
        self._before = [0]
        """the node before it on that plan"""
        self._first = [0]
        """the first cut of that plan; -1 where it no longer begins at node 0"""
        self._low = 0
        """the earliest node from which one breath reaches the next unit"""
        self._ripe = 0
        """nodes before this one have used their budget at the newest node"""
        self._open = Counter({0: 1})
        """open nodes, by the first cut of the plans to them"""
        self._closed = [False]

    def __len__(self) -> int:
        """Units in the stretch."""
        return len(self._total) - 1

    @property
    def syllables(self) -> int:
        """Syllables in the stretch."""
        return self._total[-1] - self._total[0]

    def add(self, syllables: int, boundary: Boundary) -> None:
        """One unit more: find the cheapest plan that ends after it. O(units in a breath)."""
        newest, total = len(self._total) - 1, self._total[-1] + syllables
        while self._total[newest] - self._total[self._ripe] >= self._budget and self._ripe < newest:
            # the newest node is the first one at which a breath from `ripe` has used its budget
            self._ahead[self._ripe] = self._best[self._ripe] - self._passed[newest - 1]
            self._ripe += 1
        while self._low < newest and total - self._total[self._low] > len(self._length) - 1:
            self._close(self._low)
            self._low += 1
        best, before = inf, newest
        passed, totals, length = self._passed[newest], self._total, self._length
        for node in range(self._low, self._ripe):
            cost = self._ahead[node] + passed + length[min(total - totals[node], len(length) - 1)]
            if cost < best:
                best, before = cost, node
        for node in range(max(self._low, self._ripe), newest + 1):
            cost = self._best[node] + length[min(total - totals[node], len(length) - 1)]
            if cost < best:
                best, before = cost, node
        self.boundaries.append(boundary)
        self._total.append(total)
        self._passed.append(passed + boundary.passing)
        self._best.append(best + boundary.breathing)
        self._ahead.append(0.0)
        self._before.append(before)
        first = self._first[before] if before else newest + 1
        self._first.append(first)
        self._closed.append(False)
        self._open[first] += 1
        if len(self._open) > 1:
            self._close_hopeless()

    def cost(self, start: int, end: int) -> float:
        """Cost of one group from node to node; infinite if it exceeds the breath."""
        syllables = self._total[end] - self._total[start]
        if syllables >= len(self._length) and end - start > 1:
            return inf
        ripe = bisect_left(self._total, self._total[start] + self._budget, start + 1, end)
        passing = self._passed[end - 1] - self._passed[ripe - 1] if ripe < end else 0.0
        return self._length[min(syllables, len(self._length) - 1)] + passing + self.boundaries[end].breathing

    def best(self) -> float:
        """Cost of the cheapest plan for the whole stretch."""
        return self._best[-1]

    def plan(self) -> list[int]:
        """The cheapest plan's cuts: nodes in order, the last node among them."""
        cuts = [len(self)]
        while self._before[cuts[-1]]:
            cuts.append(self._before[cuts[-1]])
        return cuts[::-1]

    def certain(self) -> bool:
        """Whether every plan that later text could make the cheapest begins with the same group."""
        return len(self._open) == 1 and 0 not in self._open

    def reroot(self, node: int) -> None:
        """Begin at `node`, the cut that is certain: what lies before it is settled."""
        for row in (self.boundaries, self._total, self._passed, self._best, self._ahead, self._before, self._first):
            del row[:node]
        del self._closed[:node]
        self._low = max(0, self._low - node)
        self._ripe = max(0, self._ripe - node)
        self._before = [max(0, before - node) for before in self._before]
        for j, before in enumerate(self._before):
            ours = j == 0 or self._first[j] == node
            self._first[j] = (self._first[before] if before else j) if ours else -1
        self._open = Counter(first for first, closed in zip(self._first, self._closed, strict=True) if not closed)

    def restarted(self, node: int) -> Lattice:
        """A lattice of the units after `node` alone, searched anew. O(units * units in a breath)."""
        fresh = Lattice(self._length, self._budget)
        for j in range(node + 1, len(self._total)):
            fresh.add(self._total[j] - self._total[j - 1], self.boundaries[j])
        return fresh

    def _close_hopeless(self) -> None:
        """Close nodes that a cheapest plan cannot use, whatever text comes."""
        newest = len(self)
        plan = [newest]
        while plan[-1] > self._low:
            plan.append(self._before[plan[-1]])
        for node in range(self._low, newest):
            agrees = self._first[node] == self._first[newest]
            if not agrees and not self._closed[node] and self._hopeless(node, plan):
                self._close(node)

    def _hopeless(self, node: int, plan: Sequence[int]) -> bool:
        """Whether wherever the next group ends, it had better start from a node of `plan` (newest first) than here.

        From an earlier start, if one breath reaches that far; it passes all that is passed from here, and that many
        more. Else from a later one; what it does not pass yet only speaks for it.
        """
        newest, most, total = plan[0], len(self._length) - 1, self._total
        unanswered = total[newest]
        earlier = next((start for start in plan if start < node), None)
        if earlier is not None and node < self._ripe:
            others, syllables = total[node] - total[earlier], min(unanswered - total[node], most)
            loss = self._ahead[node] - self._ahead[earlier] - MARGIN
            if others <= most and self._saved[others][syllables] < loss:
                unanswered = max(unanswered, total[earlier] + most + 1)
        for later in plan:
            if later <= node:
                return False
            syllables = unanswered - total[later]
            if total[later] - total[node] + syllables > most:
                return True
            passed = bisect_left(total, total[later] + self._budget, later + 1) - 1
            here = self._ahead[node] + self._passed[passed] if node < self._ripe else self._best[node]
            if self._worse[total[later] - total[node]][syllables] < here - self._best[later] - MARGIN:
                return True
        return False

    def _close(self, node: int) -> None:
        if self._closed[node]:
            return
        self._closed[node] = True
        first = self._first[node]
        self._open[first] -= 1
        if not self._open[first]:
            del self._open[first]


@lru_cache(maxsize=8)
def extremes(length: tuple[float, ...], sign: int) -> list[list[float]]:
    """How much more a group can cost with other syllables besides: [others][syllables], whatever is still added.

    Args:
        length: Cost of a group of n syllables, n = 0..most.
        sign: 1 for what the longer group costs more, -1 for what the shorter one does.

    Returns:
        Shape (most + 1, most + 1); -infinity where the longer one exceeds the breath.

    >>> extremes((9.0, 4.0, 1.0, 0.0, 2.0), -1)[1]
    [5.0, 3.0, 1.0, -2.0, -inf]
    >>> extremes((9.0, 4.0, 1.0, 0.0, 2.0), 1)[1]
    [2.0, 2.0, 2.0, 2.0, -inf]
    """
    most = len(length) - 1
    rows = [[-inf] * (most + 1) for _ in length]
    for others, row in enumerate(rows):
        extreme = -inf
        for syllables in range(most - others, -1, -1):
            extreme = max(extreme, sign * (length[syllables + others] - length[syllables]))
            row[syllables] = extreme
    return rows
