"""A picture leaves no memory behind: a batch draws thousands."""

from __future__ import annotations

import gc
import io
import weakref
from typing import Any

import pytest

from scorebreath.report import sheet


def test_the_pixels_of_a_picture_go_with_it(monkeypatch: pytest.MonkeyPatch) -> None:
    from matplotlib.backends import backend_agg

    renderers: list[weakref.ref[Any]] = []

    class Watched(backend_agg.RendererAgg):
        def __init__(self, *arguments: Any) -> None:
            super().__init__(*arguments)  # type: ignore[no-untyped-call]
            renderers.append(weakref.ref(self))

    monkeypatch.setattr(backend_agg, "RendererAgg", Watched)
    gc.collect()
    gc.disable()
    try:
        drawn = sheet.Sheet(200, 100, "#ffffff")
        drawn.area([10, 90], 20, 40, "#ff0000")
        drawn.line([10, 90], 50, "#00ff00", 2)
        drawn.text(10, 80, "word", 12, "#000000", align="right")
        drawn.png(io.BytesIO())
        assert len(renderers) == 1
        assert renderers[0]() is None
    finally:
        gc.enable()
