"""Pictures for the tests of streams."""

from __future__ import annotations

import dataclasses
from functools import cache

from scorebreath.curves.curve_set import CurveSet, curves
from scorebreath.live.picture import Picture
from scorebreath.score.events import Event
from tests.curves.faces import only, whole_face

START = 1_795_459_200.25
"""Unix time of second 0."""


@cache
def whole() -> CurveSet:
    """Curves of a Score in which everything moves."""
    return curves(whole_face())


def picture(
    time: float = 1.5, *, shown: CurveSet | None = None, body: str = "body", name: str = "scorebreath"
) -> Picture:
    return Picture(
        body=body, name=name, time=time, unix=START + time, number=round(time * 60), curves=shown or whole(),
    )  # fmt: skip


def of(*events: Event, time: float) -> Picture:
    """A moment of a Score of those events alone."""
    return picture(time, shown=curves(only(*events)))


def named(body: str) -> CurveSet:
    return dataclasses.replace(whole(), body=body)
