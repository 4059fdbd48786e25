"""The ledger: it only grows, names nothing twice, and its curves are those of the whole performance."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.live import ledger as module
from scorebreath.live.ledger import Ledger
from scorebreath.score.document import Score
from scorebreath.score.events import Marker
from scorebreath.score.take import TakeWriter, read_take
from tests.live.rehearsals import rehearse
from tests.live.stages import Stage


def marker(onset: float, name: str = "here") -> Marker:
    return Marker(id=name, body="body", onset=onset, duration=0.0, name=name)


@pytest.fixture
def empty() -> Score:
    return Stage().ledger.score()


def test_an_id_that_is_taken_gets_a_number(empty: Score) -> None:
    ledger = Ledger(empty)
    written = [event.id for _ in range(3) for event in ledger.events([marker(0.0)], 0.0)]
    assert written == ["here", "here~2", "here~3"]
    assert [event.id for event in ledger.score().events if event.type == "marker"] == written


def test_what_can_be_seen_is_written(empty: Score, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever has seen something happen finds it in the take, though the performer was killed right then."""
    with TakeWriter(tmp_path, empty) as take:
        ledger = Ledger(empty, take)
        seen: list[int] = []
        monkeypatch.setattr(take, "_line", lambda _: seen.append(len(ledger.score().text + str(ledger.score().events))))
        before = len(ledger.score().text + str(ledger.score().events))
        ledger.text("Good evening.")
        assert seen == [before]
        between = len(ledger.score().text + str(ledger.score().events))
        ledger.events([marker(1.0)], 0.0)
        assert seen == [before, between]


def test_a_long_performance_lies_on_the_disk(empty: Score, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST", 100)
    with TakeWriter(tmp_path, empty) as take:
        ledger = Ledger(empty, take)
        for number in range(500):
            ledger.events([marker(float(number))], float(number))
        score = ledger.score()
        assert ledger.events([marker(1000.0)], 1000.0)[0].id == "here~501"
    assert len(score.events) == 500
    assert score.events == read_take(tmp_path).events[:500]
    assert len(ledger._events) <= 101


@pytest.mark.parametrize("seed", [20, 21])
def test_curves_of_the_present_are_those_of_the_whole(seed: int) -> None:
    """Also where much was cut: the window that is kept leaves nothing out."""
    stage = rehearse(seed, orders=40, length=60.0).stage
    score = stage.score()
    final = curves(score)
    kept: list[object] = []
    for now in np.arange(5.0, score.duration, 7.3):
        window = module._window([*score.events], float(now) - module.KEPT)
        kept.append(len(window))
        times = now + np.array([-2.0, -0.5, 0.0, 0.4])
        near = curves(stage.ledger.part("body", window)).sample(times)
        whole = final.sample(times)
        weight = final.channels.index("weight")
        assert np.array_equal(np.delete(near, weight, axis=1), np.delete(whole, weight, axis=1)), now
