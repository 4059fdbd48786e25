"""A Score as it was performed: with its cuts carried out, for whoever counts, lists or writes down what happened."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from scorebreath.curves.strokes import strokes
from scorebreath.curves.tracks import track
from scorebreath.score.cutting import Ending, beginning, endings
from scorebreath.score.document import Score
from scorebreath.score.events import (
    Blink,
    Brow,
    Cut,
    Emotion,
    Event,
    Expiration,
    Gaze,
    Head,
    Hold,
    Inspiration,
    Noise,
    Trapezoid,
    Utterance,
)
from scorebreath.units import snap


def performed(score: Score) -> Score:
    """The Score without its cuts: what they end is as long as it lasted, what never happened is gone.

    Its curves are not quite those of the Score: nothing fades out in it, and nothing was to come when it was cut.

    Args:
        score: Any Score; one without cuts is itself.
    """
    if not any(isinstance(event, Cut) for event in score.events):
        return score
    ends = endings(score.events)
    left = (_until(event, ends.get(event.id)) for event in score.events if not isinstance(event, Cut))
    return replace(score, events=tuple(event for event in left if event is not None))


def _until(event: Event, ending: Ending | None) -> Event | None:
    if ending is None:
        return event
    if ending.prevents(event):
        return None
    return _shortened(event, ending.time) if ending.shortens(event) else event


def _shortened(event: Event, time: float) -> Event:
    if isinstance(event, Utterance):
        return beginning(event, time)
    length = snap(time - event.onset)
    parts = _PARTS.get(event.type)
    return replace(event, duration=length, **({} if parts is None else parts(event, length)))


def _breath(event: Inspiration | Expiration, length: float) -> dict[str, Any]:
    """The air that had moved, and as much of face and noise as fits."""
    moving: Inspiration | Expiration | Hold = event
    all_strokes = strokes(track([moving], "breaths"))
    first = np.zeros(1, dtype=np.intp)
    moved = float(all_strokes.moved(first, *all_strokes.at(first, np.array([event.onset + length])))[0])
    changed: dict[str, Any] = {
        "to_volume": snap(event.from_volume + (event.to_volume - event.from_volume) * moved),
        "face": None if event.face is None else _trapezoid(event.face, length),
    }
    room = length
    if isinstance(event, Inspiration):
        changed["saccades"] = max(1, round(event.saccades * length / event.duration))
    else:
        changed["puffs"] = tuple(puff for puff in event.puffs if puff < length)
        room = snap(length - changed["puffs"][-1]) if changed["puffs"] else length
    return {**changed, "noise": _noise(event.noise, room)}


def _noise(noise: Noise | None, room: float) -> Noise | None:
    if noise is None or noise.onset >= room:
        return None
    ramps = _trapezoid(Trapezoid(attack=noise.attack, hold=noise.hold, release=noise.release), room - noise.onset)
    whole = snap(ramps.attack + ramps.hold + ramps.release)
    return replace(noise, attack=ramps.attack, hold=ramps.hold, release=ramps.release, duration=whole)


def _trapezoid(ramps: Trapezoid, length: float) -> Trapezoid:
    attack, hold, release = _fitted(length, ramps.attack, ramps.hold, ramps.release)
    return Trapezoid(attack=attack, hold=hold, release=release)


def _fitted(length: float, *parts: float) -> list[float]:
    """Parts that follow one another, as far as they fit."""
    found: list[float] = []
    for part in parts:
        found.append(snap(max(0.0, min(part, length - sum(found)))))
    return found


def _blink(event: Blink, length: float) -> dict[str, Any]:
    return dict(zip(("close", "hold", "open"), _fitted(length, event.close, event.hold, event.open), strict=True))


def _movement(event: Brow | Head, length: float) -> dict[str, Any]:
    return dict(zip(("apex", "hold"), _fitted(length, event.apex, event.hold), strict=True))


_PARTS: Mapping[str, Callable[[Any, float], dict[str, Any]]] = MappingProxyType(
    {
        Inspiration.type: _breath,
        Expiration.type: _breath,
        Hold.type: lambda event, length: {"noise": _noise(event.noise, length)},
        Blink.type: _blink,
        Brow.type: _movement,
        Head.type: _movement,
        Gaze.type: lambda event, length: {"move": min(event.move, length)},
        Emotion.type: lambda event, length: {"apex": min(event.apex, length)},
    }
)
"""What else has to fit into a shorter duration, by type of event."""
