"""Norms: every row measures what it says, on people whose breathing is known."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.report.norms import norms
from scorebreath.report.norms.acoustics import SOUND
from scorebreath.report.norms.laws import laws
from scorebreath.report.norms.places import SITES, splits
from scorebreath.report.norms.table import ROWS
from scorebreath.score.document import Score
from scorebreath.score.events import Pause, Utterance
from scorebreath.units import snap
from tests.curves.scores import Breath, scores, shifted, without
from tests.report.people import EVEN, person, tidal, with_events, with_phones

TWO = (EVEN, dataclasses.replace(EVEN, before=0.2, inspiration=0.8, speech=6.0, to_volume=0.6))
"""Two groups of which everything is known."""


def measured(score: Score, name: str) -> list[float]:
    return [round(float(value), 6) for value in np.ravel(norms(score).values[name])]


def known() -> Score:
    """TWO and one more, then rest; 16, 24 and 16 syllables; a comma, then a sentence's end."""
    score = person((*TWO, EVEN), syllables=(16, 24, 16), sites=("comma", "sentence", "text end"))
    score = with_phones(score, "g2.say", 2.0, -0.25, 3.75)
    return with_events(score, *tidal(snap(score.duration), 4))


EXPECTED: dict[str, list[float]] = {
    "group_speech": [4.0, 6.0, 4.0],
    "group_with_inspiration": [4.66, 6.86, 4.66],
    "syllables": [16, 24, 16],
    "articulation_rate": [4.0, round(24 / 5.75, 6), 4.0],
    "cycle_rate": [round(60 / length, 6) for length in (4.86, 6.96, 5.16)],
    "inspiration": [0.6, 0.8, 0.6],
    "inspiration_syllables": [0.6, 16, 0.8, 24, 0.6, 16],
    "inspiratory_fraction": [round(part / whole, 6) for part, whole in ((0.6, 4.86), (0.8, 6.96), (0.6, 5.16))],
    "breath_pause": [1.06, 0.76],
    "silence_in_sentence": [0.28],
    "silence_after_sentence": [0.16],
    "silence_after_paragraph": [],
    "silence_after_breath": [0.12, 0.14, 0.12],
    "breathless_pause": [0.25],
    "rest_rate": [15.0] * 3,
    "rest_inspiration": [1.6] * 3,
    "rest_fraction": [0.4] * 3,
    "rest_volume": [0.5] * 3,
    "sites": [SITES.index("comma"), SITES.index("sentence")],
    "at_punctuation": [1, 1],
    "at_clauses": [1, 1],
    "at_boundaries": [1, 1],
    "inside_words": [0, 0],
    "initiation": [52.0, 60.0, 52.0],
    "termination": [36.0, 36.0, 38.0],
    "excursion": [16.0, 24.0, 14.0],
    "volume_per_syllable": [1.0, 1.0, 0.875],
    "millilitres_per_syllable": [50.0, 50.0, 43.75],
    "speech_flow": [0.2, 0.2, 0.175],
    "lowest_volume": [36.0],
    "highest_volume": [60.0],
    "volume_sum": [0.0],
}
"""Of `known`; the laws of movement and the rows about sound have tests of their own."""


@pytest.mark.parametrize("name", EXPECTED)
def test_a_row_measures_what_is_known(name: str) -> None:
    assert measured(known(), name) == pytest.approx(EXPECTED[name], abs=2e-6)


def test_no_row_is_left_out() -> None:
    elsewhere = {"largest_flow", "change_over_flow", "continuity"} | {row.name for row in ROWS if row.part == SOUND}
    assert {row.name for row in ROWS} == set(EXPECTED) | elsewhere


def test_numbers_of_a_row() -> None:
    breaths = [dataclasses.replace(EVEN, speech=snap(3.0 + 0.1 * number)) for number in range(21)]
    row = norms(person(breaths))["group_speech"]
    assert (row.n, row.lowest, row.highest) == (21, 3.0, 5.0)
    assert (row.value, row.median, row.p5, row.p95) == pytest.approx((4.0, 4.0, 3.1, 4.9))
    assert row.sd == pytest.approx(np.std(3.0 + 0.1 * np.arange(21), ddof=1))


