"""One body's epochs, each made into arrays when it is first asked for, and how each goes on from the one before."""

from __future__ import annotations

from functools import partial

import numpy as np

from scorebreath.curves.breathing import FACTORS
from scorebreath.curves.epochs import Epochs, Known, barriers, epochs
from scorebreath.curves.moments import Moments
from scorebreath.curves.settling import MOVEMENTS, Found, found, settled
from scorebreath.curves.sources import Sources, levels, sources
from scorebreath.curves.tracks import TOUCH, Acts, Array
from scorebreath.score.acting import EMOTIONS
from scorebreath.score.document import Body, Score
from scorebreath.score.events import Emotion, Event, Expiration, Hold, Inspiration
from scorebreath.score.values import LARGEST
from scorebreath.units import snap


class Scenes:
    """What a body does, epoch after epoch; one epoch, where nothing is cut."""

    def __init__(self, score: Score, body: Body) -> None:
        """Divide the Score at its cuts.

        Raises:
            ScoreError: Events contradict each other, or leave their own reach.
        """
        self._body = body
        self._duration = score.duration
        self._heard = levels(score, body)
        cuts = barriers(score, body.id)
        self._epochs: Epochs | None = epochs(score, body.id, cuts) if cuts else None
        parts: tuple[Acts, ...] = (score,) if self._epochs is None else self._epochs.known
        self._acts = parts
        self._sources: list[Sources | None] = [None] * len(parts)
        self._found: dict[tuple[str, bool], dict[int, Found]] = {}
        self._edges: dict[tuple[int, bool], tuple[Moments, Moments]] = {}
        felt = {event.name for event in score.of(Emotion, body.id)}
        self._still = frozenset(
            f"{kind}_{name}" for name in EMOTIONS if name not in felt for kind in ("emotion", "leaning")
        )
        self.cuts = np.array([] if self._epochs is None else self._epochs.cuts, dtype=np.float64)
        """(epochs - 1,) s, ascending"""

    def __len__(self) -> int:
        """How many epochs."""
        return len(self._acts)

    def window(self, number: int) -> tuple[float, float]:
        """From when to when an epoch is, s; the end is not in it."""
        return (-np.inf, np.inf) if self._epochs is None else self._epochs.window(number)

    def sources(self, number: int) -> Sources:
        """An epoch as arrays.

        Raises:
            ScoreError: Its events contradict each other, or leave their own reach.
        """
        first = number
        while first and self._sources[first - 1] is None and self._breathless(first):
            first -= 1  # the volume that is held comes from there
        for each in range(first, number + 1):
            if self._sources[each] is None:
                self._sources[each] = self._read(each)
        return self._sources[number]  # type: ignore[return-value]

    def moments(self, number: int, times: Array, *, closure_gate: bool) -> Moments:
        """Some moments of an epoch, (n,) s."""
        settle = partial(self._settle, number, closure_gate) if number else None
        return Moments(self.sources(number), times, closure_gate=closure_gate, settle=settle)

    def _read(self, number: int) -> Sources:
        acts = self._acts[number]
        if number and self._breathless(number):
            acts = self._held(number, acts)
        return sources(acts, self._body, self._duration, self._heard)

    def _breathless(self, number: int) -> bool:
        """Whether nothing breathes where an epoch begins."""
        cut = float(self.cuts[number - 1])
        return not any(
            e.onset <= cut + TOUCH and snap(e.end) > cut + TOUCH
            for e in self._acts[number].events
            if isinstance(e, Inspiration | Expiration | Hold)
        )

    def _held(self, number: int, acts: Acts) -> Acts:
        """The events of an epoch, and a breath that is held until the next one, where the cut left one under way."""
        cut = float(self.cuts[number - 1])
        before = self.sources(number - 1).breathing
        at = before.locate(np.array([cut]))
        if not at.active[0]:
            return acts
        event = before.track.events[int(at.event[0])]
        if snap(event.end) <= cut + TOUCH:
            return acts
        breaths = (e for e in acts.events if isinstance(e, Inspiration | Expiration | Hold) and e.duration > 0)
        until = min((e.onset for e in breaths if e.onset > cut), default=LARGEST)
        held: Event = Hold(
            id=f"{event.id} held", body=self._body.id, onset=cut, duration=snap(until - cut),
            volume=snap(float(before.volume(at)[0])), thorax_share=event.thorax_share, motion=event.motion,
        )  # fmt: skip
        return Known((*acts.events, held))

    def _settle(self, number: int, closure_gate: bool, name: str, times: Array, values: Array) -> Array:
        movement = MOVEMENTS[name]
        if name in self._still or not np.any(times - self.cuts[number - 1] < movement.reach):
            return values
        return settled(movement, self._at_cut(number, name, closure_gate=closure_gate), times, values)

    def _at_cut(self, number: int, name: str, *, closure_gate: bool) -> Found:
        """A movement where an epoch begins; of those before it first, as far as they reach: not by recursion."""
        known = self._found.setdefault((name, closure_gate), {})
        first, reach = number, MOVEMENTS[name].reach
        while first > 1 and first - 1 not in known and self.cuts[first - 1] - self.cuts[first - 2] < reach:
            first -= 1
        for each in range(first, number + 1):
            if each not in known:
                before, behind = self._edge(each, closure_gate=closure_gate)
                new = behind.movement(name)
                old = before.movement(name) if name not in FACTORS or before.breathes else new
                known[each] = found(float(before.times[0]), old, new)
        return known[number]

    def _edge(self, number: int, *, closure_gate: bool) -> tuple[Moments, Moments]:
        """The moment at which an epoch begins, as the one before has it, and as it would be by itself."""
        key = number, closure_gate
        if key not in self._edges:
            cut = self.cuts[number - 1 : number]
            old = self.moments(number - 1, cut, closure_gate=closure_gate)
            self._edges[key] = old, Moments(self.sources(number), cut, closure_gate=closure_gate)
        return self._edges[key]
