"""A screen that is drawn ten times a second, on stderr; elsewhere than on a terminal that can, there is none."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from types import TracebackType
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from rich.live import Live
    from rich.text import Text

EVERY = 0.1
"""s"""
LEAST = (20, 5)
"""Columns and rows below which nothing is drawn."""
Draw = Callable[[int, int, bool], "Sequence[Text]"]
"""Rows for so many columns and rows; whether the terminal has more than ASCII."""


def can_draw() -> bool:
    """Whether stderr is a terminal that a screen can be drawn on."""
    return sys.stderr.isatty() and os.environ.get("TERM", "") not in (("", "dumb") if os.name != "nt" else ("dumb",))


class Screen:
    """Draws when it is time to; a context manager.

    Args:
        draw: What.
    """

    def __init__(self, draw: Draw) -> None:
        """Nothing is drawn yet."""
        from rich.console import Console

        self._draw = draw
        self._console = Console(stderr=True, highlight=False, emoji=False, markup=False)
        self._unicode = (sys.stderr.encoding or "").lower().replace("-", "") == "utf8"
        self._live: Live | None = None
        self._next = 0.0

    def __enter__(self) -> Self:
        """Take the screen; what was there comes back at the end."""
        from rich.live import Live

        self._live = Live(
            console=self._console, screen=True, auto_refresh=False, redirect_stdout=False, redirect_stderr=False,
            vertical_overflow="crop",
        )  # fmt: skip
        self._live.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """Give it back."""
        live, self._live = self._live, None
        if live is not None:
            with suppress(OSError):  # the terminal is gone
                live.stop()

    def refresh(self, *, now: bool = False) -> None:
        """Draw, if it is time to."""
        if self._live is None or (time.monotonic() < self._next and not now):
            return
        self._next = time.monotonic() + EVERY
        from rich.console import Group

        width, height = self._console.size
        if width < LEAST[0] or height < LEAST[1]:
            return
        try:
            self._live.update(Group(*self._draw(width, height, self._unicode)), refresh=True)
        except OSError:  # the terminal is gone; what is performed goes on until its hangup is told
            self._live = None
