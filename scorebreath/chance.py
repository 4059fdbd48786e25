"""Keyed chance: a stream of random numbers for each purpose and place, so no draw depends on how many came before.

Keys come from the place in the text (a group's own words and which occurrence of them it is), so inserting a
sentence leaves every other group's draws unchanged.
"""

from __future__ import annotations

import hashlib

import numpy as np

ENGINE_SEEDS = 2**24
"""Engine controls are float32: integers are exact below this."""


def stream(seed: int, body: str, purpose: str, key: str) -> np.random.Generator:
    """A generator of its own for one purpose at one place.

    Args:
        seed: The Score's seed.
        body: Whose chance it is.
        purpose: What is drawn, e.g. `inspiration.length`.
        key: The place, e.g. a group's `place`.

    Returns:
        A numpy Generator over Philox; equal arguments give equal draws on every machine.
    """
    return np.random.Generator(np.random.Philox(key=int.from_bytes(_digest(seed, body, purpose, key)[:16], "little")))


def engine_seed(seed: int, body: str, purpose: str, key: str) -> int:
    """A seed for the engine's noise, in 1..2^24-1.

    >>> 1 <= engine_seed(0, "body", "noise", "hello#0") < ENGINE_SEEDS
    True
    """
    return int.from_bytes(_digest(seed, body, purpose, key)[:8], "little") % (ENGINE_SEEDS - 1) + 1


def _digest(seed: int, *parts: str) -> bytes:
    return hashlib.sha256("\x1f".join((str(seed), *parts)).encode("utf-8", "surrogatepass")).digest()
