"""Curves as CSV and JSON: bytes, exact frames, and the numbers of the curves themselves."""

from __future__ import annotations

import csv
import dataclasses
import io
import json
import math
from collections.abc import Callable
from fractions import Fraction
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.curve_set import curves
from scorebreath.errors import InputError
from scorebreath.formats import curves_csv, curves_json
from scorebreath.formats.decimals import encode
from scorebreath.formats.formats import FORMATS, ExportOptions, format_named
from scorebreath.formats.frames import BLOCK, HIGHEST, frame_count
from scorebreath.score.document import Score
from scorebreath.score.events import Utterance
from tests.curves.scores import Breath, build, score_of, scores

NTSC = Fraction(30000, 1001)
RATES = st.sampled_from([NTSC, Fraction(24), Fraction(25), Fraction(60), Fraction(2997, 100), Fraction(1, 3)])
COUNTED = settings(max_examples=25, deadline=None)


def as_csv(score: Score, fps: Fraction) -> bytes:
    stream = io.BytesIO()
    curves_csv.write(stream, curves(score), score.duration, fps)
    return stream.getvalue()


def as_json(score: Score, fps: Fraction) -> bytes:
    stream = io.BytesIO()
    curves_json.write(stream, curves(score), score.duration, fps)
    return stream.getvalue()


@given(st.lists(st.lists(st.integers(-(10**15), 10**15), min_size=3, max_size=3), min_size=1, max_size=20))
def test_numbers_are_written_as_python_writes_them(rows: list[list[int]]) -> None:
    def text(micros: int) -> str:
        whole, fraction = divmod(abs(micros), 10**6)
        return f"{'-' if micros < 0 else ''}{whole}.{fraction:06d}"

    expected = "".join(",".join(map(text, row)) + "\n" for row in rows)
    assert encode(np.array(rows), b",", b"\n").decode() == expected


@given(st.integers(0, 10**10), RATES)
def test_frames_fill_the_duration_exactly(micros: int, fps: Fraction) -> None:
    count = frame_count(micros / 1e6, fps)
    assert (count - 1) / fps <= Fraction(micros, 10**6) < count / fps


@COUNTED
@given(scores(max_groups=2), RATES)
def test_csv_holds_the_curves(score: Score, fps: Fraction) -> None:
    written = as_csv(score, fps)
    assert b"-0.000000" not in written
    assert written.endswith(b"\n") and b"\r" not in written
    header, *rows = list(csv.reader(io.StringIO(written.decode("ascii"))))
    assert header == ["time", *curves(score).channels]
    assert len(rows) == frame_count(score.duration, fps)
    values = np.array(rows, dtype=np.float64)
    times = np.array([float(i / fps) for i in range(len(rows))])
    np.testing.assert_allclose(values[:, 0], times, atol=0.51e-6)
    np.testing.assert_allclose(values[:, 1:], curves(score).sample(times), atol=0.51e-6)


@COUNTED
@given(scores(max_groups=2), RATES)
def test_json_holds_the_same_numbers_and_the_table(score: Score, fps: Fraction) -> None:
    document = json.loads(as_json(score, fps))
    rows = list(csv.DictReader(io.StringIO(as_csv(score, fps).decode("ascii"))))
    assert document["schema"] == "scorebreath.curves/1"
    assert (document["body"], document["duration"]) == ("body", score.duration)
    assert Fraction(*document["fps"]) == fps
    assert document["frames"] == len(rows)
    assert [channel["name"] for channel in document["channels"]] == list(rows[0])[1:]
    for column, channel in zip(curves(score).table, document["channels"], strict=True):
        assert (channel["unit"], channel["meaning"]) == (column.unit, column.meaning)
        assert channel["range"] == [column.low, column.high]
        assert channel["values"] == [float(row[column.name]) for row in rows]


def test_blocks_leave_no_seam() -> None:
    score = build([Breath()] * 3)
    fps = Fraction(1000)
    assert frame_count(score.duration, fps) > 2 * BLOCK
    rows = as_csv(score, fps).splitlines()[1:]
    assert [row.split(b",")[0] for row in rows] == [b"%d.%03d000" % divmod(i, 1000) for i in range(len(rows))]
    document = json.loads(as_json(score, fps))
    assert [len(channel["values"]) for channel in document["channels"]] == [len(rows)] * len(document["channels"])


@pytest.mark.parametrize("name", ["curves.csv", "curves.json"])
def test_golden_bytes(name: str, golden: Callable[[str, bytes], None]) -> None:
    score = build([Breath(speech=0.8, text="One two."), Breath(profile="sine", speech=0.6, text="Three.")])
    events = [dataclasses.replace(e, phones=()) if isinstance(e, Utterance) else e for e in score.events]
    score = dataclasses.replace(score, events=tuple(events))  # so that no table of phones changes the bytes
    stream = io.BytesIO()
    FORMATS[name].write(stream, score, ExportOptions(fps=NTSC))
    golden(f"formats/{name}", stream.getvalue())


def test_an_empty_score_has_one_frame() -> None:
    score = score_of([])
    assert len(as_csv(score, NTSC).splitlines()) == 2
    assert json.loads(as_json(score, NTSC))["frames"] == 1


@pytest.mark.parametrize("write", [curves_csv.write, curves_json.write])
@pytest.mark.parametrize("fps", [Fraction(0), Fraction(-60), Fraction(HIGHEST + 1)])
def test_writers_refuse_an_impossible_rate(write: object, fps: Fraction) -> None:
    assert callable(write)
    with pytest.raises(InputError, match=f"fps={fps} must be above 0 and at most {HIGHEST}"):
        write(io.BytesIO(), curves(score_of([])), 1.0, fps)


@pytest.mark.parametrize("name", FORMATS)
def test_the_table_of_formats(name: str) -> None:
    """Every row writes something its suffix can read, and says what."""
    row = format_named(name)
    stream = io.BytesIO()
    row.write(stream, build([Breath(), Breath()]), ExportOptions(fps=Fraction(10)))
    text = stream.getvalue().decode("utf-8")
    if row.suffix == ".csv":
        table = list(csv.reader(io.StringIO(text)))
        assert len(table) > 2 and len({len(cells) for cells in table}) == 1
    elif row.suffix == ".json":
        assert json.loads(text)["schema"]
    elif row.suffix == ".xml":
        assert ElementTree.fromstring(text).tag
    else:
        assert row.suffix == ".fap" and text.startswith("2.1 ")
    assert row.name == name and row.what
    assert row.suffix == ".xml" or row.name.endswith(row.suffix)


def test_an_unknown_format_is_refused_with_the_known_ones() -> None:
    with pytest.raises(InputError, match=r"'fbx'.*curves\.csv.*groups\.csv"):
        format_named("fbx")


def test_a_score_of_two_bodies_asks_whose_curves() -> None:
    score = build([Breath()])
    two = dataclasses.replace(score, bodies=(*score.bodies, dataclasses.replace(score.bodies[0], id="other")))
    with pytest.raises(InputError, match="'body', 'other'"):
        FORMATS["curves.csv"].write(io.BytesIO(), two, ExportOptions())
    stream = io.BytesIO()
    FORMATS["curves.json"].write(stream, two, ExportOptions(body="other"))
    assert json.loads(stream.getvalue())["body"] == "other"
    assert math.isclose(json.loads(stream.getvalue())["duration"], score.duration)
