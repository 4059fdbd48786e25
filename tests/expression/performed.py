"""Texts performed by a face, and what there is to see of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from typing import Any

from scorebreath.expression.express import express
from scorebreath.expression.scene import Scene, scene
from scorebreath.expression.state import FaceState, Placed
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.score.document import Score
from scorebreath.score.events import (
    Blink,
    Brow,
    Event,
    Expiration,
    Gaze,
    Head,
    Hold,
    Inspiration,
    Pause,
    Phrase,
    Utterance,
)
from scorebreath.speech.voices import open_voice

MOVES = (Blink, Brow, Head, Gaze)
BREATHES = (Inspiration, Expiration, Hold)
STORY = (
    "The Queen of Hearts came slowly down the garden path, and all the gardeners threw themselves on the ground. "
    "Who are these people? asked the Queen, and nobody dared to answer her at once. Alice waited, er, a moment, "
    "then she said [pause 0.9] that it was none of her business. Really? The King smiled, and the roses, "
    "which had been white in the morning, were red by noon. [pause 2.5] Off they went; the rabbit, too, hurried on.\n\n"
    "Nothing was heard but the wind. What could it mean, and why did the soldiers wander about? "
    "They looked for the others, found no one, and marched quietly away after the rest."
)


@cache
def performed(text: str = STORY, seed: int = 0, times: int = 1, **parameters: Any) -> Score:
    """A text as the tone voice says it."""
    with open_voice("tone", "en") as voice:
        return compile_text(
            "\n\n".join([text] * times),
            voice=voice,
            media=MemoryStore(),
            seed=seed,
            parameters=Parameters(**parameters),
        )


def placed(score: Score, body: str = "body") -> list[Placed]:
    """What was placed: each group, and each event between groups by itself."""
    kinds = (Utterance, Phrase, Pause, *BREATHES)
    own = [event for event in score.events if isinstance(event, kinds) and event.body == body]
    found: list[list[Event]] = []
    for event in sorted(own, key=lambda event: (event.onset, event.end)):
        if event.group and found and found[-1][0].group == event.group:
            found[-1].append(event)
        else:
            found.append([event])
    return [Placed(events=tuple(events), place=str(events[0].group)) for events in found]


def scenes(score: Score, body: str = "body") -> list[Scene]:
    """Its groups."""
    steps = placed(score, body)
    return [scene(step, score.language) for step in steps if any(isinstance(e, Utterance) for e in step.events)]


def acted(steps: Sequence[Placed], over: float | None, **parameters: Any) -> list[Event]:
    """What a face does, step by step; its promise to decide forward alone is checked on the way."""
    state = FaceState(body="body", seed=0, parameters=Parameters(**parameters), language="en")
    found: list[Event] = []
    ends: list[float | None] = [None] * len(steps)
    for step, end in zip([*steps, Placed(events=(), place="end")], [*ends, over], strict=True):
        state_after, events = express(state, step, over=end)
        assert all(event.onset >= state.time - 1e-6 for event in events if isinstance(event, MOVES))
        assert state_after.time >= state.time
        assert len(state_after.waiting) <= 2
        state = state_after
        found += events
    return found


def moves(score: Score) -> list[Event]:
    """Blinks, brows, head and gaze of a Score, winks left out."""
    return [e for e in score.events if isinstance(e, MOVES) and "wink" not in e.rule]


def ruled(events: Sequence[Event], name: str) -> list[Event]:
    """Those of a rule."""
    return [event for event in events if event.rule.startswith(f"{name} (")]


def gazes(score: Score, body: str = "body") -> list[Gaze]:
    """In time."""
    return sorted(score.of(Gaze, body), key=lambda event: event.onset)


def far(yaw: float, pitch: float) -> float:
    """Degrees from the listener."""
    return math.hypot(yaw, pitch)
