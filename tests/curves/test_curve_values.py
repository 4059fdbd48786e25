"""Numbers worked by hand: the papers' saw-tooth, the levels, the corners."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from scorebreath.curves.breathing import LEAD
from scorebreath.curves.curve_set import curves
from scorebreath.equations.bernardet import slope_expiration, slope_inspiration
from scorebreath.errors import InputError, ScoreError
from scorebreath.score.events import Hold, Inspiration, Lead, Level, Motion, Noise, Trapezoid, Utterance
from scorebreath.units import FLOOR_DB
from tests.curves.scores import MOTION, REST, Breath, build, inspiration, score_of, utterance, value

PLAIN = Breath(before=0.0, after=0.0)
UNIT = Motion(thorax=1.0, abdomen=1.0, shoulder=1.0, neck_pitch=1.0)


def test_the_driver_is_the_papers_saw_tooth() -> None:
    """S1 3.2 (B6, B12): slopes volume_lung / length_inspiration and -volume_lung / length_speech."""
    volume_lung, length_inspiration, length_speech = 0.32, 0.64, 1.28
    breath = Breath(
        before=0.0, after=0.0, inspiration=length_inspiration, speech=length_speech, to_volume=volume_lung,
        end_volume=0.0, motion=UNIT,
    )  # fmt: skip
    set_ = curves(build([breath, breath], resting=0.0))
    for begin in (0.0, length_inspiration + length_speech):
        for start, length, slope in (
            (begin, length_inspiration, slope_inspiration(volume_lung, length_inspiration)),
            (begin + length_inspiration, length_speech, slope_expiration(volume_lung, length_speech)),
        ):
            times = np.linspace(start + 1e-6, start + length - 1e-6, 50)
            driver = set_.sample(times, ["lung_volume", "thorax", "abdomen", "neck_pitch"])
            slopes = np.diff(driver, axis=0) / np.diff(times)[:, None]
            np.testing.assert_allclose(slopes, slope, atol=1e-6)
    peak = set_.sample([length_inspiration], ["thorax", "abdomen", "neck_pitch"])
    np.testing.assert_allclose(peak, volume_lung, atol=1e-12)


def test_volume_goes_where_the_events_say_and_rests_elsewhere() -> None:
    score = build([Breath(before=1.0, inspiration=0.5, after=0.25, speech=2.0, to_volume=0.58)], tail=1.0)
    got = value(score, "lung_volume", -5.0, 0.5, 1.0, 1.25, 1.5, 1.7, 2.75, 3.75, 4.5, 99.0)
    assert got == pytest.approx([REST, REST, REST, 0.48, 0.58, 0.58, 0.48, REST, REST, REST], abs=1e-12)


def test_half_sine_flow() -> None:
    score = build([dataclasses.replace(PLAIN, profile="sine", inspiration=0.5, to_volume=0.58)])
    assert value(score, "lung_volume", 0.25) == pytest.approx([0.48])
    assert value(score, "airflow", 0.25) == pytest.approx([0.2 * 5.0 / 0.5 * math.pi / 2])
    assert value(score, "airflow", 0.0) == pytest.approx([0.0])


def test_airflow_in_litres() -> None:
    score = build([dataclasses.replace(PLAIN, inspiration=0.5, speech=2.0, to_volume=0.58)])
    assert value(score, "airflow", -0.1, 0.2, 0.5, 1.5, 2.5, 3.0) == pytest.approx([0.0, 2.0, -0.5, -0.5, 0.0, 0.0])


def test_shapes_are_the_motion_times_the_volume_above_rest_within_their_range() -> None:
    strong = Motion(thorax=2.0, abdomen=9.0, shoulder=0.5, neck_pitch=-3.0)
    score = build([dataclasses.replace(PLAIN, inspiration=1.0, to_volume=0.58, end_volume=0.28, motion=strong)] * 2)
    names = ["thorax", "abdomen", "shoulder", "neck_pitch", "head_pitch"]
    top, low = curves(score).sample([1.0, 3.5], names)
    assert top.tolist() == pytest.approx([0.4, 1.0, 0.1, -0.6, -0.6])
    assert low.tolist() == pytest.approx([-0.2, -0.9, 0.0, 0.3, 0.3])


def test_an_inspiration_brings_its_motion_in_during_its_lead() -> None:
    other = Motion(thorax=0.5, abdomen=3.0, shoulder=0.1, neck_pitch=8.0)
    first = dataclasses.replace(PLAIN, speech=2.0, end_volume=0.30, share=0.7)
    score = build([first, dataclasses.replace(PLAIN, share=0.3, motion=other)])
    second = 2.6
    rest_share = value(score, "thorax_volume", second - LEAD - 0.1, second - LEAD / 2, second)
    above = [v - REST for v in value(score, "lung_volume", second - LEAD - 0.1, second - LEAD / 2, second)]
    assert rest_share == pytest.approx([0.7 * above[0], 0.5 * above[1], 0.3 * above[2]])
    assert value(score, "neck_pitch", second - LEAD / 2) == pytest.approx([(3.0 + 8.0) / 2 * above[1]])


def test_several_inspirations_within_one_lead_make_no_step() -> None:
    motions = [Motion(thorax=k, abdomen=1.0, shoulder=0.0, neck_pitch=0.0) for k in (1.0, 4.0, 2.0, 3.0)]
    quick = [
        Breath(before=0.0, inspiration=0.1, after=0.0, speech=0.1, to_volume=0.6, end_volume=0.5, motion=m)
        for m in motions
    ]
    score = build(quick)
    edges = np.array([event.onset for event in score.events])
    jump = curves(score).sample(edges + 1e-7, ["thorax"]) - curves(score).sample(edges - 1e-7, ["thorax"])
    assert np.max(np.abs(jump)) < 1e-4


def test_face_is_a_trapezoid() -> None:
    event = dataclasses.replace(
        inspiration(PLAIN, 1.0, REST), face=Trapezoid(attack=0.2, hold=0.1, release=0.3), mouth_open=0.5,
        nostril_flare=0.2, lead=Lead(mouth=0.2, nostril=0.0),
    )  # fmt: skip
    score = score_of([event])
    assert value(score, "mouth_open", 0.8, 1.0, 1.2, 1.3, 1.45, 1.6) == pytest.approx([0.0, 0.25, 0.5, 0.5, 0.25, 0.0])
    assert value(score, "nostril_flare", 0.999, 1.1, 1.25, 1.45) == pytest.approx([0.0, 0.1, 0.2, 0.1])


def test_a_face_rounded_longer_than_its_breath_ends_with_the_breath() -> None:
    event = dataclasses.replace(
        inspiration(PLAIN, 1.0, REST), face=Trapezoid(attack=0.2, hold=0.2, release=0.200002), mouth_open=1.0
    )
    before, after = value(score_of([event]), "mouth_open", 1.6, 1.6000015)
    assert before > 0 == after


def test_overlapping_leads_take_the_higher() -> None:
    one = dataclasses.replace(inspiration(PLAIN, 1.0, REST, id="one"), mouth_open=0.2)
    two = dataclasses.replace(inspiration(PLAIN, 1.6, 0.54, id="two"), mouth_open=0.9, lead=Lead(mouth=0.5))
    alone = value(score_of([one]), "mouth_open", 1.3)[0], value(score_of([two]), "mouth_open", 1.3)[0]
    assert min(alone) > 0
    assert value(score_of([one, two]), "mouth_open", 1.3) == [max(alone)]


def test_speech_level_is_relative_to_the_reference() -> None:
    spoken = dataclasses.replace(
        utterance(PLAIN, 1.0, 0),
        duration=0.3,
        phones=(),
        gain_db=-3.0,
        level=Level(step=0.1, db=(-30.0, -20.0, -200.0)),
    )
    score = score_of([spoken])
    got = value(score, "speech_level", 0.99, 1.0, 1.05, 1.1, 1.15, 1.29, 1.31)
    assert got == pytest.approx([FLOOR_DB, -13.0, -13.0, -8.0, -3.0, FLOOR_DB, FLOOR_DB])


def test_breath_level_adds_the_powers_of_nose_and_mouth() -> None:
    noise = Noise(onset=0.1, duration=0.4, attack=0.1, hold=0.2, release=0.1, level_db=-24.0, seed=1)
    event = dataclasses.replace(inspiration(PLAIN, 1.0, REST), noise=noise, sound_nose=1.0, sound_mouth=0.5)
    full = -24.0 + 10 * math.log10(0.5**2 + 10 ** (-6 / 10))
    got = value(score_of([event]), "breath_level", 1.05, 1.15, 1.3, 1.51)
    assert got == pytest.approx([FLOOR_DB, full - 20 * math.log10(2), full, FLOOR_DB])
    silent = dataclasses.replace(event, sound_nose=0.0, sound_mouth=0.0)
    assert value(score_of([silent]), "breath_level", 1.3) == [FLOOR_DB]


def test_weight_ramps_at_the_ends_of_the_score() -> None:
    score = score_of([], duration=10.0)
    assert value(score, "weight", -0.1, 0.0, 0.1, 5.0, 9.9, 10.0, 10.1) == pytest.approx([0, 0, 0.5, 1, 0.5, 0, 0])
    assert value(score_of([], duration=0.1), "weight", 0.05) == pytest.approx([1.0])
    assert value(score_of([]), "weight", 0.0, 1.0) == [1.0, 0.0]


def test_a_body_that_does_nothing_rests() -> None:
    rows = curves(score_of([], duration=1.0)).sample([0.5])[0]
    by_name = dict(zip(curves(score_of([])).channels, rows.tolist(), strict=True))
    assert by_name.pop("lung_volume") == REST
    assert by_name.pop("weight") == 1.0
    assert by_name.pop("speech_level") == by_name.pop("breath_level") == FLOOR_DB
    assert set(by_name.values()) == {0.0}


def test_a_rounded_border_leaves_no_gap() -> None:
    """0.7 + 0.1 < 0.8 in floating point: at the border the breath is whole all the same."""
    hold = Hold(id="a", body="body", onset=0.7, duration=0.1, volume=0.6, thorax_share=0.5, motion=MOTION)
    score = score_of([hold, dataclasses.replace(hold, id="b", onset=0.800001)])
    assert value(score, "lung_volume", 0.7 + 0.1, 0.8, 0.8000005, 0.800001) == [0.6] * 4


@pytest.mark.parametrize(
    ("events", "words"),
    [
        ([inspiration(PLAIN, 1.0, REST, id="a"), inspiration(PLAIN, 1.5, REST, id="b")], ["'a'", "'b'", "overlap"]),
        ([utterance(PLAIN, 0.0, 0, id="a"), utterance(PLAIN, 2.0, 0, id="b")], ["'a'", "'b'", "overlap"]),
        (
            [dataclasses.replace(inspiration(PLAIN, 1.0, REST), face=Trapezoid(attack=0.5, hold=0.5, release=0.0))],
            ["'i'", "hold=0.5", "at most its duration"],
        ),
        (
            [
                dataclasses.replace(
                    inspiration(PLAIN, 1.0, REST),
                    noise=Noise(onset=0.5, duration=0.4, attack=0.1, hold=0.2, release=0.1, level_db=-24.0, seed=1),
                )
            ],
            ["'i'", "noise onset=0.5", "within"],
        ),
    ],
)
def test_contradictions_are_refused(events: list[Inspiration | Utterance], words: list[str]) -> None:
    with pytest.raises(ScoreError) as caught:
        curves(score_of(events))
    for word in words:
        assert word in str(caught.value)


def test_requests_that_make_no_sense_are_refused() -> None:
    score = score_of([], duration=1.0)
    with pytest.raises(InputError, match=r"'thorx'.*thorax"):
        curves(score).sample([0.0], ["thorx"])
    for times in ([math.nan], [math.inf], [[0.0]]):
        with pytest.raises(InputError, match="finite"):
            curves(score).sample(times)
    with pytest.raises(InputError, match=r"'nobody'.*'body'"):
        curves(score, "nobody")
    two = dataclasses.replace(score, bodies=(*score.bodies, dataclasses.replace(score.bodies[0], id="other")))
    with pytest.raises(InputError, match="'body', 'other'"):
        curves(two)
    assert curves(two, "other").body == "other"


def test_each_body_has_its_own_breath() -> None:
    score = build([PLAIN])
    other = dataclasses.replace(score.bodies[0], id="other")
    both = dataclasses.replace(score, bodies=(*score.bodies, other))
    assert np.ptp(curves(both, "body").sample(np.arange(0, 3, 0.1), ["lung_volume"])) > 0.1
    assert np.ptp(curves(both, "other").sample(np.arange(0, 3, 0.1), ["lung_volume"])) == 0.0
