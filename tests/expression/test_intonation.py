"""Turns of the melody: one maximum an accented syllable, minima between them (A24)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.expression.intonation import LONELY, REACH, Extremum, extrema, syllable
from scorebreath.media.store import MemoryStore
from scorebreath.pipeline import compile_text
from scorebreath.score.document import Score
from scorebreath.score.events import Level, Phone, Pitch, Utterance, Word
from scorebreath.speech.voices import open_voice
from scorebreath.units import snap

STEP = 0.005
ROOT = Path(__file__).resolve().parents[2]
LETTERS = {"C": ("p", 0.1), "V": ("a", 0.15), "'": ("a", 0.15)}


def utterance(words: Sequence[str], semitones: Sequence[float], accents: Sequence[bool]) -> Utterance:
    """Somebody who says words of consonants C, vowels V and stressed vowels ' to a melody above 100 Hz."""
    phones: list[Phone] = []
    said: list[Word] = []
    at = 0.0
    for number, (word, accent) in enumerate(zip(words, accents, strict=True)):
        start = at
        for letter in word:
            ipa, length = LETTERS[letter]
            phones.append(Phone(ipa=ipa, onset=snap(at), duration=length, stress=int(letter == "'"), word=number))
            at += length
        said.append(Word(text=word, onset=snap(start), duration=snap(at - start), accent=accent))
    times = (np.arange(round(at / STEP)) + 0.5) * STEP
    heights = np.interp(times, np.linspace(0.0, at, len(semitones)), semitones)
    voiced = np.repeat([phone.ipa == "a" for phone in phones], [round(p.duration / STEP) for p in phones])
    hertz = np.where(voiced, 100.0 * 2.0 ** (heights / 12.0), 0.0)
    return Utterance(
        id="u", body="body", onset=3.0, duration=snap(at), media="", gain_db=0.0, closing="final", words=tuple(said),
        phones=tuple(phones), pitch=Pitch(step=STEP, hertz=tuple(map(snap, hertz.tolist()))),
        level=Level(step=0.01, db=()),
    )  # fmt: skip


def maxima(turns: Sequence[Extremum]) -> list[Extremum]:
    return [turn for turn in turns if turn.kind == "maximum"]


def test_an_accent_is_a_maximum_with_rest_around_it() -> None:
    said = utterance(["CV", "C'CV", "CV"], [0, 0, 5, 0, 0], [False, True, False])
    low, high, after = extrema(said)
    assert (low.kind, high.kind, after.kind) == ("minimum", "maximum", "minimum")
    assert high.word == 1 and high.syllable == (0.25, 0.5)
    assert high.time == pytest.approx(said.duration / 2, abs=0.05)
    assert high.semitones == pytest.approx(5.0, abs=0.6)
    assert low.time < high.time < after.time and max(low.semitones, after.semitones) < 1.0


def test_heights_are_above_the_low_tone_whatever_the_voice() -> None:
    words, melody, accents = ["C'"] * 5, [0, 6, 0, 5, 0, 4, 0], [True] * 5
    one = extrema(utterance(words, melody, accents))
    higher = extrema(utterance(words, [height + 9 for height in melody], accents))
    assert len(maxima(one)) == 3
    assert [(t.kind, t.word) for t in one] == [(t.kind, t.word) for t in higher]
    assert [t.time for t in one] == pytest.approx([t.time for t in higher], abs=0.02)
    assert [t.semitones for t in one] == pytest.approx([t.semitones for t in higher], abs=1e-3)


def test_two_peaks_of_one_accented_syllable_are_one() -> None:
    peaks = extrema(utterance(["C''C"], [0, 5, 1, 7, 0], [True]))
    assert len(maxima(peaks)) == 1 and maxima(peaks)[0].semitones > 4.0
    twice = extrema(utterance(["C''C"], [0, 5, 1, 7, 0], [False]))
    assert len(maxima(twice)) == 2 and {peak.syllable for peak in maxima(twice)} == {None}


def test_a_tremble_is_no_turn() -> None:
    said = utterance(["CV"] * 12, [3 - n / 20 + 0.6 * (n % 2) for n in range(48)], [False] * 12)
    assert maxima(extrema(said)) == []


def test_an_accent_on_a_level_tone_far_from_any_turn_is_one() -> None:
    level = [3 - n / 40 for n in range(48)]
    said = utterance(["CV"] * 12, level, [number in (1, 6, 7, 11) for number in range(12)])
    found = maxima(extrema(said))
    assert [peak.word for peak in found] == [1, 6, 11]  # the eighth word's accent is too near
    assert all(peak.level and peak.syllable and peak.syllable[0] <= peak.time <= peak.syllable[1] for peak in found)
    turning = utterance(["CV", "C'CV", "CV"], [0, 0, 5, 0, 0], [False, True, False])
    assert [peak.level for peak in maxima(extrema(turning))] == [False]


