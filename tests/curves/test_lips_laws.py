"""What holds for any phones: range, speed, reach, contact, and that the plain sum is plain."""

from __future__ import annotations

import dataclasses
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from scorebreath.curves.channels import CHANNELS
from scorebreath.curves.lips.gates import LEAST, RAMP, Gate
from scorebreath.curves.lips.lips import LIP_CHANNELS
from scorebreath.curves.lips.targets import CLOSE, JAW, TUCK, parts_of, targets
from scorebreath.curves.tracks import Array
from scorebreath.equations.dominance import blend, dominance
from scorebreath.errors import ScoreError
from scorebreath.units import snap
from tests.curves.talk import CLOSED, Said, aperture, fine, lips_of, sample, strings, utterance_of

COUNTED = settings(max_examples=60, deadline=None)
REACH = 0.5
SPEEDS = np.array([next(c.speed for c in CHANNELS if c.name == name) for name in LIP_CHANNELS], dtype=np.float64)
ROUND = LIP_CHANNELS.index("lip_round")
RATES = (Fraction(24), Fraction(24000, 1001), Fraction(25), Fraction(30), Fraction(60))

CROWD: Said = [
    ("ħ", 0.045), ("ɢ", 0.045), *((ipa, 0.005) for ipa in "ɑaɒʔaɑʌɒ"), ("ŋ", 0.08), ("ʡ", 0.02), ("ɖ", 0.06),
    ("q", 0.012), ("ɸ", 0.045), ("q", 0.045), ("ʄ", 0.06), ("ɭ", 0.02), ("ʢ", 0.005), ("a", 0.03), ("ᵻ", 0.012),
]  # fmt: skip
"""Very short open vowels that together outweighed what follows, found by search."""


def length(said: Said) -> float:
    return snap(sum(snap(each) for _, each in said))


@COUNTED
@given(strings(), st.booleans())
@example(CROWD, False)
def test_no_channel_leaves_its_range_or_jumps(said: Said, gate: bool) -> None:
    step = 0.0005
    values = sample(lips_of(utterance_of(said, 1.0)), fine(0.3, 1.8 + length(said), step), gate=gate)
    assert values.min() >= 0.0
    assert values.max() <= 1.0
    assert np.all(np.abs(np.diff(values, axis=0)).max(axis=0) <= SPEEDS * step)


@COUNTED
@given(strings(), strings(), st.integers(0, 1_500_000))
def test_two_utterances_however_close_move_without_a_step(one: Said, two: Said, gap: int) -> None:
    second = snap(1.0 + length(one) + gap / 1e6)
    lips = lips_of(utterance_of(one, 1.0, "a"), utterance_of(two, second, "b"))
    times = fine(max(1.0 + length(one) - 0.5, 0.0), second + 0.5, 0.0005)
    assert np.all(np.abs(np.diff(sample(lips, times), axis=0)).max(axis=0) <= SPEEDS * 0.0005)


@COUNTED
@given(strings(longest=2.0), strings(longest=2.0), st.integers(0, 1_500_000))
def test_an_utterance_changes_nothing_outside_its_reach(one: Said, two: Said, gap: int) -> None:
    first, second = utterance_of(one, 1.0, "a"), utterance_of(two, snap(1.0 + length(one) + gap / 1e6), "b")
    both = lips_of(first, second)
    times = fine(0.0, second.end + 1.0, 0.002)
    for left, alone in ((second, lips_of(first)), (first, lips_of(second))):
        outside = times[(times < left.onset - REACH) | (times > left.end + REACH)]
        assert np.array_equal(sample(both, outside), sample(alone, outside))


@COUNTED
@given(strings())
def test_there_is_rest_before_and_after(said: Said) -> None:
    lips = lips_of(utterance_of(said, 1.0))
    assert not sample(lips, fine(0.0, 0.7)).any()
    assert not sample(lips, fine(1.3 + length(said), 2.0 + length(said))).any()


@COUNTED
@given(strings())
def test_each_moment_depends_on_itself_alone(said: Said) -> None:
    lips = lips_of(utterance_of(said, 1.0))
    times = fine(0.5, 1.5 + length(said), 0.003)
    order = np.random.default_rng(len(said)).permutation(len(times))
    whole = sample(lips, times)
    assert np.array_equal(sample(lips, times[order]), whole[order])
    assert np.array_equal(sample(lips, times[::7]), whole[::7])


@COUNTED
@given(strings(), st.sampled_from([0.0, 0.35, 1.0]))
def test_lips_touch_in_every_p_b_m_at_every_rate(said: Said, mouth: float) -> None:
    lips = lips_of(utterance_of(said, 1.0))
    for start, end in _closed(said, 1.0):
        times = fine(start - LEAST, end + LEAST, 0.0005)
        shut = aperture(sample(lips, times, mouth=mouth), mouth) <= 0.02
        assert _longest(shut) * 0.0005 >= LEAST - 0.001
        for rate in RATES:
            frames = np.arange(int((start - LEAST) * rate), int((end + LEAST) * rate) + 2) / float(rate)
            frames = frames[(frames >= start - LEAST) & (frames <= end + LEAST)]
            assert aperture(sample(lips, frames, mouth=mouth), mouth).min() <= 0.02


