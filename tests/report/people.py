"""Scores of people whose breathing is known to the last figure, for the tests of norms."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

from scorebreath.score.document import CutReason, Score, Site
from scorebreath.score.events import Event, Expiration, Inspiration, Lead, Phone, Trapezoid, Utterance
from scorebreath.units import snap
from tests.curves.scores import MOTION, REST, Breath, build

EVEN = Breath(before=0.1, inspiration=0.6, after=0.06, speech=4.0, to_volume=0.52, end_volume=0.36, profile="sine")
"""4 s on 16 % of 5 L and 16 syllables, a breath of 0.6 s that is heard from 0.06 s to 0.54 s."""


def person(
    breaths: Sequence[Breath] | int = 12,
    *,
    syllables: Sequence[int] = (),
    sites: Sequence[Site] = (),
    parameters: Mapping[str, Any] | None = None,
    model: str = "natural",
    tail: float = 0.5,
) -> Score:
    """Somebody who speaks.

    Args:
        breaths: The groups, or how many of EVEN.
        syllables: Of each group; 16 where not given.
        sites: Where each group ends; a sentence where not given.
        parameters: What the user set.
        model: Who planned it.
        tail: s after the last group.
    """
    score = build([EVEN] * breaths if isinstance(breaths, int) else breaths, tail=tail)
    for said in score.of(Utterance):
        score = with_phones(score, said.id, said.duration)  # without a pause
    groups = list(score.groups)
    for index, count in enumerate(syllables):
        groups[index] = dataclasses.replace(groups[index], syllables=count)
    for index, site in enumerate(sites):
        groups[index] = dataclasses.replace(groups[index], cut=CutReason(site=site, rule="test"))
    body = dataclasses.replace(score.bodies[0], parameters=dict(parameters or {}))
    return dataclasses.replace(score, groups=tuple(groups), bodies=(body,), model=model)


def with_events(score: Score, *events: Event) -> Score:
    """The same with more events, as long as they last."""
    end = max((event.end for event in events), default=0.0)
    return dataclasses.replace(score, events=score.events + events, duration=max(score.duration, snap(end)))


def with_phones(score: Score, id: str, *lengths: float) -> Score:  # noqa: A002
    """The same, one utterance's phones of these lengths from its onset on; a length below 0 is a silence."""
    phones, now = [], 0.0
    for length in lengths:
        phones.append(Phone(ipa="a" if length > 0 else "", onset=snap(now), duration=snap(abs(length))))
        now += abs(length)
    events = tuple(
        dataclasses.replace(event, phones=tuple(phones)) if isinstance(event, Utterance) and event.id == id else event
        for event in score.events
    )
    return dataclasses.replace(score, events=events)


def tidal(onset: float, count: int, *, inspiration: float = 1.6, cycle: float = 4.0, depth: float = 0.1) -> list[Event]:
    """Breaths at rest, one after the other."""
    found: list[Event] = []
    for number in range(count):
        start = snap(onset + number * cycle)
        found.append(
            Inspiration(
                id=f"t{onset}.{number}.in", body="body", onset=start, duration=inspiration, kind="tidal",
                from_volume=REST, to_volume=snap(REST + depth), profile="sine", thorax_share=0.65, motion=MOTION,
                sound_nose=0.0, sound_mouth=0.0, nostril_flare=0.0, mouth_open=0.0, lead=Lead(),
                face=Trapezoid(attack=0.0, hold=inspiration, release=0.0),
            )
        )  # fmt: skip
        found.append(
            Expiration(
                id=f"t{onset}.{number}.out", body="body", onset=snap(start + inspiration),
                duration=snap(cycle - inspiration), kind="tidal", from_volume=snap(REST + depth), to_volume=REST,
                profile="sine", thorax_share=0.65, motion=MOTION,
            )
        )  # fmt: skip
    return found
