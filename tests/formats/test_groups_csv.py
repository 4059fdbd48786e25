"""Breath groups as a table: a row a breath, safe to open."""

from __future__ import annotations

import csv
import dataclasses
import io
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.formats import groups_csv
from scorebreath.score.document import CutReason, Group, Score
from tests.curves.acts import breathe_in, breathe_out
from tests.curves.scores import Breath, build, score_of, utterance, without


def rows(score: Score) -> list[dict[str, str]]:
    stream = io.BytesIO()
    groups_csv.write(stream, score)
    return list(csv.DictReader(io.StringIO(stream.getvalue().decode("utf-8"), newline="")))


def group(text: str, rule: str = "") -> Group:
    return Group(
        id="g1", body="body", source=(0, len(text)), text=text, syllables=1, sentence_type="statement",
        cut=CutReason(site="word", rule=rule),
    )  # fmt: skip


def test_a_row_is_the_breath_group_of_b52() -> None:
    first, second = rows(build([Breath(before=0.1, inspiration=0.6, after=0.06, speech=2.5)] * 2))
    assert float(first["onset"]) == float(first["inspiration_onset"]) == 0.1
    assert float(first["duration"]) == 3.16  # from the inspiration's onset to the last phone
    assert float(first["end"]) == 3.26
    assert (float(first["speech_onset"]), float(first["speech_duration"])) == (0.76, 2.5)
    assert (first["from_volume"], first["to_volume"], first["end_volume"]) == ("0.380000", "0.540000", "0.360000")
    assert second["from_volume"] == "0.360000"
    assert (first["syllables"], first["closing"], first["cut_site"], first["cut_rule"]) == (
        "16", "final", "sentence", "test",
    )  # fmt: skip


def test_a_group_with_a_sigh_before_it_and_a_sniff_in_it() -> None:
    """Its breath is the one for speech, its end that of the last word, its air what was left then."""
    score = build([Breath(before=3.0, inspiration=0.6, after=0.06, speech=2.5)])
    sigh = breathe_in(id="sigh", kind="sigh", onset=0.0, duration=1.0, group="g1")
    out = breathe_out(id="out", kind="sigh", onset=1.0, duration=1.0, group="g1")
    sniff = breathe_in(id="sniff", kind="sniff", onset=6.16, duration=0.3, group="g1")
    more = dataclasses.replace(utterance(Breath(speech=1.0), 6.46, 0, id="more", group="g1"), closing="question")
    spent = breathe_out(id="spent", onset=6.46, duration=1.0, from_volume=0.58, to_volume=0.31, group="g1")
    events = (sigh, out, *(e for e in score.events if e.id != "g1.before"), sniff, more, spent)
    (row,) = rows(dataclasses.replace(score, events=events))
    assert (row["onset"], row["inspiration_onset"], row["speech_onset"]) == ("3.000000", "3.000000", "3.660000")
    assert (row["end"], row["duration"], row["speech_duration"]) == ("7.460000", "4.460000", "3.800000")
    assert (row["from_volume"], row["to_volume"], row["end_volume"]) == ("0.380000", "0.540000", "0.310000")
    assert row["closing"] == "question"


def test_missing_events_leave_empty_cells() -> None:
    score = build([Breath()])
    (row,) = rows(without(score, "g1.in"))
    assert row["inspiration_onset"] == row["from_volume"] == ""
    assert row["onset"] == row["speech_onset"] == "0.760000"
    (row,) = rows(score_of([], [group("alone")], "alone"))
    assert row["onset"] == row["end"] == row["duration"] == row["closing"] == ""
    assert row["text"] == "alone"


def test_no_groups_is_a_header() -> None:
    stream = io.BytesIO()
    groups_csv.write(stream, score_of([]))
    assert stream.getvalue().decode() == ",".join(groups_csv.COLUMNS) + "\n"


@given(st.text(st.characters(exclude_categories=["Cs"])))
def test_any_text_comes_back(text: str) -> None:
    (row,) = rows(score_of([], [group(text)], text))
    assert row["text"].removeprefix("'" if text[:1] in {*"=+-@\t\r"} and text else "") == text
    assert not row["text"].startswith(("=", "+", "-", "@", "\t", "\r"))


@pytest.mark.parametrize("text", ["=HYPERLINK(1)", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1"])
def test_text_is_no_formula(text: str) -> None:
    (row,) = rows(score_of([], [group(text, rule=text)], text))
    assert row["text"] == row["cut_rule"] == "'" + text


def test_half_a_surrogate_pair_does_not_stop_the_table() -> None:
    (row,) = rows(score_of([], [group("\ud800!")]))
    assert row["text"] == "?!"


def test_golden_bytes(golden: Callable[[str, bytes], None]) -> None:
    score = build([Breath(text='He said "no", twice;\nthen left.'), Breath(text="- Grüße, 世界.")])
    score = dataclasses.replace(score, groups=(*score.groups, dataclasses.replace(score.groups[0], id="silent")))
    stream = io.BytesIO()
    groups_csv.write(stream, score)
    golden("formats/groups.csv", stream.getvalue())
