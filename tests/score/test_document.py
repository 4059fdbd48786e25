"""A Score refuses to name what it does not have."""

from __future__ import annotations

import dataclasses
import json

import pytest
from hypothesis import HealthCheck, given, settings

from scorebreath.errors import ScoreError
from scorebreath.score.codec import dumps, loads
from scorebreath.score.document import Body, Person, Score, VoiceInfo
from scorebreath.score.events import EVENTS, Marker

from .strategies import scores


def marker(name: str = "a", body: str = "body", onset: float = 0.0, group: str | None = None) -> Marker:
    return Marker(id=name, body=body, onset=onset, duration=0.0, name=name, group=group)


def empty() -> Score:
    voice = VoiceInfo(engine="tone", voice="tone", version="1", licence="GPL", sample_rate=8000, reference_db=-20.0)
    body = Body(id="body", voice=voice, person=Person(vital_capacity=5.0, resting_volume=0.38))
    return Score(made_by="test", seed=0, language="en", model="natural", text="", duration=1.0, bodies=(body,))


@pytest.mark.parametrize(
    ("events", "said"),
    [
        ((marker(), marker()), "'a' is used twice"),
        ((marker(body="ghost"),), "names the body 'ghost'"),
        ((marker(group="g9"),), "names the group 'g9'"),
        ((marker(onset=-1.0),), "must be >= 0"),
    ],
)
def test_what_is_named_must_exist(events: tuple[Marker, ...], said: str) -> None:
    with pytest.raises(ScoreError, match=said):
        dataclasses.replace(empty(), events=events)
    plain = json.loads(dumps(empty()))
    plain["events"] = [json.loads(json.dumps({**dataclasses.asdict(e), "type": "marker"})) for e in events]
    for event in plain["events"]:
        event.pop("x")
    with pytest.raises(ScoreError, match=said):
        loads(json.dumps(plain).encode())


@settings(max_examples=30, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(scores())
def test_events_are_found_by_type(score: Score) -> None:
    found = [event.id for kind, _ in EVENTS.values() for event in score.of(kind)]
    known = [event.id for event in score.events if event.type]
    assert sorted(found) == sorted(known)
