"""What a face does, in words: every event, at its words, by its rule."""

from __future__ import annotations

import dataclasses

import pytest

from scorebreath.report.face_lanes import MOVES
from scorebreath.report.face_rows import LOOKS, blink_interval, face_rows, rule_name, rule_rows
from scorebreath.score.document import Score
from scorebreath.score.events import Brow, Event, Gaze, Head
from tests.curves.scores import Breath, build
from tests.report.faced import blink, faced


def rows(score: Score) -> dict[str, tuple[str, str]]:
    return {row.id: (row.what, row.words) for row in face_rows(score)}


def test_every_event_of_the_face_is_told_in_order_of_time() -> None:
    score = faced()
    found = list(face_rows(score))
    assert {row.id for row in found} == {event.id for event in score.events if event.type in LOOKS}
    assert [row.time for row in found] == sorted(row.time for row in found)
    assert set(LOOKS) == {kind.type for kind in MOVES}
    for row in found:
        event = next(event for event in score.events if event.id == row.id)
        assert (row.kind, row.rule, row.origin, row.body) == (event.type, event.rule, event.origin, event.body)
        assert [row.time, row.end] == pytest.approx([event.onset, event.end])
        assert all(getattr(event, name) == value for name, value in row.amounts.items())
        assert set(row.amounts) == {f.name for f in dataclasses.fields(event)} - {
            f.name for f in dataclasses.fields(Event)
        }


def test_what_is_told_in_words() -> None:
    found = rows(faced())
    assert found["b1"][0] == "both lids 1.00, 250 ms"
    assert found["wink"][0] == "right lid 1.00, 250 ms"
    assert found["w1"][0] == "left 0.28, right 0.35"
    assert found["w2"][0] == "frown 0.80"
    assert found["h1"][0] == "up 2.6, tilt left 1.5 deg"
    assert found["h2"][0] == "up 4.0, left 3.0 deg"
    assert found["g2"][0] == "to away, up 4.0, right 9.0 deg"
    assert found["g1"][0] == "to listener"
    assert found["e1"][0] == "kidding 1.00 at 2.21 s"
    uneven = rows(faced(blink("uneven", 4.9, left=0.4, right=0.8)))["uneven"]
    assert uneven == ("both lids left 0.40, right 0.80, 250 ms", "")


def test_words_are_those_that_sound_meanwhile() -> None:
    """Seven words of half a second from 0.76 s on; a gaze is told with the word at which it goes."""
    found = rows(faced())
    assert found["b1"][1] == ""
    assert found["w1"][1] == "Poppy may"
    assert found["wink"][1] == "bake a"
    assert found["g2"][1] == "may"
    assert found["g1"][1] == ""
    assert found["e1"][1] == "Poppy may bake a warm"
    whole = Head(id="all", body="body", onset=0.0, duration=5.0, pitch=1.0, yaw=0.0, roll=0.0, apex=1.0)
    assert rows(faced(whole))["all"][1] == "Poppy may bake ... warm apple pie?"


def test_a_rule_is_counted_by_its_name() -> None:
    assert rule_name("brow at maximum (A28): 4.2 st on 'way'") == "brow at maximum (A28)"
    score = faced(
        *(Brow(id=f"x{n}", body="body", onset=0.1, duration=0.5, left=0.1, right=0.1, frown=0.0, apex=0.1,
               rule=f"brow_at_maximum: {n} st") for n in range(3))
    )  # fmt: skip
    counted = {(row.kind, row.rule): row for row in rule_rows(face_rows(score), score.duration)}
    assert counted["brow", "brow_at_maximum"].count == 4
    assert counted["brow", "brow_at_maximum"].per_minute == pytest.approx(60 * 4 / score.duration, abs=0.006)
    assert sum(row.count for row in counted.values()) == len(list(face_rows(score)))
    kinds = [row.kind for row in rule_rows(face_rows(score), score.duration)]
    assert kinds == sorted(kinds, key=list(LOOKS).index)


def test_the_mean_interval_is_of_each_body_by_itself() -> None:
    one = [blink(f"b{n}", time) for n, time in enumerate((0.0, 2.0, 6.0))]
    other = [dataclasses.replace(blink(f"c{n}", time), body="body2") for n, time in enumerate((1.0, 9.0))]
    score = build([Breath(speech=9.5)])
    score = dataclasses.replace(
        score, bodies=(*score.bodies, dataclasses.replace(score.bodies[0], id="body2")), events=(*one, *other)
    )
    assert blink_interval(face_rows(score)) == pytest.approx((2 + 4 + 8) / 3)
    assert blink_interval(face_rows(score, "body2")) == 8.0
    assert blink_interval(face_rows(dataclasses.replace(score, events=tuple(one[:1])))) is None
    assert [row.body for row in face_rows(score, "body2")] == ["body2", "body2"]


def test_no_face_no_rows() -> None:
    score = build([Breath()])
    assert list(face_rows(score)) == []
    assert rule_rows([], score.duration) == ()
    assert rule_rows([], 0.0) == ()


def test_a_gaze_has_the_word_at_which_it_goes() -> None:
    """However long it stays there."""
    score = build([Breath(speech=2.0)] * 400)
    marks = tuple(
        Gaze(id=f"g{n}", body="body", onset=n / 4, duration=0.25, target="listener", yaw=0.0, pitch=0.0, move=0.02)
        for n in range(4000)
    )
    found = list(face_rows(dataclasses.replace(score, events=score.events + marks, duration=1200.0)))
    assert len(found) == 4000
    assert all(isinstance(row.words, str) and len(row.words.split()) <= 2 for row in found)
