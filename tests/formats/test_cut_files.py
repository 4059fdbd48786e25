"""Files of a Score with cuts: what was not said is not in them."""

from __future__ import annotations

import csv
import dataclasses
import io
from fractions import Fraction

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.curves.lips.keys import key_times
from scorebreath.formats import groups_csv, maryxml
from scorebreath.formats.formats import FORMATS, ExportOptions
from scorebreath.score.document import Score
from scorebreath.score.events import Utterance
from scorebreath.units import snap
from tests.curves.cutting import compiled, cut_at
from tests.curves.scores import Breath, build


def rows(score: Score) -> list[dict[str, str]]:
    stream = io.BytesIO()
    groups_csv.write(stream, score)
    return list(csv.DictReader(io.StringIO(stream.getvalue().decode("utf-8"), newline="")))


def test_a_group_ends_at_its_cut_and_the_next_one_never_comes() -> None:
    """It closes as cut; the other has no times."""
    first, second = rows(cut_at(build([Breath(), Breath()]), 1.6))
    assert (first["closing"], float(first["end"]), float(first["speech_duration"])) == ("cut", 1.6, 0.84)
    assert 0.36 < float(first["end_volume"]) < 0.54
    assert (second["onset"], second["end"], second["closing"]) == ("", "", "")
    assert rows(build([Breath()]))[0]["closing"] == "final"


def test_a_breath_ends_at_its_cut() -> None:
    """As far as it was drawn in."""
    (row,) = rows(cut_at(build([Breath(before=0.1, inspiration=0.6)]), 0.4))
    assert float(row["inspiration_duration"]) == 0.3
    assert float(row["to_volume"]) == pytest.approx((0.38 + 0.54) / 2)
    assert row["speech_onset"] == row["closing"] == ""


def test_maryxml_has_the_words_that_were_said() -> None:
    """And no others."""
    score = compiled()
    said = next(score.of(Utterance))
    time = snap(said.onset + said.words[3].onset + 0.01)
    stream = io.BytesIO()
    maryxml.write(stream, cut_at(score, time))
    written = stream.getvalue().decode()
    assert written.count("<t ") + written.count("<t>") >= 4
    assert said.words[3].text in written
    assert "west" not in written


@pytest.mark.parametrize("name", sorted(FORMATS))
def test_every_format_takes_a_score_with_cuts(name: str) -> None:
    """Bytes come, and others than without the cut."""
    score = dataclasses.replace(compiled(), duration=6.0)
    made = []
    for each in (score, cut_at(score, 3.0)):
        stream = io.BytesIO()
        FORMATS[name].write(stream, each, ExportOptions(fps=Fraction(30)))
        made.append(stream.getvalue())
    assert len(made[1]) > 100
    assert made[0] != made[1]


def test_key_frames_are_of_what_is_seen() -> None:
    """Closures before the cut have their edges, those that never came have none."""
    score = dataclasses.replace(compiled(), duration=10.0)
    cut = cut_at(score, 3.0)
    whole, keys = (key_times(curves(each), 10.0, Fraction(10)) for each in (score, cut))
    assert np.array_equal(whole[whole < 3.0], keys[keys < 3.0])
    frames = round(7.0 * 10)
    assert len(whole[whole > 3.4]) > len(keys[keys > 3.4])
    assert len(keys[keys > 3.4]) <= frames
