"""All ways to breathe through a stretch of text, and the cheapest: dynamic programming over its boundaries.

Nodes are boundaries: node 0 where the stretch begins, node j after its j-th unit. What a group costs depends on where
it starts (`Start`: the state of the body there) and on whether the group before used much of the lungs, so that this
one is still recovering. A way to be at a node, fresh or recovering, is a vertex. A group from a vertex to node j costs

    length(syllables of the group) + breathing(j) + the passing of every boundary between them at which
                                                    most of the budget was used already

and a plan costs the sum of its groups. A group never exceeds the breath, unless a single unit does.

A vertex is open while a later group could still start from it in a cheapest plan. It closes when one breath no longer
reaches the next unit from it, or when others are better starts whatever text comes. What the cheapest plans to all open
vertices share can not change any more.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Sequence
from math import inf

from scorebreath.planning.sites import Boundary
from scorebreath.planning.starts import Start, worst

MARGIN = 1e-9
"""Costs nearer than this count as equal: sums of many terms are not exact."""


class Lattice:
    """The cheapest plans to every node so far.

    Args:
        start: The body at node 0.
        recovering: Whether it still recovers from the group before.
    """

    def __init__(self, start: Start, *, recovering: bool = False) -> None:
        """Begin with node 0 alone."""
        self.boundaries: list[Boundary] = [Boundary("paragraph", 0.0, 0.0)]
        self._starts = [start]
        self._total = [0]
        """syllables up to each node"""
        self._passed = [0.0]
        """cost of passing all nodes up to and with each"""
        self._at = [[0]]
        """vertices of each node"""
        self._node = [0]
        """of each vertex; the other lists below are of vertices, too"""
        self._recovering = [recovering]
        self._length = [start.length(recovering)]
        self._best = [0.0]
        """cost of the cheapest plan to each"""
        self._ahead: list[float | None] = [None]
        """the same, less what lies before the first boundary that would be passed at a cost from there; None where
        that boundary has not come yet"""
        self._before = [0]
        """the vertex before it on that plan"""
        self._first = [0]
        """the first vertex after the root on that plan"""
        self._closed = [False]
        self._window = [0]
        """open vertices"""
        self._open = Counter({0: 1})
        """how many are open, by the first vertices of the plans to them"""

    def __len__(self) -> int:
        """Units in the stretch."""
        return len(self._total) - 1

    @property
    def syllables(self) -> int:
        """Syllables in the stretch."""
        return self._total[-1] - self._total[0]

    @property
    def most(self) -> int:
        """Syllables that the greatest breath in the stretch holds."""
        return max(start.most for start in self._starts)

    def add(self, syllables: int, boundary: Boundary, start: Start | None = None) -> None:
        """One unit more: find the cheapest plans that end after it. O(units in a breath).

        Args:
            syllables: Of the unit.
            boundary: What follows it.
            start: The body there; by default as at the node before.
        """
        newest, node = len(self), len(self) + 1
        total, passed = self._total[-1] + syllables, self._passed[-1]
        best, before = [inf, inf], [-1, -1]
        for vertex in tuple(self._window):
            at = self._node[vertex]
            group, most = total - self._total[at], self._starts[at].most
            if group > most and at < newest:
                self._close(vertex)
                continue
            ahead = self._ahead[vertex]
            if ahead is None and at < newest and self._total[newest] - self._total[at] >= self._starts[at].budget:
                # the newest node is the first one at which a breath from here has used its budget
                ahead = self._ahead[vertex] = self._best[vertex] - self._passed[newest - 1]
            cost = self._length[vertex][min(group, most)] + (self._best[vertex] if ahead is None else ahead + passed)
            tired = group > self._starts[at].much
            if cost < best[tired]:
                best[tired], before[tired] = cost, vertex
        self.boundaries.append(boundary)
        self._starts.append(start or self._starts[-1])
        self._total.append(total)
        self._passed.append(passed + boundary.passing)
        self._at.append([])
        gain = self._starts[node].recovery
        if best[False] <= best[True] < inf:
            best[True] = inf
        elif best[True] + gain + MARGIN < best[False]:
            best[False] = inf
        for tired in (False, True):
            if best[tired] < inf:
                self._reach(node, tired, best[tired] + boundary.breathing, before[tired])
        if len(self._open) > 1:
            self._close_hopeless()

    def cost(self, start: int, end: int, *, recovering: bool = False) -> float:
        """Cost of one group from node to node; infinite if it exceeds the breath."""
        body, syllables = self._starts[start], self._total[end] - self._total[start]
        if syllables > body.most and end - start > 1:
            return inf
        ripe = bisect_left(self._total, self._total[start] + body.budget, start + 1, end)
        passing = self._passed[end - 1] - self._passed[ripe - 1] if ripe < end else 0.0
        length = body.length(recovering)[min(syllables, body.most)]
        return length + passing + self.boundaries[end].breathing

    def tires(self, start: int, end: int) -> bool:
        """Whether the group after one from `start` to `end` is still recovering from it."""
        return self._total[end] - self._total[start] > self._starts[start].much

    @property
    def recovering(self) -> bool:
        """Whether the body still recovers at node 0."""
        return self._recovering[0]

    def start(self, node: int) -> Start:
        """The body at a node."""
        return self._starts[node]

    def best(self) -> float:
        """Cost of the cheapest plan for the whole stretch."""
        return self._best[self._last()]

    def plan(self) -> list[int]:
        """The cheapest plan's cuts: nodes in order, the last node among them."""
        return [self._node[vertex] for vertex in self._chain()[-2::-1]] if len(self) else []

    def certain(self) -> bool:
        """Whether every plan that later text could make the cheapest begins with the same group."""
        return len(self._open) == 1 and 0 not in self._open

    def reroot(self) -> None:
        """Begin at the cut that is certain: what lies before it is settled."""
        (root,) = self._open
        node = self._node[root]
        kept = [root, *(vertex for vertex in range(root + 1, len(self._node)) if self._first[vertex] == root)]
        new = {vertex: place for place, vertex in enumerate(kept)}
        for nodes in (self.boundaries, self._starts, self._total, self._passed):
            del nodes[:node]
        self._node = [self._node[vertex] - node for vertex in kept]
        for name in ("_recovering", "_length", "_best", "_ahead", "_closed"):
            old = getattr(self, name)
            setattr(self, name, [old[vertex] for vertex in kept])
        self._before = [new.get(self._before[vertex], 0) for vertex in kept]
        self._first = [0] * len(kept)
        self._at = [[] for _ in self._total]
        for vertex, at in enumerate(self._node):
            self._at[at].append(vertex)
            before = self._before[vertex]
            self._first[vertex] = self._first[before] if before else vertex
        self._window = [new[vertex] for vertex in self._window]
        self._open = Counter(self._first[vertex] for vertex in self._window)

    def restarted(self, node: int, *, recovering: bool) -> Lattice:
        """A lattice of the units after `node` alone, searched anew. O(units * units in a breath)."""
        fresh = Lattice(self._starts[node], recovering=recovering)
        for j in range(node + 1, len(self._total)):
            fresh.add(self._total[j] - self._total[j - 1], self.boundaries[j], self._starts[j])
        return fresh

    def _reach(self, node: int, recovering: bool, best: float, before: int) -> None:
        """A new vertex, at the newest node."""
        vertex = len(self._node)
        self._at[node].append(vertex)
        self._node.append(node)
        self._recovering.append(recovering)
        self._length.append(self._starts[node].length(recovering))
        self._best.append(best)
        self._ahead.append(None)
        self._before.append(before)
        self._first.append(self._first[before] if before else vertex)
        self._closed.append(False)
        self._window.append(vertex)
        self._open[self._first[vertex]] += 1

    def _last(self) -> int:
        """The vertex at the end of the cheapest plan."""
        return min(self._at[-1], key=self._best.__getitem__)

    def _chain(self, until: int = 0) -> list[int]:
        """Vertices of the cheapest plan, the last one first, as far back as node `until`."""
        chain = [self._last()]
        while chain[-1] and self._node[chain[-1]] > until:
            chain.append(self._before[chain[-1]])
        return chain

    def _close_hopeless(self) -> None:
        """Close vertices that a cheapest plan cannot use, whatever text comes."""
        plan = self._chain(self._node[self._window[0]])
        ours = self._first[plan[0]]
        for vertex in tuple(self._window):
            if self._first[vertex] != ours and self._node[vertex] < len(self) and self._hopeless(vertex, plan):
                self._close(vertex)

    def _hopeless(self, vertex: int, plan: Sequence[int]) -> bool:
        """Whether wherever the next group ends, it had better start from a vertex of `plan` (newest first) than here.

        From an earlier start, as far as one breath reaches from there; else from a later one. What is passed at a cost
        from a start grows alike for all once it has begun.
        """
        node, total, newest = self._node[vertex], self._total, len(self)
        body, tired, ahead = self._starts[node], self._recovering[vertex], self._ahead[vertex]
        unanswered = total[newest] - total[node]
        if ahead is not None:
            for earlier in plan:
                start, at = self._ahead[earlier], self._node[earlier]
                if at < node and start is not None:
                    others, there = total[node] - total[at], self._starts[at]
                    if (
                        worst(body, tired, there, self._recovering[earlier], others)[unanswered]
                        < ahead - start - MARGIN
                    ):
                        unanswered = max(unanswered, there.most + 1 - others)
                    break
        for later in plan:
            at = self._node[later]
            if at <= node:
                return False
            if unanswered > body.most:
                return True
            others, there = total[at] - total[node], self._starts[at]
            if ahead is not None:
                ripe = bisect_left(total, total[at] + there.budget, at + 1)
                here = ahead + self._passed[ripe - 1]
            elif others + there.budget >= body.budget:
                here = self._best[vertex]
            else:
                continue
            dearer = worst(body, tired, there, self._recovering[later], -others)[unanswered]
            if dearer < here - self._best[later] - MARGIN:
                return True
        return False

    def _close(self, vertex: int) -> None:
        if self._closed[vertex]:
            return
        self._closed[vertex] = True
        self._window.remove(vertex)
        first = self._first[vertex]
        self._open[first] -= 1
        if not self._open[first]:
            del self._open[first]