@COUNTED
@given(strings())
def test_outside_the_gates_the_sum_is_plain(said: Said) -> None:
    lips = lips_of(utterance_of(said, 1.0))
    times = fine(0.4, 1.6 + length(said))
    gated, plain = sample(lips, times), sample(lips, times, gate=False)
    for column, gate in ((CLOSE, lips.closures), (TUCK, lips.tucks)):
        free = _away(gate, times) > RAMP
        assert np.array_equal(gated[free, column], plain[free, column])
        assert np.all(gated[:, column] >= plain[:, column])
    others = [column for column in range(len(LIP_CHANNELS)) if column not in (CLOSE, TUCK)]
    assert np.array_equal(gated[:, others], plain[:, others])


def test_the_sum_is_cohen_and_massaros() -> None:
    """Within the two whole phones of range, against the equation written out."""
    said = [("t", 0.08), ("iː", 0.12), ("k", 0.09)]
    lips = lips_of(utterance_of(said, 1.0))
    table = targets()
    time = 1.13
    edges = np.cumsum([1.0, *(each for _, each in said)])
    weights, wanted = [], []
    for (ipa, _), start, end in zip(said, edges, edges[1:], strict=False):
        row = parts_of(ipa)[0][0]
        tau = (start + end) / 2 - time
        weights.append(dominance(tau, table.alpha[row, JAW], table.before[row, 0], table.after[row, 0]))
        wanted.append(table.target[row, JAW])
    expected = blend(wanted, weights, 0.005)
    assert sample(lips, np.array([time]))[0, JAW] == pytest.approx(float(expected), rel=1e-12)


def test_swapping_the_sides_mirrors_the_curve() -> None:
    lips = lips_of(utterance_of([("w", 0.1)], 1.0))
    other = dataclasses.replace(lips, before=lips.after, after=lips.before)
    away = np.linspace(0.0, 0.25, 50)
    assert not np.array_equal(lips.before, lips.after)
    early, late = sample(lips, 1.05 - away), sample(lips, 1.05 + away)
    np.testing.assert_allclose(early, sample(other, 1.05 + away), atol=1e-12)
    assert np.all(early >= late - 1e-12)  # a rounded sound is anticipated further than it lasts
    assert early[20, ROUND] > late[20, ROUND]


def test_two_contacts_in_a_row_are_one() -> None:
    lips = lips_of(utterance_of([("a", 0.1), ("p", 0.1), ("m", 0.07), ("a", 0.1)], 1.0))
    assert len(lips.closures.begin) == 1
    assert sample(lips, fine(1.1, 1.27))[:, CLOSE].min() == 1.0


def test_a_stop_bursts_before_it_ends_and_a_nasal_does_not() -> None:
    burst = lips_of(utterance_of([("a", 0.1), ("p", 0.12), ("a", 0.1)], 1.0)).closures
    nasal = lips_of(utterance_of([("a", 0.1), ("m", 0.12), ("a", 0.1)], 1.0)).closures
    assert burst.begin[0] == pytest.approx(nasal.begin[0])
    assert burst.end[0] < 1.21 < nasal.end[0]


def test_overlapping_phones_are_refused() -> None:
    spoken = utterance_of([("a", 0.1), ("t", 0.1)], 1.0)
    early = dataclasses.replace(spoken.phones[1], onset=0.05)
    with pytest.raises(ScoreError, match="overlap"):
        lips_of(dataclasses.replace(spoken, phones=(spoken.phones[0], early)))


def test_a_phone_outside_its_utterance_is_refused() -> None:
    spoken = utterance_of([("a", 0.1), ("t", 0.1)], 1.0)
    with pytest.raises(ScoreError, match="expected within"):
        lips_of(dataclasses.replace(spoken, duration=0.15))


def test_overlapping_utterances_are_refused() -> None:
    with pytest.raises(ScoreError, match="utterances of 'body' overlap"):
        lips_of(utterance_of([("a", 0.5)], 1.0, "a"), utterance_of([("t", 0.5)], 1.2, "b"))


def _closed(said: Said, onset: float) -> list[tuple[float, float]]:
    edges = np.cumsum([onset, *(snap(each) for _, each in said)])
    return [(a, b) for (ipa, _), a, b in zip(said, edges, edges[1:], strict=False) if ipa in CLOSED]


def _longest(shut: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> int:
    changes = np.flatnonzero(np.diff(np.concatenate([[0], shut.astype(np.int8), [0]])))
    return int((changes[1::2] - changes[::2]).max(initial=0))


def _away(gate: Gate, times: Array) -> Array:
    away = np.full(len(times), np.inf)
    for begin, end in zip(gate.begin, gate.end, strict=True):
        away = np.minimum(away, np.maximum(np.maximum(begin - times, times - end), 0.0))
    return away
