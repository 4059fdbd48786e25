"""Spoken groups made by hand, and a body to place them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np

from scorebreath.compose.models import breathing_model
from scorebreath.compose.state import BodyState, Places, Spoken, SpokenPart
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, Part
from scorebreath.score.document import CutReason, Site
from scorebreath.score.events import Event, Level, Phone, Pitch
from scorebreath.script.marks import Mark
from scorebreath.spans import Span, join
from scorebreath.speech.model import Speech
from scorebreath.units import snap

RATE = 8000


def spoken(number: int, text: str, syllables: int, seconds: float, site: Site, key: str, **changes: Any) -> Spoken:
    """A group of so many syllables that takes so long to say."""
    whole: dict[str, Any] = {
        "source": Span(0, len(text)),
        "spoken": join([(text, Span(0, len(text)))]),
        "words": (),
        "syllables": syllables,
        "sentence_type": "statement",
        "ends_sentence": site in ("sentence", "paragraph", "text end"),
    }
    group = BreathGroup(
        index=number,
        text=text,
        **whole,
        parts=(Part(**whole),),
        cut=CutReason(site=site, rule="by hand"),
    )
    group = dataclasses.replace(group, **changes)
    frames = round(seconds * RATE)
    speech = Speech(
        samples=np.zeros(frames, np.float32),
        sample_rate=RATE,
        words=(),
        phones=(Phone(ipa="a", onset=0.0, duration=snap(frames / RATE)),),
        pitch=Pitch(step=0.005, hertz=()),
        level=Level(step=0.01, db=()),
    )
    return Spoken(
        group=group,
        id=f"g{number}",
        place=key,
        parts=tuple(SpokenPart(part=part, speech=speech, media="0" * 64) for part in group.parts),
    )


def perform(
    model: str,
    said: list[tuple[str, int, float, Site]],
    parameters: Parameters | None = None,
    seed: int = 0,
    marks: Mapping[int, tuple[Mark, ...]] | None = None,
) -> tuple[list[Event], BodyState]:
    """All events of these groups (text, syllables, seconds, site), and the body afterwards.

    Args:
        model: Name of the breathing model.
        said: The groups.
        parameters: Defaults where None.
        seed: Of every chance.
        marks: Marks before groups, by the group's number; those of `len(said)` stand after the last one.
    """
    p = parameters or Parameters()
    breathing = breathing_model(model)
    person = breathing.person(p)
    state = BodyState(body="body", seed=seed, parameters=p, person=person, time=0.5, volume=person.resting_volume)
    events: list[Event] = []
    places = Places()
    asked = marks or {}
    for number, (text, syllables, seconds, site) in enumerate(said):
        after = asked.get(number + 1, ()) if number == len(said) - 1 else ()
        group = spoken(
            number, text, syllables, seconds, site, places.key(text), before=asked.get(number, ()), after=after
        )
        state, placed = breathing.step(state, group)
        events += placed
    state, placed = breathing.finish(state, 0.0)
    return [*events, *placed], state
