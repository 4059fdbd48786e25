"""Brows and head: at maxima, by their height, at rates; questions; room between raises (A23, A25-A29, Y6)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.curves.looks.looks import looks
from scorebreath.equations.looking import BROW_FASTEST, HEAD_RANGE
from scorebreath.expression.accents import Peak
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.face_table import FACES
from scorebreath.pipeline import compile_text
from scorebreath.score.document import Score
from scorebreath.score.events import Brow, Head
from scorebreath.speech.voices import open_voice
from tests.expression.performed import performed, ruled, scenes

ACCENTS = ("head at maximum",)


def of_accents(score: Score) -> list[Head]:
    return [event for event in score.of(Head) if event.rule.startswith(ACCENTS)]


def peaks(score: Score) -> list[Peak]:
    """Those that no question's last word has."""
    return [
        peak
        for seen in scenes(score)
        for peak in seen.peaks
        if not any(q.onset - 0.06 <= peak.time <= q.end + 0.06 for q in seen.questions)
    ]


def test_rates_of_the_papers_face() -> None:
    brows = heads = rolled = found = 0
    for seed in range(4):
        score = performed(times=3, seed=seed, face="albrecht-2002")
        found += len(peaks(score))
        brows += sum(event.rule.startswith("brow at") for event in score.of(Brow))
        heads += len(of_accents(score))
        rolled += sum(event.roll != 0.0 for event in of_accents(score))
    assert found > 400
    assert brows / found == pytest.approx(0.71, abs=0.07)
    assert heads / found > 0.9
    assert rolled / heads == pytest.approx(0.75, abs=0.07)


def test_the_head_rises_with_pitch_up_to_a_limit_and_the_left_brow_too() -> None:
    score = performed(times=2, face="albrecht-2002")
    for event in of_accents(score):
        semitones = float(event.rule.partition(": ")[2].partition(" st")[0])
        assert event.pitch <= min(5.0, 0.6 * semitones) + 0.05
        assert abs(event.roll) <= 1.5 * 1.4 + 1e-6
    raises = [event for event in score.of(Brow) if event.rule.startswith("brow at")]
    by_height = sorted((float(e.rule.partition(": ")[2].partition(" st")[0]), e.left) for e in raises)
    assert all(low[1] <= high[1] + 0.01 for low, high in pairwise(by_height))
    assert by_height[0][1] < by_height[-1][1]
    assert {event.right for event in raises} == {0.35}


def test_the_head_is_up_at_maxima_and_down_at_minima() -> None:
    score = performed(times=3, roll_at_raise=0.0, question_raise=0.0)
    pitch = curves(score)
    apart = [peak for peak in peaks(score) if min(peak.time - peak.before, peak.after - peak.time) > 0.3]
    assert len(apart) > 20
    for peak in apart:
        at = pitch.sample([peak.before, peak.time, peak.after], ["head_pitch", "neck_pitch"])
        rest, up, again = at[:, 0] - at[:, 1]
        assert up >= min(5.0, 0.6 * peak.semitones) * 0.6 and max(rest, again) <= 0.5 * up + 0.1


def test_the_last_word_of_a_question_raises_both_until_speech_goes_on() -> None:
    score = performed(face="albrecht-2002")
    groups = scenes(score)
    asked = [(question, seen) for seen in groups for question in seen.questions]
    assert len(asked) >= 3
    for kind in (Brow, Head):
        raised = sorted(ruled(list(score.of(kind)), "question"), key=lambda event: event.onset)
        assert len(raised) == len(asked)
        for event, (question, seen) in zip(raised, asked, strict=True):
            assert isinstance(event, Brow | Head)
            assert event.onset == pytest.approx(seen.edge(question.onset), abs=2e-6)
            assert repr(question.text) in event.rule
            later = [g.onset for g in groups if g.onset > question.end]
            until = question.until or min(later, default=seen.end)
            held = event.onset + event.apex + event.hold
            assert held == pytest.approx(min(until, seen.end + 2.0), abs=0.2) or held >= question.end


def test_a_quoted_question_is_asked_too() -> None:
    with open_voice("espeak", "en") as voice:
        score = compile_text("'Are their heads off?' shouted the Queen.", voice=voice, media=MemoryStore())
    for kind in (Brow, Head):
        (raised,) = ruled(list(score.of(kind)), "question")
        assert "'off'" in raised.rule


@pytest.mark.parametrize(("model", "tail"), [("natural", 1.0), ("natural", 0.0), ("bernardet-2017", 0.0)])
def test_at_the_end_of_all_a_question_is_let_go_in_time(model: str, tail: float) -> None:
    with open_voice("tone", "en") as voice:
        score = compile_text("Where are they now?", voice=voice, media=MemoryStore(), model=model, tail=tail, lead=0.0)
    for kind in (Brow, Head):
        (event,) = ruled(list(score.of(kind)), "question")
        assert isinstance(event, Brow | Head)
        assert event.end <= score.duration + 1e-5
        assert event.onset + event.apex + event.hold >= scenes(score)[0].end - 0.3


@pytest.mark.parametrize("seed", range(3))
def test_the_restrained_face_takes_its_time(seed: int) -> None:
    score = performed(times=6, seed=seed, face="restrained", brow_at_maximum=1.0)
    onsets = sorted(event.onset for event in score.of(Brow) if event.left > 0.0)
    assert min(after - before for before, after in pairwise(onsets)) >= 2.5
    assert max(sum(onset <= other < onset + 60.0 for other in onsets) for onset in onsets) <= 15
    assert len(onsets) > 30


@pytest.mark.parametrize("name", FACES)
def test_rates_of_nothing_move_nothing(name: str) -> None:
    nothing = ("brow_at_maximum", "question_brow", "word_search", "head_at_maximum", "question_raise")
    score = performed(face=name, **dict.fromkeys(nothing, 0.0))
    assert not list(score.of(Brow)) and not list(score.of(Head))


EXTREME = (
    {"brow_height": 1.0},
    {"brow_height": 1.0, "question_brow": 1.0, "brow_at_maximum": 1.0},
    {"roll_angle": 20.0, "head_per_semitone": 5.0, "head_highest": 20.0, "question_raise": 20.0},
    {"roll_angle": 20.0, "roll_at_raise": 1.0, "head_per_semitone": 0.0, "question_raise": 1.0},
    {"roll_angle": 0.0, "head_per_semitone": 5.0, "head_highest": 20.0, "question_raise": 20.0},
)


@pytest.mark.parametrize("rates", EXTREME)
@pytest.mark.parametrize("name", FACES)
def test_limits_hold_for_all_that_may_be_set(name: str, rates: dict[str, float]) -> None:
    score = performed(times=4, face=name, **rates)
    found = looks(score, "body")
    times = np.arange(0.0, score.duration, 0.002)
    head, brow = found.head(times), found.brows(times)
    assert np.abs(np.diff(head, axis=0)).max() / 0.002 <= 50.0
    assert np.abs(head).max() <= HEAD_RANGE + 0.01
    assert np.abs(np.diff(brow, axis=0)).max() / 0.002 <= BROW_FASTEST * 1.001
    asked = "head" if "roll_angle" in rates else "brow"
    assert np.abs(head).max() > 10.0 if asked == "head" else brow.max() == 1.0
