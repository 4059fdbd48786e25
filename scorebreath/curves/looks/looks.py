"""What the events of the face come to at any time, each kind by itself; `curves.channels` puts them together.

Every event is a closed form of time that is 0 outside its own time; a moment's value depends on that moment alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from scorebreath.curves.looks.layers import Layers, layers
from scorebreath.curves.tracks import Acts, Array, Track, track
from scorebreath.equations.shapes import ramp, rise_and_fall, smooth_step, trapezoid
from scorebreath.score.events import Blink, Brow, Emotion, Gaze, Head

LEAN = 0.45
"""s in which a head takes on the whole pose of an emotion, at least: 4 degrees beside a nod of 48 deg/s (e)"""
Shape = Callable[[Array, Array, Array, Array], Array]


@dataclass(frozen=True, slots=True, kw_only=True)
class Looks:
    """A body's events of the face as arrays, ready to be sampled."""

    _blinks: Layers
    """close, hold, open, left, right"""
    _brows: Layers
    """rise, hold, fall, left, right, frown"""
    _heads: Layers
    """rise, hold, fall, pitch, yaw, roll"""
    _gaze: Track[Gaze]
    _glances: Array
    """(5, gaze events): from yaw, from pitch, yaw, pitch, move"""
    _emotions: Mapping[str, Layers]
    """rise, hold (0), fall, intensity; by name"""

    def blinks(self, times: Array) -> Array:
        """How far the lids are closed by blinks, left and right: (n, 2) in 0..1; the further one counts."""
        return _highest(self._blinks, times, 2, rise_and_fall)

    def brows(self, times: Array) -> Array:
        """Raise of the left and the right brow, and frown: (n, 3) in 0..1; of several events the highest of each."""
        return _highest(self._brows, times, 3, rise_and_fall)

    def head(self, times: Array) -> Array:
        """Pitch, yaw and roll, all head events together, without breath and emotion: (n, 3) degrees."""
        turned = np.zeros((len(self._heads.layers), len(times), 3))
        for layer, (at, since, numbers) in enumerate(self._heads.under_way(times)):
            turned[layer, at] = (numbers[3:] * rise_and_fall(since, *numbers[:3])).T
        # In order of their size: which layer an event lies in must not change the last bit of a sum.
        return np.asarray(np.sort(turned, axis=0).sum(axis=0))

    def gaze(self, times: Array) -> Array:
        """Where the eyes look in the chest's frame, yaw and pitch: (n, 2) degrees; (0, 0) outside any gaze event."""
        looked = np.zeros((len(times), 2))
        index, found = self._gaze.at(times)
        at, index = np.flatnonzero(found), index[found]
        before, after, move = self._glances[:2, index], self._glances[2:4, index], self._glances[4, index]
        gone = smooth_step(ramp(times[at] - self._gaze.start[index], move))
        looked[at] = (before + (after - before) * gone).T
        return looked

    def emotion(self, name: str, times: Array) -> Array:
        """Intensity of an emotion: (n,) in 0..1; straight ramps (A41), equal emotions take the higher one (Y5)."""
        found = self._emotions.get(name)
        return np.zeros(len(times)) if found is None else _highest(found, times, 1, trapezoid)[:, 0]

    def leaning(self, name: str, times: Array) -> Array:
        """How much of an emotion is in the head's pose: its intensity, but no faster than a head goes; (n,) in 0..1."""
        found = self._emotions.get(name)
        return np.zeros(len(times)) if found is None else _highest(found, times, 1, _leaning)[:, 0]


def _leaning(time: Array, rise: Array, hold: Array, fall: Array) -> Array:
    slow = np.minimum(ramp(time, LEAN), ramp(rise + hold + fall - time, LEAN))
    return np.minimum(trapezoid(time, rise, hold, fall), slow)


def looks(score: Acts, body: str) -> Looks:
    """Gather the face's events of one body.

    Raises:
        ScoreError: Gaze events overlap: eyes look at one thing at a time.
    """
    mine = [event for event in score.events if event.body == body]
    gaze = track([e for e in mine if isinstance(e, Gaze)], "gaze events")
    emotions: dict[str, list[Emotion]] = {}
    for event in mine:
        if isinstance(event, Emotion):
            emotions.setdefault(event.name, []).append(event)
    return Looks(
        _blinks=layers(
            [e for e in mine if isinstance(e, Blink)], lambda e: (e.close, e.hold, e.open, e.left, e.right)
        ),
        _brows=layers(
            [e for e in mine if isinstance(e, Brow)], lambda e: (*_movement(e), e.left, e.right, e.frown)
        ),
        _heads=layers([e for e in mine if isinstance(e, Head)], lambda e: (*_movement(e), e.pitch, e.yaw, e.roll)),
        _gaze=gaze,
        _glances=np.array(
            [(e.from_yaw, e.from_pitch, e.yaw, e.pitch, e.move) for e in gaze.events], dtype=np.float64
        ).reshape(-1, 5).T,
        _emotions=MappingProxyType(
            {
                name: layers(felt, lambda e: (e.apex, 0.0, max(0.0, e.duration - e.apex), e.intensity))
                for name, felt in emotions.items()
            }
        ),
    )  # fmt: skip


def _movement(event: Brow | Head) -> tuple[float, float, float]:
    """Its rise, hold and fall, s."""
    return event.apex, event.hold, max(0.0, event.duration - event.apex - event.hold)


def _highest(events: Layers, times: Array, columns: int, shape: Shape) -> Array:
    """The highest of all that is under way, each column by itself: (n, columns)."""
    value = np.zeros((len(times), columns))
    for at, since, numbers in events.under_way(times):
        moved = (numbers[3:] * shape(since, *numbers[:3])).T
        value[at] = np.maximum(value[at], moved)
    return value
