"""Chance depends on its key alone."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath import chance

texts = st.text(max_size=10)


@given(st.integers(0, 2**63), texts, texts, texts)
def test_equal_keys_draw_equally_and_others_do_not(seed: int, body: str, purpose: str, key: str) -> None:
    first = chance.stream(seed, body, purpose, key).random(4)
    assert np.array_equal(first, chance.stream(seed, body, purpose, key).random(4))
    for other in ((seed + 1, body, purpose, key), (seed, body, purpose + "a", key), (seed, body, purpose, key + "a")):
        assert not np.array_equal(first, chance.stream(*other).random(4))
    assert 1 <= chance.engine_seed(seed, body, purpose, key) < 2**24


def test_the_draws_of_one_key_are_these_on_every_machine() -> None:
    assert chance.stream(1, "body", "test", "place#0").random(2).tolist() == pytest.approx(DRAWS, abs=0)
    assert chance.engine_seed(1, "body", "test", "place#0") == SEED


DRAWS = [0.5433397054180479, 0.44758676768580663]
SEED = 9378900
