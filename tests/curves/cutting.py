"""Performances that are interrupted: a Score is cut, breathes out and rests, and may go on with another one."""

from __future__ import annotations

import dataclasses
from functools import cache

import numpy as np

from scorebreath.curves.curve_set import CurveSet, curves
from scorebreath.media.store import MemoryStore
from scorebreath.pipeline import compile_text
from scorebreath.score.cutting import end_of, endings
from scorebreath.score.document import Score
from scorebreath.score.events import Cut, Event, Expiration, Hold, Inspiration, Motion, Parameter
from scorebreath.speech.voices import open_voice
from scorebreath.units import snap

TEXT = (
    "Good evening :-) Low pressure moves in from the west tonight, and with it comes a band of heavy rain. "
    "By morning, the rain will have reached the coast; inland it stays dry until noon. Will it last? [sigh] "
    "Not for long, since high pressure builds behind it. My poor mother :-( she bought five baby lambs."
)
PLAIN = Motion(thorax=1.7, abdomen=1.4, shoulder=0.4, neck_pitch=3.0)


@cache
def compiled(seed: int = 0) -> Score:
    """Some sentences as the tone voice says them, face and all, with room behind them."""
    voice = open_voice("tone", "en")
    try:
        score = compile_text(TEXT, voice=voice, media=MemoryStore(), seed=seed)
    finally:
        voice.close()
    return dataclasses.replace(score, duration=snap(score.duration + 60.0))


def unended(score: Score, time: float) -> tuple[str, ...]:
    """What is under way at a time, or would come later."""
    ends = endings(score.events)
    return tuple(
        event.id
        for event in score.events
        if not isinstance(event, Cut | Parameter)
        and end_of(event, ends) > time
        and not (event.id in ends and ends[event.id].prevents(event))
    )


def cut_at(score: Score, time: float, *, fade: float = 0.05, back: float = 0.8, rest: float = 5.0) -> Score:
    """The Score, all of which ends at a time; from there it breathes out to rest in `back` seconds and holds there."""
    body = score.bodies[0]
    name = f"cut{sum(isinstance(event, Cut) for event in score.events)}"
    before = [e for e in score.of(Inspiration) if e.onset < time]
    motion = before[-1].motion if before else PLAIN
    volume = snap(float(curves(score).sample([time], ["lung_volume"])[0, 0]))
    home = body.person.resting_volume
    placed: list[Event] = [
        Cut(id=name, body=body.id, onset=time, duration=fade, targets=unended(score, time), fade=fade),
        Expiration(
            id=f"{name}.out", body=body.id, onset=time, duration=back, from_volume=volume, to_volume=home,
            profile="sine", thorax_share=0.6, motion=motion,
        ),
        Hold(
            id=f"{name}.rest", body=body.id, onset=snap(time + back), duration=rest, volume=home, thorax_share=0.6,
            motion=motion,
        ),
    ]  # fmt: skip
    return dataclasses.replace(score, events=(*score.events, *placed))


def followed(score: Score, other: Score, onset: float) -> Score:
    """The Score, and another one's events from a time on."""
    name = f"again{len(score.events)}"
    there = score.bodies[0].id
    later = [
        dataclasses.replace(
            event, id=f"{name}.{event.id}", onset=snap(event.onset + onset), body=there,
            group=None,
        )
        for event in other.events
    ]  # fmt: skip
    return dataclasses.replace(score, events=(*score.events, *later), media={**score.media, **other.media})


def restarted(score: Score, other: Score, time: float, *, fade: float = 0.05, back: float = 0.8) -> Score:
    """The Score cut at a time, and another one as soon as it has breathed out."""
    return followed(cut_at(score, time, fade=fade, back=back, rest=0.0), other, snap(time + back))


def everything(found: CurveSet, times: np.ndarray) -> np.ndarray:
    """All that can be sampled: channels, contact, visemes."""
    return np.column_stack([found.sample(times), found.contact(times), found.visemes(times)])
