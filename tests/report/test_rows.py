"""Rows of time and places of words: nothing is lost, nothing overlaps without need."""

from __future__ import annotations

import dataclasses
import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.report.rows import breaths, place, wrap
from tests.curves.scores import Breath, build, score_of, without


@given(
    st.floats(0, 500),
    st.lists(st.floats(0, 500), max_size=60).map(sorted),
    st.floats(1, 30),
    st.integers(1, 1000),
)
def test_rows_are_contiguous_and_of_their_length(
    duration: float, limits: list[float], longest: float, most: int
) -> None:
    rows = wrap(duration, limits, longest, most)
    assert rows[0].start == 0.0
    assert all(one.end == two.start for one, two in itertools.pairwise(rows))
    assert all(row.end - row.start <= longest * (1 + 1e-9) for row in rows)
    assert all(longest / 2 - 1e-9 <= row.end - row.start for row in rows[:-1])
    assert len(rows) <= most
    assert rows[-1].end == duration or len(rows) == most


def test_rows_break_before_a_breath() -> None:
    assert [row.end for row in wrap(40.0, [0.5, 4.2, 8.1, 12.9, 17.0], 10.0, 9)] == [8.1, 17.0, 27.0, 37.0, 40.0]


def test_a_score_of_no_length_is_one_row() -> None:
    assert wrap(0.0, [], 10.0, 9) == ((0.0, 0.0),)


def test_breath_groups_last_to_the_last_phone() -> None:
    first, second = breaths(build([Breath(before=0.1, inspiration=0.6, after=0.06, speech=2.5)] * 2), "body")
    assert (first.onset, first.inspired, first.end) == pytest.approx((0.1, 0.7, 3.26))
    assert second.onset == pytest.approx(3.36)
    assert breaths(build([Breath()]), "nobody") == ()


def test_breath_groups_without_an_inspiration_or_speech() -> None:
    score = build([Breath()])
    (silent,) = breaths(without(score, "g1.say"), "body")
    assert (silent.onset, silent.end) == pytest.approx((0.1, 0.7))
    (unbreathed,) = breaths(without(score, "g1.in"), "body")
    assert unbreathed.onset == unbreathed.inspired == pytest.approx(0.76)
    assert breaths(dataclasses.replace(score_of([]), groups=score.groups), "body") == ()


@given(st.lists(st.tuples(st.text(max_size=12), st.floats(0, 1000)), max_size=40), st.integers(1, 3))
def test_every_word_keeps_its_onset(words: list[tuple[str, float]], lines: int) -> None:
    words.sort(key=lambda word: word[1])
    labels = place(words, 10.0, lines)
    assert [(label.text, label.x) for label in labels] == words
    assert all(0 <= label.line < lines for label in labels)


def test_words_take_a_second_line_only_where_there_is_no_room() -> None:
    labels = place([("one", 0.0), ("two", 100.0), ("three", 110.0), ("four", 115.0), ("five", 400.0)], 10.0, 2)
    assert [label.line for label in labels] == [0, 0, 1, 0, 0]
