"""Sighs, laughs and the like: in the text, in the picture, and never taken for the breath before speech."""

from __future__ import annotations

import dataclasses
import io
from typing import Any, get_args, get_type_hints

import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.report import timeline
from scorebreath.report.acts import CAPTIONS, acts
from scorebreath.report.rows import breaths
from scorebreath.report.sheet import Sheet
from scorebreath.report.transcript import transcript
from scorebreath.score.document import Score
from scorebreath.score.events import Event, Expiration, Hold, Inspiration, Utterance
from scorebreath.units import snap
from tests.curves.acts import breathe_in, breathe_out, keep, noise_of
from tests.curves.scores import Breath, build, score_of, utterance
from tests.report.test_preview import data, page

SIGH_IN = breathe_in(id="s1", kind="sigh", onset=0.0, duration=1.0)
SIGH_OUT = breathe_out(id="s2", kind="sigh", onset=1.1, duration=1.5, noise=noise_of(1.5))


def after(score: Score, *events: Event) -> Score:
    """The Score with more events at its end, one after the other."""
    now, placed = score.duration, []
    for event in events:
        placed.append(dataclasses.replace(event, onset=now))
        now = snap(now + event.duration)
    return dataclasses.replace(score, events=(*score.events, *placed), duration=now)


def test_captions_are_of_kinds_there_are() -> None:
    for event in (Inspiration, Expiration, Hold):
        kinds = get_args(get_type_hints(event)["kind"])
        named = {kind for name, kind in CAPTIONS if name == event.type}
        assert named < set(kinds)
        assert set(kinds) - named <= {"speech", "tidal", "rest"}, "what is no plain breathing has a caption"


def test_air_in_and_out_of_a_sigh_are_one() -> None:
    later = breathe_out(id="s3", kind="sigh", onset=4.0, duration=1.0)
    assert acts(score_of([later, SIGH_OUT, SIGH_IN]), "body") == (("sighs", 0.0, 2.6), ("sighs", 4.0, 5.0))
    sniff = dataclasses.replace(SIGH_IN, kind="sniff")
    assert [act.caption for act in acts(score_of([sniff, SIGH_OUT]), "body")] == ["sniffs", "sighs"]
    assert acts(score_of([SIGH_IN]), "nobody") == ()


def test_captions_stand_where_they_happen() -> None:
    score = after(build([Breath(text="He left. "), Breath(text="Why?")], tail=0.0), SIGH_IN, SIGH_OUT)
    held = dataclasses.replace(keep(id="h"), onset=0.02, duration=0.05)
    score = dataclasses.replace(score, events=(held, *score.events))
    pieces = transcript(score, "body", score.duration)
    shown = [piece.get("caption") or piece.get("text") or "breath" for piece in pieces]
    assert shown == ["[holds breath]", "breath", "He", " ", "left.", "  ", "breath", "Why?", "[sighs]"]
    last = pieces[-1]
    assert (last["onset"], last["end"]) == pytest.approx((score.duration - 2.5, score.duration))
    early = transcript(score, "body", score.duration - 2.5)
    assert "[sighs]" not in [piece.get("caption") for piece in early]


def test_the_breath_before_speech_is_no_sigh_and_no_sniff() -> None:
    score = build([Breath(before=4.0)])
    sniff = dataclasses.replace(SIGH_IN, kind="sniff", onset=0.5, group="g1")
    tidal = dataclasses.replace(SIGH_IN, id="t", kind="tidal", onset=2.0, group="g1")
    score = dataclasses.replace(score, events=(sniff, tidal, *(e for e in score.events if e.id != "g1.before")))
    (found,) = breaths(score, "body")
    assert (found.onset, found.inspired) == (4.0, 4.6)
    gasp = tuple(dataclasses.replace(e, kind="gasp") if isinstance(e, Inspiration) else e for e in score.events[2:])
    (found,) = breaths(dataclasses.replace(score, events=gasp), "body")
    assert found.onset == 4.0


def test_a_group_in_parts_lasts_to_the_last_of_them() -> None:
    score = build([Breath(speech=2.0)])
    more = utterance(Breath(speech=1.0), 4.0, 0, id="more", group="g1")
    (found,) = breaths(dataclasses.replace(score, events=(*score.events, more)), "body")
    assert (found.onset, found.end) == (0.1, 5.0)
    first = next(score.of(Utterance))
    assert found.inspired < first.onset


def test_the_page_holds_captions_and_every_inspiration() -> None:
    score = after(build([Breath()], tail=0.0), SIGH_IN, SIGH_OUT, dataclasses.replace(SIGH_IN, id="t", kind="tidal"))
    found = data(page(score))
    assert [piece["caption"] for piece in found["text"] if "caption" in piece] == ["[sighs]"]
    assert found["inspired"] == sorted([e.onset, snap(e.end)] for e in score.of(Inspiration))
    assert len(found["inspired"]) == 3


def test_the_timeline_names_them(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[tuple[str, str, float]] = []

    def listen(_: Sheet, x: float, y: float, text: str, size: float, color: str, **more: Any) -> None:
        shown.append((text, color, x))

    monkeypatch.setattr(Sheet, "text", listen)
    score = after(build([Breath()], tail=0.0), SIGH_IN, SIGH_OUT)
    timeline.write_timeline(io.BytesIO(), score, curves(score))
    ((x, color),) = [(x, color) for text, color, x in shown if text == "[sighs]"]
    width = timeline.WIDTH - timeline.LEFT - timeline.RIGHT
    assert x == pytest.approx(timeline.LEFT + (score.duration - 2.5) / score.duration * width)
    assert color == timeline.BREATH
