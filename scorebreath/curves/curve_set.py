"""The curves of one body: any channels, at any times."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from scorebreath.curves.channels import CHANNELS, Channel
from scorebreath.curves.lips.visemes import VISEMES
from scorebreath.curves.moments import Moments
from scorebreath.curves.scenes import Scenes
from scorebreath.curves.sources import Sources
from scorebreath.curves.tracks import Array, Index
from scorebreath.errors import InputError
from scorebreath.score.document import Body, Score


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveSet:
    """Functions of time, ready to be sampled; immutable, made by `curves`."""

    body: str
    """whose curves they are"""
    duration: float
    """s, of the Score"""
    table: tuple[Channel, ...]
    """what each channel means"""
    scenes: Scenes
    """the body's events, as they hold between cuts"""
    closure_gate: bool = True
    """whether p, b and m shut the lips whatever else opens them; False: Cohen and Massaro's plain sum"""

    @property
    def channels(self) -> tuple[str, ...]:
        """Names, in the order of the columns."""
        return tuple(channel.name for channel in self.table)

    @property
    def sources(self) -> Sources:
        """The body's events as they hold until the first cut."""
        return self.scenes.sources(0)

    def sample(self, times: ArrayLike, names: Sequence[str] | None = None) -> Array:
        """Values at any times: any rate, any window, any order; each depends on its own time alone.

        Args:
            times: Seconds from the Score's start, (n,); before 0 and after the end is allowed.
            names: Channels wanted, in this order; all when left out.

        Returns:
            (n, channels) float64, in the units of `table`. Costs O(n log events + cuts among them).

        Raises:
            InputError: A name is no channel, or a time is not a finite number.
        """
        at = _moments(times)
        wanted = self.table if names is None else tuple(self.channel(name) for name in names)
        values = np.empty((len(at), len(wanted)))
        for rows, moments in self._epochs(at):
            for column, channel in enumerate(wanted):
                values[rows, column] = channel.at(moments)
        return values

    def contact(self, times: ArrayLike) -> Array:
        """Where p, b and m must hold the lips shut, with the closure gate or without: 1 there, ramps beside; (n,).

        Raises:
            InputError: A time is not a finite number.
        """
        at = _moments(times)
        values = np.empty(len(at))
        for rows, moments in self._epochs(at):
            values[rows] = moments.contact
        return values

    def visemes(self, times: ArrayLike) -> Array:
        """How much is shown of each of `lips.visemes.VISEMES`: (n, 15), adding up to 1.

        Raises:
            InputError: A time is not a finite number.
        """
        at = _moments(times)
        values = np.empty((len(at), len(VISEMES)))
        for rows, moments in self._epochs(at):
            values[rows] = moments.visemes
        return values

    def _epochs(self, at: Array) -> Iterator[tuple[slice | Index, Moments]]:
        """The times by the epochs they are in: which of them, and those moments."""
        if len(self.scenes) == 1:
            yield slice(None), self.scenes.moments(0, at, closure_gate=self.closure_gate)
            return
        number = np.searchsorted(self.scenes.cuts, at, side="right")
        order = np.argsort(number, kind="stable")
        for rows in np.split(order, np.flatnonzero(np.diff(number[order])) + 1):
            if rows.size:
                yield rows, self.scenes.moments(int(number[rows[0]]), at[rows], closure_gate=self.closure_gate)

    def channel(self, name: str) -> Channel:
        """The table's row of that name.

        Raises:
            InputError: There is none.
        """
        for channel in self.table:
            if channel.name == name:
                return channel
        raise InputError(f"no channel is called {name!r}; expected one of {', '.join(self.channels)}")


def _moments(times: ArrayLike) -> Array:
    at = np.atleast_1d(np.asarray(times, dtype=np.float64))
    if at.ndim != 1 or not np.all(np.isfinite(at)):
        raise InputError("times must be finite numbers in one dimension")
    return np.ascontiguousarray(at)


def curves(score: Score, body: str | None = None, *, closure_gate: bool = True, since: float = -math.inf) -> CurveSet:
    """The curves of one body of a Score.

    They are closed forms of the events: an event changes nothing outside `[onset - lead, end + lag]`, and outside
    any breath the lungs are at the body's resting volume. A cut changes nothing before its onset; behind it the lungs
    go on from the volume there is, and everything else from where it was (`epochs`, `settling`).

    Args:
        score: Any Score; it is read once, in time linear in its events.
        body: Whose curves; may be left out where the Score has one body.
        closure_gate: Whether p, b and m shut the lips whatever else opens them.
        since: s; what is cut off before is looked at when it is sampled, not now: a performance samples its present.

    Raises:
        InputError: There is no such body, or it must be named.
        ScoreError: Breaths or utterances of the body overlap, or an event leaves its own reach.
    """
    chosen = _choose(score, body)
    scenes = Scenes(score, chosen)
    for number in range(int(np.searchsorted(scenes.cuts, since, side="right")), len(scenes)):
        scenes.sources(number)
    return CurveSet(
        body=chosen.id,
        duration=score.duration,
        table=CHANNELS,
        scenes=scenes,
        closure_gate=closure_gate,
    )


def _choose(score: Score, body: str | None) -> Body:
    names = ", ".join(repr(each.id) for each in score.bodies) or "none"
    if body is None:
        if len(score.bodies) != 1:
            raise InputError(f"whose curves? expected body= (or --body) to name one of the score's bodies, {names}")
        return score.bodies[0]
    for each in score.bodies:
        if each.id == body:
            return each
    raise InputError(f"body={body!r} is not in the score; expected one of {names}")