def test_where_speech_rises_to_its_end_it_ends_with_a_maximum() -> None:
    said = utterance(["CV", "CV", "C'"], [0, 0, 0, 0, 6], [False, False, True])
    assert extrema(said)[-1].kind == "maximum" and extrema(said)[-1].time > said.duration - 0.02
    assert extrema(said)[-1].word == 2


def test_a_question_s_plateau_is_one_too_and_a_level_end_is_none() -> None:
    rising = extrema(utterance(["CV", "C'", "C'"], [3, 3, 0, 6, 6.2], [True] * 3))
    assert rising[-1].kind == "maximum" and rising[-1].semitones > 5.0
    level = extrema(utterance(["CV", "C'", "C'"], [0, 5, 1, 1, 1.2], [True] * 3))
    assert len(maxima(level)) == 1


def test_nothing_voiced_has_no_turns() -> None:
    assert extrema(utterance(["CC", "C"], [0, 5, 0], [True, True])) == ()


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("CC'CCVC", (0.0, 0.45)),  # two consonants between vowels: one each
        ("CVC'V", (0.25, 0.5)),  # one: the second vowel's
        ("CVCC'CC", (0.35, 0.8)),  # at the end all
        ("V'", (0.15, 0.3)),
        ("CVCV", (0.0, 0.25)),  # no stress is marked: the first vowel
        ("CC", (0.0, 0.2)),
    ],
)
def test_syllables_are_cut_before_the_last_consonant_between_vowels(word: str, expected: tuple[float, float]) -> None:
    assert syllable(utterance([word], [0, 0], [True]).phones) == pytest.approx(expected)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(st.sampled_from(["C'", "CVC'C", "C'V", "CV", "VC", "C", "CC''"]), st.booleans()), min_size=1),
    st.lists(st.floats(-10, 14), min_size=2, max_size=40),
)
def test_turns_alternate_and_no_accented_syllable_has_two_maxima(
    words: list[tuple[str, bool]], melody: list[float]
) -> None:
    said = utterance([word for word, _ in words], melody, [accent for _, accent in words])
    turns = extrema(said)
    level = {number for number, turn in enumerate(turns) if turn.level}
    for number, (before, after) in enumerate(pairwise(turns)):
        assert before.time < after.time and before.kind != after.kind
        low, high = (before, after) if before.kind == "minimum" else (after, before)
        if level.isdisjoint({number - 1, number, number + 1, number + 2}):  # halfway to a level accent, none is lowest
            assert low.semitones <= high.semitones
    syllables = [turn.syllable for turn in maxima(turns) if turn.syllable]
    assert len(syllables) == len(set(syllables))
    for turn in turns:
        assert 0.0 <= turn.time <= said.duration
        assert turn.kind == "maximum" or turn.syllable is None
        if turn.level:
            apart = [abs(other.time - turn.time) for other in maxima(turns) if other is not turn]
            assert turn.syllable is not None and min(apart, default=1.0) > LONELY
        if turn.syllable is not None and turn.word is not None:
            word = said.words[turn.word]
            assert word.accent and word.onset - REACH <= turn.time <= word.onset + word.duration + REACH


@cache
def spoken(file: str, language: str) -> Score:
    text = (ROOT / "examples" / file).read_text(encoding="utf-8")
    with open_voice("espeak", language) as voice:
        return compile_text(text, voice=voice, media=MemoryStore(), language=language)


def within(file: str, language: str) -> Iterator[tuple[Utterance, Extremum]]:
    for said in spoken(file, language).of(Utterance):
        yield from ((said, peak) for peak in maxima(extrema(said)))


@pytest.mark.parametrize(
    ("file", "language"), [("forecast.txt", "en"), ("radio_chat.txt", "en"), ("parallelen.txt", "de")]
)
def test_a_real_voice_turns_about_once_a_second_and_on_accents(file: str, language: str) -> None:
    """0.5 to 1.5 maxima a second of speech, 70 % within an accented word +- 150 ms, most at its very syllable."""
    said = list(spoken(file, language).of(Utterance))
    speech = sum(phone.duration for one in said for phone in one.phones if phone.ipa)
    peaks = list(within(file, language))
    assert 0.5 <= len(peaks) / speech <= 1.5
    on_words = [
        any(w.accent and w.onset - REACH <= p.time <= w.onset + w.duration + REACH for w in one.words)
        for one, p in peaks
    ]
    assert np.mean(on_words) >= 0.7
    on_syllables = [p.syllable is not None and p.syllable[0] - 0.05 <= p.time <= p.syllable[1] + 0.05 for _, p in peaks]
    assert np.mean(on_syllables) >= 0.6  # half of all speech lies so near to one
    assert np.mean([2.0 <= peak.semitones <= 10.0 for _, peak in peaks if not peak.level]) > 0.9
