"""Blinks: at pauses, by themselves, twice; never in each other's way (A20, A21, Y3)."""

from __future__ import annotations

from itertools import pairwise
from statistics import mean

import pytest

from scorebreath.equations.looking import blink_limit
from scorebreath.expression.scene import PAUSE
from scorebreath.parameters.face_table import FACES
from scorebreath.score.events import Blink, Gaze, Utterance
from tests.expression.performed import performed, ruled, scenes


def test_alone_they_come_every_4_8_seconds() -> None:
    gaps: list[float] = []
    for seed in range(5):
        score = performed(times=4, seed=seed, face="albrecht-2002", blink_at_pause=0.0)
        onsets = sorted(event.onset for event in score.of(Blink))
        gaps += [after - before for before, after in pairwise(onsets)]
        assert not ruled(list(score.of(Blink)), "blink at pause")
    assert len(gaps) > 150
    assert mean(gaps) == pytest.approx(4.8, abs=0.5)
    assert max(gaps) <= blink_limit(4.8)


def test_each_restarts_the_clock_so_no_interval_is_longer_than_a_draw() -> None:
    score = performed(times=4, face="albrecht-2002")
    blinks = sorted(score.of(Blink), key=lambda event: event.onset)
    assert max(after.onset - before.onset for before, after in pairwise(blinks)) <= blink_limit(4.8)
    assert blinks[0].onset <= blink_limit(4.8) and score.duration - blinks[-1].onset <= blink_limit(4.8)
    assert ruled(blinks, "blink at pause") and ruled(blinks, "blink by itself")


@pytest.mark.parametrize(("share", "low", "high"), [(0.0, 0.0, 0.0), (0.5, 0.3, 0.7), (1.0, 0.75, 1.0)])
def test_the_share_of_pauses_is_as_asked(share: float, low: float, high: float) -> None:
    score = performed(times=4, blink_at_pause=share, blink_double=0.0)
    groups = scenes(score)
    pauses = sum(len(seen.silences) for seen in groups) + sum(b.onset - a.end >= PAUSE for a, b in pairwise(groups))
    assert pauses > 60
    assert low <= len(ruled(list(score.of(Blink)), "blink at pause")) / pauses <= high


@pytest.mark.parametrize("name", FACES)
def test_they_are_fast_mostly_complete_and_apart(name: str) -> None:
    blinks = sorted(performed(times=4, face=name).of(Blink), key=lambda event: event.onset)
    for event in blinks:
        assert event.duration < 0.3 and event.close < event.open
        assert 0.75 <= event.left == event.right <= 1.0
    assert all(before.end < after.onset for before, after in pairwise(blinks))
    doubles = len(ruled(list(blinks), "double blink"))
    assert doubles == 0 if name == "albrecht-2002" else 0.02 < doubles / len(blinks) < 0.2


def test_blinks_by_themselves_avoid_stressed_vowels() -> None:
    score = performed(times=4, face="restrained", blink_at_pause=0.0)
    stressed = [vowel for seen in scenes(score) for vowel in seen.stressed]
    own = ruled(list(score.of(Blink)), "blink by itself")
    inside = sum(any(event.onset in vowel for vowel in stressed) for event in own) / len(own)
    edges = [edge for seen in scenes(score) for edge in seen.edges]
    anywhere = sum(any(edge in vowel for vowel in stressed) for edge in edges) / len(edges)
    assert len(own) > 40 and inside <= 0.5 * anywhere


@pytest.mark.parametrize("name", FACES)
@pytest.mark.parametrize("seed", range(4))
def test_at_a_pause_none_is_beside_a_glance_or_a_search(name: str, seed: int) -> None:
    """At most one of them begins within 150 ms of another; also a glance for the accent that the pause ends with."""
    score = performed(times=4, seed=seed, face=name)
    sounds = sorted(
        (said.onset + phone.onset, said.onset + phone.onset + phone.duration)
        for said in score.of(Utterance) for phone in said.phones if phone.ipa
    )  # fmt: skip
    pauses = [(one[1], after[0]) for one, after in pairwise(sounds) if after[0] - one[1] >= PAUSE]
    looks = [e.onset for e in score.of(Gaze) if e.rule.startswith(("glance at pause", "glance at accent", "search"))]
    blinks = [blink.onset for blink in score.of(Blink)]
    assert len(pauses) > 60 and len(looks) > 100
    for low, high in pauses:
        at = [[time for time in times if low - 0.15 <= time <= high + 0.15] for times in (looks, blinks)]
        assert not [(look, blink) for look in at[0] for blink in at[1] if abs(look - blink) < 0.15 - 1e-6]