def test_a_group_without_a_breath_of_its_own_belongs_to_the_breath_before() -> None:
    score = person(3, syllables=(10, 5, 7))
    merged = norms(without(without(score, "g2.in"), "g2.before"))
    assert merged.groups == 2
    assert merged["syllables"].values.tolist() == [15, 7]
    assert merged["group_speech"].values.tolist() == pytest.approx([4.0 + 0.76 + 4.0, 4.0])
    assert merged["breathless_pause"].values.tolist() == pytest.approx([0.76])


def test_a_group_that_is_said_in_parts_counts_once() -> None:
    score = person(2, syllables=(10, 12))
    said = next(event for event in score.of(Utterance) if event.id == "g1.say")
    half = dataclasses.replace(said, id="g1.more", onset=snap(said.onset + 2.5), duration=1.5, phones=(), words=())
    whole = dataclasses.replace(said, duration=2.0, phones=(dataclasses.replace(said.phones[0], duration=2.0),))
    events = tuple(whole if event.id == "g1.say" else event for event in score.events)
    found = norms(with_events(dataclasses.replace(score, events=events), half))
    assert found["syllables"].values.tolist() == [10, 12]
    assert found["breathless_pause"].values.tolist() == pytest.approx([0.5])
    assert found["group_speech"].values[0] == pytest.approx(4.0)


def test_groups_that_interrupt_each_other_count_once() -> None:
    score = person(2, syllables=(10, 12))
    again = dataclasses.replace(next(score.of(Utterance)), id="again", onset=snap(score.duration + 1.0))
    assert norms(with_events(score, again))["syllables"].values.tolist() == [10, 12]


def test_what_the_markup_asks_for_is_no_habit() -> None:
    score = person(3)
    plain = norms(score)
    said = next(event for event in score.of(Utterance) if event.id == "g1.say")
    asked = Pause(id="p", body="body", onset=snap(said.end), duration=0.05, kind="asked")
    found = norms(with_events(score, asked))
    assert (plain["breath_pause"].n, found["breath_pause"].n) == (2, 1)
    assert (plain["cycle_rate"].n, found["cycle_rate"].n) == (2, 1)
    assert found["group_speech"].n == plain["group_speech"].n == 3


def test_sniffs_end_no_group_and_gasps_are_not_measured() -> None:
    score = person(3)
    second = next(event for event in score.events if event.id == "g2.in")
    for kind, groups, inspirations in (("sniff", 2, 2), ("gasp", 3, 2)):
        other = dataclasses.replace(second, kind=kind)  # type: ignore[call-arg]
        events = tuple(other if event.id == "g2.in" else event for event in score.events)
        found = norms(dataclasses.replace(score, events=events))
        assert (found.groups, found["inspiration"].n) == (groups, inspirations)
        assert found["initiation"].n == 2


def test_places_that_the_markup_asks_for_count_where_a_mark_stands() -> None:
    score = person(5, sites=("word", "tag", "phrase", "marker", "text end"))
    assert measured(score, "at_punctuation") == [0, 1, 0, 1]  # the text of each group ends with a full stop
    assert measured(score, "at_boundaries") == [0, 1, 1, 1]
    bare = dataclasses.replace(score, text=score.text.replace(".", "x"))
    assert measured(bare, "at_punctuation") == [0, 0]
    shares = norms(score)["sites"].shares
    assert {name: share for name, share in shares.items() if share} == dict.fromkeys(
        ("word", "tag", "phrase", "marker"), 25.0
    )


def test_a_breath_inside_a_word_is_found() -> None:
    score = person(12)
    first, second = score.groups[:2]
    groups = (
        dataclasses.replace(first, source=(first.source[0], first.source[1] - 3)),
        dataclasses.replace(second, source=(first.source[1] - 3, second.source[1])),
        *score.groups[2:],
    )
    found = norms(dataclasses.replace(score, groups=groups))["inside_words"]
    assert found.value == pytest.approx(100 / 11)
    assert str(found.verdict) == "outside: above"
    assert str(norms(score)["inside_words"].verdict) == "within"


@pytest.mark.parametrize(
    ("text", "place", "inside"),
    [
        ("ein Wort", (3, 4), False), ("Wort", (2, 2), True), ("Wort.", (4, 4), False), ("don’t", (4, 4), True),
        ("dogs' tails", (5, 6), False), ("3.14", (2, 2), False), ("世界", (1, 1), False), ("สวัสดี", (2, 2), False),
        ("", (0, 0), False), ("a", (1, 1), False), ("한국어", (1, 1), True),
    ],
)  # fmt: skip
def test_inside_a_word(text: str, place: tuple[int, int], inside: bool) -> None:
    assert splits(text, place) is inside


