"""Draws for one place in the text: each purpose has its own stream, so none depends on another."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log, sqrt

from scorebreath import chance


@dataclass(frozen=True, slots=True, kw_only=True)
class Chances:
    """What is drawn at one place."""

    seed: int
    body: str
    place: str

    def normal(self, purpose: str) -> float:
        """A draw of mean 0 and standard deviation 1."""
        return float(chance.stream(self.seed, self.body, purpose, self.place).normal())

    def share(self, purpose: str) -> float:
        """A draw from 0 to 1, all equally likely."""
        return float(chance.stream(self.seed, self.body, purpose, self.place).random())

    def between(self, purpose: str, low: float, high: float) -> float:
        """A draw from a range."""
        return low + (high - low) * self.share(purpose)

    def about(self, purpose: str, mean: float, variation: float) -> float:
        """A lognormal draw with that mean and coefficient of variation: never below 0, now and then much above.

        >>> Chances(seed=0, body="b", place="p").about("x", 0.6, 0.0)
        0.6
        """
        if variation <= 0 or mean <= 0:
            return mean
        return mean * lognormal(self.normal(purpose), variation)

    def happens(self, purpose: str, probability: float) -> bool:
        """Whether something of that probability happens."""
        return probability > 0 and self.share(purpose) < probability

    def noise(self, purpose: str) -> int:
        """A seed for the engine's noise."""
        return chance.engine_seed(self.seed, self.body, purpose, self.place)


def lognormal(normal: float, variation: float) -> float:
    r"""A factor of mean 1: :math:`e^{\sigma z - \sigma^2/2}` with :math:`\sigma^2 = \ln(1 + v^2)`.

    Args:
        normal: :math:`z`, a normal draw.
        variation: :math:`v`, the coefficient of variation.

    >>> round(lognormal(0.0, 0.2), 4), round(lognormal(1.0, 0.2), 4)
    (0.9806, 1.1953)
    """
    sigma = sqrt(log(1.0 + variation**2))
    return exp(sigma * normal - sigma**2 / 2.0)
