"""The face in the picture: each event in its lane, at its time, and no lanes where there is no face."""

from __future__ import annotations

import dataclasses
import io
from typing import Any

import pytest
from PIL import Image, ImageColor

from scorebreath.curves.curve_set import curves
from scorebreath.report import face_lanes, timeline
from scorebreath.report.bands import INK
from scorebreath.report.rows import wrap
from scorebreath.report.sheet import Sheet
from scorebreath.score.acting import EMOTIONS
from scorebreath.score.document import Score
from scorebreath.score.events import Gaze, Phrase
from tests.curves.scores import Breath, build
from tests.report.faced import blink, faced, with_face
from tests.report.test_timeline import column, draw, has, pixels

Said = list[tuple[str, float, float]]


@pytest.fixture
def said(monkeypatch: pytest.MonkeyPatch) -> Said:
    """Every text that is drawn, with its place."""
    texts: Said = []

    def listen(_: Sheet, x: float, y: float, text: str, *rest: Any, **more: Any) -> None:
        texts.append((text, x, y))

    monkeypatch.setattr(Sheet, "text", listen)
    return texts


def test_only_a_face_has_lanes(said: Said) -> None:
    plain = build([Breath(speech=3.5)])
    assert pixels(draw(plain)).shape[0] == timeline.HEADER + timeline.ROW
    mouth_alone = with_face(plain)
    phrased = dataclasses.replace(plain, events=(*plain.events, *faced().of(Phrase)))
    for score in (mouth_alone, phrased):
        assert pixels(draw(score)).shape[0] == timeline.HEADER + timeline.ROW
    assert not {"looks at", "blinks", "phrases"} & {text for text, _, _ in said}
    assert pixels(draw(faced())).shape[0] == timeline.HEADER + timeline.ROW + face_lanes.HEIGHT
    assert {"looks at", "blinks", "phrases"} <= {text for text, _, _ in said}


def test_another_bodys_face_is_not_drawn() -> None:
    score = faced()
    other = dataclasses.replace(score.bodies[0], id="body2")
    both = dataclasses.replace(score, bodies=(*score.bodies, other))
    stream = io.BytesIO()
    timeline.write_timeline(stream, both, curves(both, "body2"))
    assert pixels(stream.getvalue()).shape[0] == timeline.HEADER + timeline.ROW


def test_blinks_and_gaze_stand_at_their_times() -> None:
    score = faced()
    top = timeline.HEADER + timeline.FACE
    row, seconds = pixels(draw(score))[top:], score.duration
    blinks, gaze = slice(*face_lanes.BLINKS), slice(*face_lanes.GAZE)
    for time, shown in [(0.4, True), (0.8, False), (1.8, False)]:
        assert has(row[blinks, column(time, seconds)], INK) == shown
    wink = row[blinks, column(2.3, seconds)]
    assert has(wink, face_lanes.RIGHT_SIDE), "the right eye's half"
    assert not has(wink, INK)
    for time, name in [(1.0, "listener"), (2.6, "away"), (4.5, "listener")]:
        assert has(row[gaze, column(time, seconds)], face_lanes.TARGETS[name])
    assert not has(row[gaze, column(5.05, seconds)], face_lanes.TARGETS["listener"])


def test_emotions_and_closed_lips_stand_at_their_times() -> None:
    score = faced()
    row, seconds = pixels(draw(score))[timeline.HEADER + timeline.FACE :], score.duration
    emotions = slice(int(face_lanes.EMOTIONS.top) - 2, int(face_lanes.EMOTIONS.bottom) + 1)
    for name, time in [("kidding", 2.21), ("happy", 4.16)]:
        here = row[emotions, column(time, seconds)]
        assert has(here, face_lanes.COLOURS[name][1])
        assert not has(row[emotions, column(0.5, seconds)], face_lanes.COLOURS[name][1])
    (shut,) = curves(score).sample([1.28], ["lip_close"])[:, 0]
    assert shut > 0.9
    lips = slice(face_lanes.MOUTH_BOTTOM + 1, face_lanes.MOUTH_BOTTOM + 5)
    assert has(row[lips, column(1.28, seconds)], face_lanes.SHUT)
    assert not has(row[lips, column(1.55, seconds)], face_lanes.SHUT)


def test_everything_is_named(said: Said) -> None:
    draw(faced())
    texts = [text for text, _, _ in said]
    assert {"listener", "away", "kidding", "happy", "3 h-l%", "5 h-h%", "chin up", "head left", "roll right"} <= set(
        texts
    )
    # A glance too short for its name has none.
    short = Gaze(
        id="g", body="body", onset=5.0, duration=0.05, target="a very long name", yaw=1.0, pitch=0.0, move=0.02
    )
    said.clear()
    draw(faced(short))
    assert "a very long name" not in [text for text, _, _ in said]


def test_the_scale_holds_every_turn_of_the_head() -> None:
    score = faced()
    lanes = face_lanes.FaceLanes(score, curves(score), wrap(score.duration, [], 15.0, 5))
    turned = curves(score).sample([x / 50 for x in range(int(50 * score.duration))], ["head_pitch", "head_roll"])
    assert abs(turned).max() <= lanes.head.high == -lanes.head.low
    assert lanes.head.high % face_lanes.HEAD_STEP == 0


def test_every_emotion_has_its_colour() -> None:
    assert set(face_lanes.COLOURS) == set(EMOTIONS)
    inks = [ImageColor.getrgb(color) for pair in face_lanes.COLOURS.values() for color in pair]
    assert len(set(inks)) == 2 * len(EMOTIONS)


def test_an_hour_with_a_face_is_a_picture_of_a_few_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its size follows from what is shown, and so do the moments that are sampled."""
    hour: Score = build([Breath(speech=9.0)] * 370)
    hour = with_face(hour, *(blink(f"b{n}", 4.0 * n) for n in range(900)))
    png = draw(hour)
    high = timeline.HEADER + timeline.STRIP + timeline.MOST_FACED_ROWS * (timeline.ROW + face_lanes.HEIGHT)
    assert Image.open(io.BytesIO(png)).size == (timeline.WIDTH, high)
    assert high < 4100
    assert len(png) < 3_000_000
