"""Nobody breathes at the same places twice: chance moves the weight of boundaries and the length of groups."""

from __future__ import annotations

from collections import OrderedDict, deque
from math import exp, log

from scorebreath import chance
from scorebreath.planning.units import Unit

CONTEXT = 6
"""Words of its sentence before a place that name it."""
REMEMBERED = 100_000
"""Places whose occurrences are remembered; the oldest are forgotten, so that memory stays bounded."""
EULER = 0.5772156649015329
"""Mean of the standard Gumbel distribution."""
TINY = 1e-12
"""Uniform draws keep so far from 0 and 1, where the Gumbel distribution is endless."""


class Variation:
    """Draws for the boundaries of one text, in order.

    A draw depends on the last words of the sentence before the place, and on how often they occurred: inserting a
    sentence elsewhere leaves it. Gumbel: the cheapest of places with costs :math:`c_i` so perturbed is place i with a
    probability that goes with :math:`e^{-c_i / scale}` (the costs are negative logarithms of probabilities).

    Args:
        seed: The Score's.
        body: Whose chance it is.
        scale: Of the draws for boundaries, in the units of the costs; 0: none.
        spread: Sigma of the lognormal draws for lengths; 0: none.
    """

    def __init__(self, seed: int, body: str, scale: float, spread: float) -> None:
        """Stand before the text."""
        self._seed = seed
        self._body = body
        self._scale = scale
        self._spread = spread
        self._words: deque[str] = deque(maxlen=CONTEXT)
        self._met: OrderedDict[str, int] = OrderedDict()

    def after(self, unit: Unit) -> tuple[float, float]:
        """The draws for the place behind the next unit.

        Returns:
            What a breath costs more there, 0 in the mean; and x preferred length of a group that begins there, 1 in
            the median.
        """
        self._words.extend(word.text for word in unit.words)
        words = " ".join(self._words)
        if unit.closes or unit.edge == "paragraph":
            self._words.clear()
        if not self._scale and not self._spread:
            return 0.0, 1.0
        occurrence = self._met.pop(words, -1) + 1
        self._met[words] = occurrence
        if len(self._met) > REMEMBERED:
            self._met.popitem(last=False)
        drawn = chance.stream(self._seed, self._body, "cut", f"{words}#{occurrence}")
        uniform, normal = float(drawn.random()), float(drawn.normal())
        gumbel = -log(-log(min(max(uniform, TINY), 1.0 - TINY)))
        return self._scale * (EULER - gumbel), exp(self._spread * max(-2.0, min(2.0, normal)))
