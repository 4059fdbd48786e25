"""The end of a performance: decided while the last words are still to be heard, and open until it is there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scorebreath.live.desk import OverError
from scorebreath.live.interrupting import interrupt
from scorebreath.score.performing import GIVES_WAY
from scorebreath.units import snap

if TYPE_CHECKING:
    from scorebreath.live.performance import Performance

FADE = 0.1
"""s in which the sound of a breath fades that gives way."""


class Closing:
    """Decides the end, and takes that back.

    Args:
        tail: s after the last body has come to rest.
    """

    def __init__(self, tail: float) -> None:
        """Nothing is decided."""
        self._tail = tail
        self._said = 0.0  # s; when the last word is over

    def decide(self, performance: Performance) -> None:
        """Everybody comes to rest, and all is over."""
        at = snap(max(performance.line, performance.shown, performance.now + performance.timing.reaction))
        for who in performance.company.performers:
            if who.state.body in performance.resting:
                interrupt(performance, who, at, fade=FADE, rule=GIVES_WAY)
        self._said = performance.line
        over = performance.company.ensemble.finish(self._tail)
        performance.decisions.decide(performance.company.drain())
        performance.over = over
        performance.ledger.end(over)

    def take_back(self, performance: Performance) -> None:
        """There is more: what was placed behind the last word gives way.

        Raises:
            OverError: It comes too late.
        """
        if performance.is_over:
            raise OverError
        if performance.over is None:
            return
        at = snap(max(self._said, performance.now + performance.timing.reaction))
        performance.over = None
        performance.ledger.go_on()
        for who in performance.company.performers:
            interrupt(performance, who, at, fade=FADE, rule=GIVES_WAY)
        performance.company.ensemble.clock = at