class Bent:
    """Curves that break a law on purpose."""

    def __init__(self, *, off: float = 0.0, jump: float = 0.0, flow: float = 1.0) -> None:
        self.off, self.jump, self.flow = off, jump, flow

    def sample(self, times: np.ndarray, names: tuple[str, ...]) -> np.ndarray:
        wave = 0.4 + 0.2 * np.sin(times)
        volume = wave + self.jump * (times > 5.003)
        chest = 0.6 * (wave - 0.4)
        return np.stack((volume, chest, 0.4 * (wave - 0.4) + self.off, 5.0 * 0.2 * np.cos(times) * self.flow), axis=1)


@pytest.mark.parametrize(
    ("bent", "sum_error", "flow", "ratio", "over"),
    [
        (Bent(), 0.0, 1.0, 0.5, 1.0),
        (Bent(off=0.01), 5.0, 1.0, 0.5, 1.0),
        (Bent(jump=0.1), 30.0, 25.3, 0.98, 84.0),
        (Bent(flow=0.5), 0.0, 1.0, 0.5, 2.0),
    ],
)
def test_the_laws_see_what_breaks_them(bent: Bent, sum_error: float, flow: float, ratio: float, over: float) -> None:
    found = laws(bent, 20.0, 0.4, 5.0)  # type: ignore[arg-type]
    assert found is not None
    assert found.sum_error == pytest.approx(sum_error, rel=0.15, abs=1e-6)
    assert found.flow == pytest.approx(flow, rel=0.02)
    assert found.ratio == pytest.approx(ratio, abs=0.02)
    assert found.over_flow == pytest.approx(over, rel=0.05)


def test_what_would_be_behind_a_cut_end_is_nobody_s_movement() -> None:
    found = laws(Bent(jump=0.1), 5.0, 0.4, 5.0)  # type: ignore[arg-type]
    assert found is not None
    assert (found.flow, found.over_flow) == pytest.approx((1.0, 1.0), rel=0.05)


@pytest.mark.parametrize("place", [2, 13, 20, 31, 38])
def test_the_laws_look_everywhere(place: int) -> None:
    """Also beyond the first block of frames."""
    breaths = [dataclasses.replace(EVEN, speech=40.0)] * 39
    fast = dataclasses.replace(EVEN, inspiration=0.1, to_volume=0.9)
    assert norms(person(breaths))["largest_flow"].value == pytest.approx(0.16 * 5 / 0.6 * np.pi / 2, rel=0.01)
    found = norms(person([*breaths[:place], fast, *breaths[place:]]))
    assert found["largest_flow"].value == pytest.approx(0.54 * 5 / 0.1 * np.pi / 2, rel=0.05)
    assert str(found["largest_flow"].verdict) == "outside: above"


@settings(max_examples=25, deadline=None)
@given(scores(max_groups=5), st.integers(1, 10**7))
def test_any_score_has_norms_and_they_do_not_depend_on_the_time(score: Score, later: int) -> None:
    found = norms(score)
    assert [each.row for each in found.results] == list(ROWS)
    for each in found.results:
        assert np.all(np.isfinite(each.values))
        assert each.n == len(each.values)
        if each.median is not None and each.p5 is not None and each.p95 is not None:
            assert each.lowest <= each.p5 <= each.median <= each.p95 <= each.highest  # type: ignore[operator]
    moved = shifted(dataclasses.replace(score, duration=snap(score.duration + later / 1e6)), later / 1e6)
    for name, values in norms(moved).values.items():
        if name not in ("largest_flow", "change_over_flow", "continuity", "volume_sum"):
            assert values == pytest.approx(found.values[name], abs=2e-3), name


@pytest.mark.parametrize("breath", [Breath(), Breath(speech=0.1, inspiration=0.05), Breath(before=0.0, after=0.0)])
def test_a_breath_is_itself_wherever_it_stands(breath: Breath) -> None:
    values = norms(person([breath] * 8)).values["group_speech"]
    assert np.ptp(values) < 1e-6
