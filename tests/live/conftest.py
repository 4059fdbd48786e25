"""A stage on which somebody speaks, and the desk before it."""

from __future__ import annotations

import pytest

from scorebreath.live.console import Console
from tests.live.acting import SAYING
from tests.live.stages import Stage


@pytest.fixture
def stage() -> Stage:
    return Stage(step=0.02)


@pytest.fixture
def desk(stage: Stage) -> Console:
    desk = Console(stage.performance)
    desk.say(SAYING)
    return desk
