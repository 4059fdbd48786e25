"""A Score refuses to name what it does not have."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scorebreath.errors import ScoreError
from scorebreath.score.codec import dumps, loads
from scorebreath.score.document import Body, CutReason, Group, MediaInfo, Person, Score, VoiceInfo, overrun
from scorebreath.score.events import (
    EVENTS,
    Event,
    Lead,
    Level,
    Marker,
    Noise,
    Phone,
    Phrase,
    Pitch,
    Trapezoid,
    Utterance,
    Word,
)
from scorebreath.score.values import limits_of

from .strategies import event_of, of_type, scores


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


PARTS = {Noise, Lead, Trapezoid, Utterance, Word, Phone, Pitch, Level, Person, MediaInfo, VoiceInfo}
CLASSES = sorted({kind for kind, _ in EVENTS.values()} | PARTS, key=lambda kind: kind.__name__)


@settings(max_examples=5, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@pytest.mark.parametrize("kind", CLASSES)
@given(st.data())
def test_every_limit_is_kept(kind: Any, data: st.DataObject) -> None:
    good = data.draw(event_of(kind) if issubclass(kind, Event) else of_type(kind))
    for name, (low, high) in limits_of(kind).items():
        for beyond in (low - 1, high * 2 + 1):
            whole = isinstance(getattr(good, name), int)
            with pytest.raises(ScoreError, match=f"{kind.__name__}.{name}"):
                dataclasses.replace(good, **{name: int(beyond) if whole else float(beyond)})


def test_the_ramps_of_a_noise_fill_it() -> None:
    with pytest.raises(ScoreError, match="hold"):
        Noise(onset=0.0, duration=0.44, attack=0.1, hold=99.0, release=0.1, level_db=-24.0, seed=1)


@pytest.mark.parametrize("source", [(-5, 1000), (3, 1), (0, 4)])
def test_ranges_lie_within_the_text(source: tuple[int, int]) -> None:
    text = dataclasses.replace(empty(), text="abc")
    reason = CutReason(site="text end", rule="")
    group = Group(id="g", body="body", source=source, text="", syllables=1, sentence_type="statement", cut=reason)
    with pytest.raises(ScoreError, match="no range of the text"):
        dataclasses.replace(text, groups=(group,))
    phrase = Phrase(
        id="p", body="body", onset=0.0, duration=1.0, source=source, break_index=4, position="final",
        sentence_type="statement",
    )  # fmt: skip
    with pytest.raises(ScoreError, match="no range of the text"):
        dataclasses.replace(text, events=(phrase,))


@settings(max_examples=30, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(scores())
def test_events_are_found_by_type(score: Score) -> None:
    found = [event.id for kind, _ in EVENTS.values() for event in score.of(kind)]
    known = [event.id for event in score.events if event.type]
    assert sorted(found) == sorted(known)


def test_a_number_out_of_range_names_the_range_in_full() -> None:
    with pytest.raises(ScoreError, match=r"Score\.duration=1000000000000\.0 must be in \[0, 1000000000\]"):
        dataclasses.replace(empty(), duration=1e12)
    with pytest.raises(ScoreError, match=r"Trapezoid\.attack=.* must be a finite multiple"):
        Trapezoid(attack=float("inf"), hold=0.0, release=0.0)
    with pytest.raises(ScoreError, match=r"VoiceInfo\.reference_db=-1e\+100 must be in \[-1000000000, 1000000000\]"):
        dataclasses.replace(empty().bodies[0].voice, reference_db=-1e100)
    with pytest.raises(ScoreError, match=r"seed=0 must be in \[1, 16777215\]"):
        Noise(onset=0.0, duration=0.0, attack=0.0, hold=0.0, release=0.0, level_db=-24.0, seed=0)


def test_a_long_name_is_seen_to_be_cut() -> None:
    utterance = Utterance(
        id="u", body="body", onset=0.0, duration=0.2, media="ab" * 32, gain_db=0.0, closing="final", words=(),
        phones=(), pitch=Pitch(step=0.01, hertz=()), level=Level(step=0.01, db=()),
    )  # fmt: skip
    with pytest.raises(ScoreError, match=r"names media 'abababababab\.\.\.', which"):
        dataclasses.replace(empty(), events=(utterance,))


def test_what_lies_behind_the_end_is_known() -> None:
    score = dataclasses.replace(empty(), duration=8.0)
    assert overrun(score) == 0.0
    for onset, duration, beyond in ((7.0, 1.0, 0.0), (7.5, 1.0, 0.5), (9.1, 1.2, 2.3), (0.1, 7.900001, 1e-6)):
        late = dataclasses.replace(marker(onset=onset), duration=duration)
        late_score = dataclasses.replace(score, events=(late, marker("b")))
        assert overrun(late_score) == beyond
