"""Norms: which figures apply, what the verdicts say, and what hostile Scores do not break."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from scorebreath.errors import InputError, ScoreError
from scorebreath.report.norms import norms
from scorebreath.report.norms.figures import NO_FIGURE, TOO_FEW, Figure, Verdict, compare, together
from scorebreath.report.norms.row import correlation
from scorebreath.report.norms.sources import MARKS, SOURCES
from scorebreath.report.norms.table import ROWS
from scorebreath.report.norms.words import COLUMNS, about, event, figure_said, line, shares_said, why
from scorebreath.score.document import Score, Site
from scorebreath.score.events import State
from scorebreath.units import snap
from tests.curves.scores import Breath, score_of
from tests.report.people import EVEN, person, tidal, with_events

ROOT = Path(__file__).resolve().parents[2]


def verdict(score: Score, name: str) -> str:
    return str(norms(score)[name].verdict)


def lengths(mean: float, spread: float = 1.5, count: int = 20) -> Score:
    """Groups of speech that are so long on average, evenly spread."""
    around = np.linspace(-1.0, 1.0, count)
    around *= spread / np.std(around, ddof=1)
    return person([dataclasses.replace(EVEN, speech=snap(mean + float(each))) for each in around])


@pytest.mark.parametrize(
    ("mean", "spread", "said"),
    [(4.0, 1.5, "within"), (3.2, 1.5, "outside: below"), (6.0, 1.5, "outside: above"), (4.0, 0.5, "outside: below"),
     (6.0, 0.5, "outside: below and above")],
)  # fmt: skip
def test_a_mean_and_a_spread_are_within_or_outside(mean: float, spread: float, said: str) -> None:
    score = lengths(mean, spread)
    row = norms(score)["group_speech"]
    assert row.value == pytest.approx(mean, abs=1e-5) and row.sd == pytest.approx(spread, abs=1e-5)
    assert str(row.verdict) == said
    assert bool(why(row)) == (said != "within")


def test_why_names_the_figure_that_is_missed() -> None:
    said = why(norms(lengths(6.0, 0.5))["group_speech"])
    assert said == "mean 6.00 is above 3.3 to 4.8 s; SD 0.50 is below 1 to 2.2 s; mean 6.00 is above 4.05 ± 1.5 s"


def test_single_breaths_are_within_or_outside() -> None:
    breaths = [EVEN] * 11
    assert verdict(person(breaths), "inspiration") == "within"
    assert verdict(person([*breaths, dataclasses.replace(EVEN, inspiration=0.24)]), "inspiration") == "outside: below"
    assert verdict(person([*breaths, dataclasses.replace(EVEN, inspiration=1.2)]), "inspiration") == "outside: above"
    at_the_end = dataclasses.replace(EVEN, inspiration=1.1)
    assert verdict(person([*breaths, at_the_end]), "inspiration") == "within"


@pytest.mark.parametrize("count", [0, 1, 2, 4])
def test_few_breaths_are_too_few(count: int) -> None:
    score = person(count) if count else score_of([], duration=3.0)
    found = norms(score)
    numbers = {"lowest_volume", "highest_volume", "volume_sum", "largest_flow", "change_over_flow", "continuity"}
    words = {each.row.name: each.verdict for each in found.results if each.row.name not in numbers}
    assert found.groups == count
    told = {name for name, each in words.items() if each != TOO_FEW}
    assert told <= {"inside_words", "sites"} if count > 1 else not told
    if not count:
        assert {each.verdict for each in found.results} == {TOO_FEW}
        assert found.counts["too few"] == len(ROWS)


@pytest.mark.parametrize(("count", "few"), [(10, True), (11, False)])
def test_a_share_needs_ten_breaths(count: int, few: bool) -> None:
    assert (verdict(person(count), "at_punctuation") == "too few") is few


def test_what_nobody_has_published_has_no_verdict() -> None:
    found = norms(person(12, sites=["paragraph"] * 11))
    assert found["silence_after_paragraph"].n == 11
    assert found["silence_after_paragraph"].verdict == NO_FIGURE
    assert found["sites"].verdict == NO_FIGURE
    assert found["sites"].shares["paragraph"] == 100.0


def test_style_chooses_the_figures() -> None:
    sites: list[Site] = ["sentence", "phrase"] * 10
    reading = person(20, sites=sites)
    talking = person(20, sites=sites, parameters={"style": "spontaneous"})
    assert norms(talking).who.style == "spontaneous"
    assert [verdict(each, "at_punctuation") for each in (reading, talking)] == ["outside: below", "outside: below"]
    sites = ["sentence", "sentence", "sentence", "word"] * 5
    both = [person(20, sites=sites, parameters=given) for given in ({}, {"style": "spontaneous"})]
    assert [verdict(each, "at_punctuation") for each in both] == ["outside: below", "within"]
    cited = [{each.figure.mean for each in norms(one)["group_speech"].compared} for one in both]
    assert 4.05 in cited[0] and 4.88 not in cited[0]
    assert 4.88 in cited[1] and 4.05 not in cited[1]


def test_age_posture_and_loudness_choose_the_figures() -> None:
    def figures(name: str, **parameters: object) -> set[str]:
        found = norms(person(12, parameters=parameters))[name]
        return {figure_said(each.figure, "") for each in found.compared}

    assert "mean 18 to 20" in figures("syllables")
    assert "mean 13 to 16" in figures("syllables", age=70.0) and "mean 18 to 20" not in figures("syllables", age=70.0)
    assert figures("rest_rate", age=8.0) == set()
    assert "mean 42 to 63" in figures("initiation") and "mean 55 to 85" not in figures("initiation")
    assert figures("initiation", speaking_loudness=200.0) == {"mean 55 to 85"}
    assert figures("initiation", posture="supine") == set()
    assert norms(person(12, parameters={"posture": "supine"}))["initiation"].verdict == NO_FIGURE


def test_the_papers_models_are_asked_for_what_the_papers_say() -> None:
    breaths = [dataclasses.replace(EVEN, inspiration=snap(0.5 + 0.01 * number)) for number in range(20)]
    coupled = [6 + number for number in range(20)]
    found = {
        model: norms(person(breaths, syllables=coupled, model=model))["inspiration_syllables"]
        for model in ("natural", "bernardet-2017")
    }
    assert found["natural"].value == found["bernardet-2017"].value == pytest.approx(1.0)
    assert {name: str(each.verdict) for name, each in found.items()} == {
        "natural": "outside: above", "bernardet-2017": "outside: above",
    }  # fmt: skip
    even = {model: verdict(person(20, syllables=coupled, model=model), "inspiration_syllables") for model in found}
    assert even == {"natural": "outside: below", "bernardet-2017": "within"}


def test_rest_is_compared_where_there_is_rest() -> None:
    score = person(6)
    rested = with_events(score, *tidal(snap(score.duration), 7))
    assert verdict(score, "rest_rate") == "too few"
    assert {verdict(rested, name) for name in ("rest_rate", "rest_fraction", "rest_inspiration", "rest_volume")} == {
        "within"
    }
    panting = with_events(score, *tidal(snap(score.duration), 7, inspiration=0.5, cycle=1.0, depth=0.4))
    assert verdict(panting, "rest_rate") == verdict(panting, "rest_volume") == "outside: above"
    assert verdict(panting, "rest_inspiration") == "outside: below"


def test_states_are_named() -> None:
    score = person(3)
    state = State(id="s", body="body", onset=0.0, duration=1.0, name="anxious", start=0.0, target=0.8, ramp=0.5)
    assert norms(with_events(score, state)).states == ("anxious",)
    assert norms(score).states == ()


def test_of_two_bodies_one_must_be_named() -> None:
    score = person(6)
    other = dataclasses.replace(score.bodies[0], id="other")
    both = dataclasses.replace(score, bodies=(*score.bodies, other))
    with pytest.raises(InputError, match="'body', 'other'"):
        norms(both)
    assert norms(both, body="body").groups == 6
    assert norms(both, body="other").groups == 0
    with pytest.raises(InputError, match="nobody"):
        norms(both, body="nobody")


def test_breaths_that_overlap_are_refused() -> None:
    score = person(3)
    again = dataclasses.replace(next(event for event in score.events if event.id == "g1.in"), id="again")
    with pytest.raises(ScoreError, match="overlap"):
        norms(with_events(score, again))


@pytest.mark.parametrize(
    "parameters",
    [{"style": ["x"]}, {"style": None, "age": "old"}, {"age": True}, {"age": 1e30}, {"posture": 3}, {"age": -5.0},
     {"speaking_loudness": "loud"}, {"age": float("nan")}],
)  # fmt: skip
def test_nonsense_among_the_parameters_is_left_out(parameters: dict[str, object]) -> None:
    found = norms(person(12, parameters=parameters))
    assert found.who.style == "reading"
    assert math.isfinite(found.who.age)
    json.dumps([about(found), *map(event, found.results)], allow_nan=False)


def test_groups_that_name_nothing_are_borne() -> None:
    score = person(12)
    bare = dataclasses.replace(
        score, groups=(), events=tuple(dataclasses.replace(event, group=None) for event in score.events)
    )
    found = norms(bare)
    assert (found.groups, found["syllables"].values.max(), found["sites"].n) == (12, 0, 0)
    assert found["volume_per_syllable"].n == found["articulation_rate"].n == 0
    assert found["group_speech"].n == 12


def test_a_body_that_never_moves() -> None:
    still = dataclasses.replace(EVEN, to_volume=0.38, end_volume=0.38)
    found = norms(person([still] * 6))
    assert found["continuity"].verdict == TOO_FEW
    assert found["lowest_volume"].value == 38.0


def test_correlation_of_too_little() -> None:
    assert correlation(np.array([[1.0, 2.0], [1.0, 3.0]])) == 0.0
    assert norms(person(9))["inspiration_syllables"].value is None


def test_rounding_is_no_reason_to_be_outside() -> None:
    limits = (0.25, 1.1)
    assert {str(compare(np.array([value]), limits)) for value in (0.249996, 0.25, 1.1, 1.100004)} == {"within"}
    assert str(compare(np.array([1.10001]), limits)) == "outside: above"
    assert str(compare(np.array([0.24999]), limits)) == "outside: below"


def test_the_commonest_place_is_said_first() -> None:
    sites: tuple[Site, ...] = ("word", *("comma",) * 7, *("sentence",) * 3)
    said = shares_said(norms(person(12, sites=sites))["sites"])
    assert said == "comma 64 %, sentence 27 %, word 9 %"


def test_verdicts_together() -> None:
    above, below = Verdict(word="outside", direction="above"), Verdict(word="outside", direction="below")
    assert together([above, below]) == compare(np.array([0.0, 9.0]), (1.0, 2.0))
    assert together([TOO_FEW, above]) == above
    assert together([TOO_FEW, NO_FIGURE]) == TOO_FEW
    assert together([]) == NO_FIGURE


EVENT = {
    "name", "title", "part", "unit", "kind", "measured", "verdict", "direction", "why", "n", "value", "median", "sd",
    "p5", "p95", "lowest", "highest", "shares", "figures",
}  # fmt: skip
FIGURE = {
    "of", "low", "high", "mean", "sd", "source", "citation", "mark", "trust", "judges", "note", "verdict", "direction",
}  # fmt: skip
ABOUT = {
    "body", "style", "model", "age", "posture", "loudness", "route", "vital_capacity", "resting_volume", "states",
    "duration", "groups", "heard",
}  # fmt: skip


@pytest.mark.parametrize("count", [0, 1, 12])
def test_what_programs_are_told_keeps_its_keys(count: int) -> None:
    found = norms(person(count) if count else score_of([]))
    for each in found.results:
        told = event(each)
        assert set(told) == EVENT
        assert all(set(figure) == FIGURE for figure in told["figures"])
        assert set(line(each)) == set(COLUMNS)
        json.dumps(told, allow_nan=False)
    assert set(about(found)) == ABOUT


def test_the_table_holds_together() -> None:
    names = [row.name for row in ROWS]
    assert len(set(names)) == len(names) and len({row.title for row in ROWS}) == len(names)
    for row in ROWS:
        assert re.fullmatch(r"[a-z][a-z0-9_]*", row.name)
        assert len(row.title) <= 32 and row.measured and row.part
        for figure in row.figures:
            assert figure.source in SOURCES and figure.mark in MARKS
            assert figure.of in (("mean", "sd", "each") if row.kind == "values" else ("value",)), row.name
            assert (figure.mean is None) == (figure.low is not None or figure.high is not None), row.name
            low, high = figure.range or (0.0, 0.0)
            assert low <= high
    assert {figure.source for row in ROWS for figure in row.figures} == set(SOURCES)


ACCEPTED: dict[str, list[tuple[str, float | None, float | None]]] = {
    "group_speech": [("mean", 3.3, 4.8), ("sd", 1.0, 2.2)],
    "at_punctuation": [("value", 90.0, None), ("value", 60.0, 90.0)],
    "inside_words": [("value", 0.0, 0.0)],
    "inspiration": [("mean", 0.50, 0.72), ("each", 0.25, 1.10)],
    "inspiration_syllables": [("value", 0.3, 0.8), ("value", -0.1, 0.1)],
    "inspiratory_fraction": [("mean", 0.10, 0.20)],
    "rest_fraction": [("mean", 0.35, 0.45)],
    "largest_flow": [("value", None, 8.0)],
    "lowest_volume": [("value", 15.0, None)],
    "highest_volume": [("value", None, 95.0)],
    "volume_sum": [("value", None, 1.0)],
    "volume_per_syllable": [("mean", 0.5, 1.8)],
    "breath_level": [("mean", -27.0, -21.0)],
}
"""Physiology 10, as far as it concerns breathing; 3.5 is with the sounds."""


@pytest.mark.parametrize("name", ACCEPTED)
def test_the_acceptance_numbers_decide(name: str) -> None:
    row = next(row for row in ROWS if row.name == name)
    deciding = [(figure.of, figure.low, figure.high) for figure in row.figures if figure.judges]
    assert set(ACCEPTED[name]) <= set(deciding)


def test_the_document_lists_every_row_and_every_figure() -> None:
    text = (ROOT / "docs" / "norms.md").read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", text, re.MULTILINE))
    assert set(rows) == {row.name for row in ROWS}
    for row in ROWS:
        told = rows[row.name].replace("&#124;", "|")
        assert f"{row.unit} | {row.measured} |" in told
        for figure in row.figures:
            assert figure_said(figure, row.unit) in told, row.name
            assert f"{SOURCES[figure.source].short}, {figure.mark})" in told, row.name


def test_a_figure_has_a_range_only_where_it_tells_one() -> None:
    assert Figure(of="mean", source="wang", mark="V2", mean=4.0).range is None
    assert Figure(of="mean", source="wang", mark="V2", mean=4.0, sd=1.5).range == (2.5, 5.5)
    assert Figure(of="mean", source="wang", mark="V2", low=1.0).range == (1.0, math.inf)


def test_a_score_of_other_breaths_is_measured_too() -> None:
    found = norms(person([Breath(nose=1.0, mouth=0.0)] * 6))
    assert (found.who.route, norms(person([Breath(nose=0.0, mouth=1.0)])).who.route) == ("nose", "mouth")
    assert norms(person([Breath(nose=0.6, mouth=0.4)])).who.route == "both"


def test_a_score_of_thirty_years_takes_no_longer() -> None:
    score = dataclasses.replace(person(12), duration=1e9)
    assert norms(score).values["continuity"] == pytest.approx(norms(person(12)).values["continuity"], abs=1e-6)
