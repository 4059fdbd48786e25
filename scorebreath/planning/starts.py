"""What a breath carries, and what a group of so many syllables costs from a start (physiology 1.1, 1.5, 2.2)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, exp, inf, log

from scorebreath.parameters.table import Parameters

SPREAD = 0.65
"""Sigma of the lognormal cost of a group's length. Measured groups spread by 0.385 (physiology 1.1), but those are
outcomes, and the cheapest plan keeps clear of the tails: a milder cost makes its groups spread as widely."""
BUDGET = 0.6
"""Share of the preferred length from which on a boundary is passed at a cost, if nobody says another one
(physiology 1.2)."""
EASY = 0.27
"""Vital capacity that a breath uses with ease: from 52 % (usual initiation) to 25 % (lowest termination;
physiology 2.2)."""
DEEPER = 0.05
"""Standard deviation of what deeper breaths take on top (physiology 2.2: SD of the initiation)."""
HIGHEST = (0.65, 0.85)
"""Where speech begins at most, fraction of VC: in comfort, and with all that a loud voice adds (physiology 2.2)."""
LOWEST = (0.25, 0.20)
"""Where it ends at least: in comfort, and with all that a lower posture or a soft voice takes (physiology 2.2)."""
MUCH = 0.24
"""Vital capacity beyond which a group tires: the next one is still recovering (half again of the usual 0.16)."""
RECOVERY = 0.8
"""What recovering costs a group that uses an easy breath or more; a shorter one in proportion. The next group then
tends to be shorter, and its breath is not skipped."""
LONGEST = 12.5
"""Seconds from the inspiration's onset to the last phone (physiology 1.1; B52: 12.6)."""
RATE = 5.0
"""Syllables a second at prosody_rate 1 (physiology 1.1)."""
CAPACITY_EXPONENT = 0.15
"""How groups grow with `capacity_lung`: hardly (DiVA su-182407: no significant relation in 8 people; the papers have
the square root, B37)."""
RATE_EXPONENT = 0.7
"""How they grow with the speaking rate: 1.3 times as fast gives 1.2 times the syllables (physiology 1.5)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Start:
    """The body where a group begins: what groups cost from there. Two starts are the same only if they are one."""

    preferred: float
    """syllables"""
    fresh: tuple[float, ...]
    """cost of a group of n syllables, for n up to the most one breath can hold; shape (most + 1,)"""
    tired: tuple[float, ...]
    """the same while recovering: as much or more, the same shape"""
    budget: int
    """syllables from which on boundaries are passed at a cost; whole, as syllables are: sums with it are exact"""
    much: int
    """syllables beyond which the next group is recovering"""
    most: int
    """syllables one breath holds"""

    @property
    def recovery(self) -> float:
        """The most that recovering can cost."""
        return max(after - before for after, before in zip(self.tired, self.fresh, strict=True))

    def length(self, recovering: bool) -> tuple[float, ...]:
        """Cost by syllables."""
        return self.tired if recovering else self.fresh


def start(preferred: float, most: int, volume: float, *, spread: float = SPREAD, budget: float = BUDGET) -> Start:
    """A start.

    Args:
        preferred: Syllables.
        most: Syllables one breath holds.
        volume: Of one syllable, fraction of the person's vital capacity.
        spread: Sigma of the lognormal cost of a group's length.
        budget: Share of `preferred` from which on boundaries are passed at a cost.
    """
    fresh = length_costs(preferred, most, volume, spread)
    tired = (cost + RECOVERY * min(1.0, n * volume / EASY) for n, cost in enumerate(fresh))
    return Start(
        preferred=preferred,
        fresh=tuple(fresh),
        tired=tuple(tired),
        budget=ceil(budget * preferred),
        much=int(MUCH / volume),
        most=most,
    )


def length_costs(preferred: float, most: int, volume: float, spread: float = SPREAD) -> list[float]:
    r"""Cost of groups of 0 to `most` syllables, each taking `volume` of the lungs.

    :math:`\ln^2(n / m) / 2 \sigma^2`, with the median :math:`m = preferred \cdot e^{-\sigma^2 / 2}` that makes
    `preferred` the mean; beyond an easy breath also :math:`(n \cdot volume - EASY)^2 / 2 \cdot DEEPER^2`.

    >>> costs = length_costs(18.0, 44, 0.009)
    >>> costs.index(min(costs)), round(costs[8], 2), round(costs[30], 2), round(costs[41], 2)
    (15, 0.43, 0.62, 3.23)
    """
    median = preferred * exp(-(spread**2) / 2.0)
    return [
        (log(max(1, n) / median) / spread) ** 2 / 2.0 + (max(0.0, n * volume - EASY) / DEEPER) ** 2 / 2.0
        for n in range(most + 1)
    ]


def preferred_syllables(p: Parameters, factor: float = 1.0, rate: float = 1.0, frequency: float = 1.0) -> float:
    """Syllables that a group has by preference, 1 to 100.

    Args:
        p: `length_utterance` set by hand stands; else `norm_syllables`, `capacity_lung` and `prosody_rate` count.
        factor: Of the person and of the moment (`Modifiers.syllables`).
        rate: Speaking rate that the markup asks for.
        frequency: Of breaths, that the markup asks for.

    >>> preferred_syllables(Parameters()), preferred_syllables(Parameters(length_utterance=30.0), 0.5, 1.0, 2.0)
    (18.0, 15.0)
    >>> round(preferred_syllables(Parameters(prosody_rate=1.3)), 1), round(preferred_syllables(Parameters(), 0.8), 1)
    (21.6, 14.4)
    """
    if p.length_utterance is not None:
        syllables = p.length_utterance
    else:
        size = (p.capacity_lung / 100.0) ** CAPACITY_EXPONENT
        syllables = p.norm_syllables * size * (p.prosody_rate * rate) ** RATE_EXPONENT * factor
    return min(100.0, max(1.0, syllables / frequency))


def most_syllables(p: Parameters, volume: float = 1.0, shift: float = 0.0, rate: float = 1.0) -> int:
    """Syllables one breath holds: as many as the lungs, or the longest group, allow; at least 1.

    Args:
        p: The parameters.
        volume: x volume spent on a syllable (`Modifiers.volume`).
        shift: Of the levels at which speech begins and ends (`Modifiers.start`).
        rate: Speaking rate that the markup asks for.

    >>> most_syllables(Parameters()), most_syllables(Parameters(capacity_lung=64.0))
    (44, 28)
    >>> most_syllables(Parameters(volume_per_syllable=0.001))
    57
    """
    highest = min(HIGHEST[1], HIGHEST[0] + shift)
    lowest = max(LOWEST[1], LOWEST[0] + min(0.0, shift))
    by_volume = (highest - lowest + 1e-9) / (volume * syllable_volume(p))
    by_time = (LONGEST - p.inspiration_base - p.silence_after_breath) / (
        1.0 / (RATE * p.prosody_rate * rate) + p.inspiration_per_syllable
    )
    return max(1, int(min(by_volume, by_time)))


def syllable_volume(p: Parameters) -> float:
    """What one syllable takes of the person's own vital capacity, as a fraction.

    >>> syllable_volume(Parameters(capacity_lung=50.0))
    0.018
    """
    return p.volume_per_syllable * 100.0 / p.capacity_lung


@lru_cache(maxsize=8192)
def worst(here: Start, here_recovering: bool, there: Start, there_recovering: bool, more: int) -> tuple[float, ...]:
    """How much dearer a group can be if it begins at another place, whatever is still added to it.

    Args:
        here: Where it would begin.
        here_recovering: Whether the body recovers there.
        there: The other place.
        there_recovering: The same there.
        more: Syllables between: positive for an earlier place, negative for a later one.

    Returns:
        For each n, the most over groups of n syllables or more from `here` (and the group after it, if only a group
        from `there` tires); shape (here.most + 2,). An earlier place counts as far as one breath reaches from there;
        a later one that does not reach far enough is infinitely dearer; -infinity where there is no such group.

    >>> one = start(5.0, 9, 0.01)
    >>> [round(cost, 2) for cost in worst(one, False, one, False, -1)[-3:]], worst(one, False, one, False, 9)[1]
    ([-0.19, -0.21, -inf], -inf)
    """
    ours, theirs = here.length(here_recovering), there.length(there_recovering)
    furthest, much, tiring = there.most, here.much, there.much
    row = [-inf] * (here.most + 2)
    dearest = -inf
    for n in range(here.most, 0, -1):
        other = n + more
        if 1 <= other <= furthest:
            cost = theirs[other] - ours[n] + (RECOVERY if other > tiring and n <= much else 0.0)
            dearest = max(dearest, cost)
        elif more < 0:
            dearest = inf
        row[n] = dearest
    row[0] = row[1]
    return tuple(row)
