"""The picture: what it shows where, and that it stays small."""

from __future__ import annotations

import io
import warnings
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageColor

from scorebreath.curves.curve_set import curves
from scorebreath.report import timeline
from scorebreath.report.bands import INK
from scorebreath.report.rows import breaths, wrap
from scorebreath.report.sheet import Sheet
from scorebreath.score.document import Score
from tests.curves.scores import Breath, build, score_of


def draw(score: Score) -> bytes:
    stream = io.BytesIO()
    timeline.write_timeline(stream, score, curves(score))
    return stream.getvalue()


def pixels(png: bytes) -> NDArray[np.uint8]:
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"))


def has(part: NDArray[np.uint8], colour: str) -> bool:
    return bool(np.any(np.all(part == np.array(ImageColor.getrgb(colour)), axis=-1)))


def column(time: float, seconds_a_row: float) -> int:
    return round(timeline.LEFT + time * (timeline.WIDTH - timeline.LEFT - timeline.RIGHT) / seconds_a_row)


def test_sounds_and_breaths_stand_at_their_times() -> None:
    score = build([Breath(before=0.5, inspiration=1.0, after=0.5, speech=3.0)], tail=1.0)
    picture = pixels(draw(score))
    assert picture.shape == (timeline.HEADER + timeline.ROW, timeline.WIDTH, 3)
    row = picture[timeline.HEADER :]
    sound = row[int(timeline.SOUND.top) : int(timeline.SOUND.bottom) - 3]
    for time, shown in [
        (0.25, ()),
        (1.0, (timeline.BREATH, timeline.INSPIRED)),
        (1.75, ()),
        (3.0, (timeline.SPEECH,)),
        (5.5, ()),
    ]:
        here = sound[:, column(time, 6.0)]
        for colour in (timeline.BREATH, timeline.SPEECH, timeline.INSPIRED):
            assert has(here, colour) == (colour in shown), (time, colour)


def test_speech_begins_and_ends_to_the_pixel() -> None:
    score = build([Breath(before=0.5, inspiration=1.0, after=0.5, speech=3.0)], tail=1.0)
    foot = pixels(draw(score))[timeline.HEADER + int(timeline.SOUND.bottom) - 5]
    found = np.flatnonzero(np.all(foot == np.array(ImageColor.getrgb(timeline.SPEECH)), axis=-1))
    assert found[0] == pytest.approx(column(2.0, 6.0), abs=2)
    assert found[-1] == pytest.approx(column(5.0, 6.0), abs=2)


def test_the_line_is_the_lung_volume() -> None:
    score = build([Breath(before=0.5, inspiration=1.0, after=0.5, speech=3.0, to_volume=0.7)], tail=1.0)
    lung = pixels(draw(score))[timeline.HEADER + timeline.LUNG_TOP - 4 : timeline.HEADER + timeline.LUNG_BOTTOM]
    ink = np.array(ImageColor.getrgb(INK))
    for time in (0.8, 1.2, 1.75, 2.5, 4.0):
        found = np.flatnonzero(np.all(lung[:, column(time, 6.0)] == ink, axis=-1)).mean() - 4
        volume = curves(score).sample([time], ["lung_volume"])[0, 0]
        low, high = 0.36, 0.7  # rest less a little, and the peak
        expected = (high - volume) / (high - low) * (timeline.LUNG_BOTTOM - timeline.LUNG_TOP)
        assert found == pytest.approx(expected, abs=2.5)


def test_a_long_score_is_shown_whole_in_a_strip_and_its_beginning_in_detail() -> None:
    hour = build([Breath(speech=9.0)] * 370)
    assert hour.duration > 3600
    png = draw(hour)
    height = timeline.HEADER + timeline.STRIP + timeline.MOST_ROWS * timeline.ROW
    assert pixels(png).shape == (height, timeline.WIDTH, 3)
    assert len(png) < 3_000_000
    strip = pixels(png)[timeline.HEADER : timeline.HEADER + timeline.STRIP_BOTTOM]
    ends = timeline.LEFT + 5, timeline.WIDTH - timeline.RIGHT - 8
    assert all(has(strip[:, x : x + 4], INK) for x in ends)
    shown = wrap(hour.duration, [b.onset for b in breaths(hour, "body")], timeline.ROW_SECONDS, timeline.MOST_ROWS)
    assert shown[-1].end < 150
    share = round(timeline.LEFT + (timeline.WIDTH - timeline.LEFT - timeline.RIGHT) * shown[-1].end / hour.duration)
    top = strip[timeline.STRIP_TOP - 5]
    assert has(top[share - 4 : share - 1], timeline.DETAIL)
    assert not has(top[share + 2 : share + 6], timeline.DETAIL)


def test_a_short_score_has_no_strip() -> None:
    assert pixels(draw(build([Breath()]))).shape[0] == timeline.HEADER + timeline.ROW


@pytest.mark.parametrize("score", [score_of([]), score_of([], duration=2.0), score_of([], duration=100.0)])
def test_scores_in_which_nothing_happens(score: Score) -> None:
    assert pixels(draw(score)).shape[1] == timeline.WIDTH


def test_any_text_is_only_text() -> None:
    hostile = r"$\frac{1}{ $x^2$ \undefined 世界 🙂 مرحبا " + "\x07 \u202e \ud800 " + "w" * 400
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        draw(build([Breath(text=hostile)]))


def test_equal_scores_give_equal_bytes() -> None:
    score = build([Breath()] * 3)
    assert draw(score) == draw(score)


@pytest.mark.parametrize(("count", "said"), [(1, "1 breath group"), (2, "2 breath groups")])
def test_one_breath_group_is_one(count: int, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    texts: list[str] = []
    draw_text = Sheet.text

    def listen(self: Sheet, x: float, y: float, text: str, *rest: Any, **more: Any) -> None:
        texts.append(text)
        draw_text(self, x, y, text, *rest, **more)

    monkeypatch.setattr(Sheet, "text", listen)
    draw(build([Breath()] * count))
    assert any(said in text.split("   ·   ") for text in texts)
