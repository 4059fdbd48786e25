"""Gaze: at the listener at accents, questions and pauses; elsewhere in between; search for words (A22, A30-A35)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from scorebreath.expression.scene import PAUSE
from scorebreath.parameters.face_table import FACES
from scorebreath.score.document import Score
from scorebreath.score.events import Brow, Gaze, Head, Phrase
from tests.expression.performed import far, gazes, performed, ruled, scenes


def at_listener(path: list[Gaze], times: np.ndarray) -> np.ndarray:
    """Whether the eyes have arrived at the listener."""
    places = np.searchsorted([event.onset for event in path], times, side="right") - 1
    there = []
    for n, time in zip(places, times, strict=True):
        arrived = time >= path[n].onset + 0.9 * path[n].move or path[n - 1].target == "listener"
        there.append(path[n].target == "listener" and bool(arrived))
    return np.array(there)


def test_three_accents_of_four_are_spoken_to_the_listener() -> None:
    there: list[bool] = []
    events = accents = 0
    for seed in range(4):
        score = performed(times=3, seed=seed, face="albrecht-2002")
        path = gazes(score)
        events += len(ruled(list(path), "glance at accent"))
        for seen in scenes(score):
            accents += len(seen.accents)
            for accent in seen.accents:
                if not any(accent.onset in asking for asking in seen.asking):
                    there.append(bool(at_listener(path, np.linspace(accent.onset, accent.end - 1e-6, 8)).any()))
    assert len(there) > 400
    assert np.mean(there) == pytest.approx(0.75, abs=0.07)
    assert events / accents == pytest.approx(0.75, abs=0.07)


@pytest.mark.parametrize("name", FACES)
def test_eyes_never_turn_away_in_an_accent_or_at_a_maximum(name: str) -> None:
    score = performed(times=2, face=name)
    for seen in scenes(score):
        for event in gazes(score):
            if (
                event.rule.startswith("search")
                or far(event.yaw, event.pitch) <= far(event.from_yaw, event.from_pitch) + 1e-5
            ):
                continue
            if seen.onset <= event.onset < seen.end:
                arrived = event.onset + event.move
                assert not any(a.onset < arrived - 1e-6 and event.onset < a.end - 1e-6 for a in seen.accents)
                assert not any(event.onset <= peak.time <= arrived for peak in seen.peaks)


ASKING = (
    "Well, I came home late. Excuse me, is this, after all, the one that you wanted? We went home.",
    "It was very nice, was it not? We went home.",
    "So they waited a little longer for him. Why? [pause 2.5] Nobody knew. [pause 3] And now, then? Off he went.",
)


@pytest.mark.parametrize("text", ASKING)
@pytest.mark.parametrize("name", FACES)
def test_no_look_away_from_a_question_until_its_raise_is_let_go(text: str, name: str) -> None:
    for seed in range(6):
        score = performed(text, seed=seed, face=name, look_at_listener=0.0, glance_at_accent=0.0)
        path, groups = gazes(score), scenes(score)
        moved: list[Brow | Head] = [*score.of(Brow), *score.of(Head)]
        raised = [event for event in moved if event.rule.startswith("question")]
        asked = [event for event in score.of(Phrase) if event.sentence_type == "question"]
        assert asked and raised and any(event.target != "listener" for event in path)
        for seen in groups:
            for question in seen.questions:
                told = [e.onset for e in score.of(Phrase) if e.sentence_type != "question" and e.onset < question.onset]
                begun = min(e.onset for e in asked if e.onset > max([seen.onset - 0.1, *told]))
                held = [e.onset + e.apex + e.hold for e in raised if abs(e.onset - question.onset) < 0.1]
                for event in path:
                    turning = event.onset > begun and event.onset < max(held) - 1e-5
                    assert not turning or event.target == "listener", (event, question)


@pytest.mark.parametrize("name", FACES)
def test_who_looks_at_the_listener_all_the_time_never_looks_away(name: str) -> None:
    score = performed(times=2, face=name, look_at_listener=1.0)
    assert not ruled(list(gazes(score)), "look away")
    assert ruled(list(gazes(score)), "small shift") and ruled(list(gazes(score)), "search")


@pytest.mark.parametrize("name", FACES)
def test_shifts_of_no_size_are_left_out(name: str) -> None:
    path = list(gazes(performed(face=name, gaze_range=0.0)))
    assert not ruled(path, "small shift") and ruled(path, "look away")
    path = list(gazes(performed(face=name, gaze_away=0.0)))
    assert not ruled(path, "look away") and {e.target for e in path if not e.rule.startswith("search")} == {"listener"}


def test_eyes_are_at_the_listener_throughout_a_question() -> None:
    score = performed(times=2, face="albrecht-2002")
    path, asked = gazes(score), 0
    for seen in scenes(score):
        for span in seen.asking:
            asked += 1
            times = np.linspace(seen.edge(span.onset) + 0.1, seen.edge(span.end) - 1e-6, 20)
            assert at_listener(path, times).all()
    assert asked >= 4


@pytest.mark.parametrize(("share", "low", "high"), [(0.0, 0.0, 0.0), (1.0, 0.8, 1.0)])
def test_glances_at_pauses_are_as_asked(share: float, low: float, high: float) -> None:
    score = performed(times=2, glance_at_pause=share, blink_at_pause=0.0)
    groups = scenes(score)
    asking = [span for g in groups for span in g.asking]
    silences = [s for g in groups for s in g.silences if not s.search]
    pauses = [s for s in silences if not any(s.onset in span for span in asking)]
    gaps = [g for g in groups[:-1] if not any(span.end >= g.end - 0.05 for span in g.asking)]
    assert low <= len(ruled(list(gazes(score)), "glance at pause")) / (len(pauses) + len(gaps)) <= high


@pytest.mark.parametrize("name", FACES)
@pytest.mark.parametrize("seed", range(2))
def test_a_glance_at_a_pause_is_seen_within_it(name: str, seed: int) -> None:
    score = performed(times=3, face=name, seed=seed, blink_at_pause=1.0)
    groups, path = scenes(score), gazes(score)
    pauses = [(s.onset, s.end) for seen in groups for s in seen.silences if not s.search]
    pauses += [(one.end, other.onset) for one, other in pairwise(groups) if other.onset - one.end >= PAUSE]
    fillers = [word.end for seen in groups for word in seen.hesitations]
    for low, high in pauses:
        if any(abs(end - low) < 0.3 for end in fillers):
            continue  # the search goes on
        there = [e for e in path if e.target == "listener" and e.end > low + 1e-5 and e.onset + e.move < high]
        assert there, (low, high)
    for event in ruled(list(path), "glance at pause"):
        inside = any(low - 1e-6 <= event.onset < high - 1e-6 for low, high in pauses)
        assert inside or event.onset >= groups[-1].end - 1e-6


def test_more_of_the_listener_where_more_is_asked_for() -> None:
    def share(score: Score) -> float:
        times = np.concatenate([np.arange(seen.onset, seen.end, 0.02) for seen in scenes(score)])
        return float(at_listener(gazes(score), times).mean())

    shares = [share(performed(times=2, look_at_listener=value, glance_at_accent=0.3)) for value in (0.1, 0.6, 0.8, 1.0)]
    assert shares[0] < shares[1] - 0.05
    assert shares[1:] == pytest.approx([0.6, 0.8, 1.0], abs=0.07)
    assert share(performed(times=4, face="restrained")) == pytest.approx(0.41, abs=0.08)


@pytest.mark.parametrize("name", FACES)
def test_eyes_away_are_as_far_as_asked_and_never_still_for_long(name: str) -> None:
    path = gazes(performed(times=2, face=name))
    away = [event for event in path if event.rule.startswith("look away") and event.move > 0]
    assert len({event.target for event in away}) >= 3
    assert all(8.0 - 1e-6 <= far(event.yaw, event.pitch) <= 12.0 + 1e-6 for event in away)
    assert all(far(event.yaw, event.pitch) <= 1.5 for event in path if event.target == "listener")
    assert max(event.duration for event in path) < 4.0


SEARCHES = (
    ("They went [pause 0.9] to the garden behind the house.", 1),
    ("They went [pause 0.4] to the garden behind the house.", 0),
    ("They went, er, to the garden behind the house.", 1),
    ("They went home. [pause 0.9] Nobody saw them in the garden.", 0),
    ("They went [sniff] [pause 0.9] to the garden behind the house.", 0),
    ("They went [breath] to the garden behind the house.", 0),
)


@pytest.mark.parametrize(("text", "count"), SEARCHES)
def test_words_are_searched_for_in_long_unfilled_pauses_and_on_hesitations(text: str, count: int) -> None:
    score = performed(text)
    looks, brows = ruled(list(gazes(score)), "search"), ruled(list(score.of(Brow)), "search")
    assert len(looks) == len(brows) == count
    for look, brow in zip(looks, brows, strict=True):
        assert isinstance(look, Gaze) and isinstance(brow, Brow)
        assert look.yaw < 0.0  # A33: to the character's own right
        assert (look.pitch > 0.0) == (brow.left > 0.0) == (brow.frown == 0.0)
    assert not ruled(list(gazes(performed(text, word_search=0.0))), "search")


def test_a_search_goes_up_or_down() -> None:
    looks = [ruled(list(gazes(performed(SEARCHES[0][0], seed=seed))), "search")[0] for seed in range(8)]
    assert {event.target for event in looks if isinstance(event, Gaze)} == {"up", "down"}
