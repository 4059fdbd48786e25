"""Whose lengths are whose: stress, marks, spaces, punctuation, silence."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.speech.piper.symbols import LATE, Timed, phones

RATE = 22050
HOP = 256


def sound(*parts: tuple[float, float]) -> np.ndarray:
    """A tone in parts of so many seconds and such amplitudes."""
    levels = np.concatenate([np.full(round(seconds * RATE), level) for seconds, level in parts])
    return np.asarray(levels * np.sin(np.arange(len(levels)) * 0.05), dtype=np.float32)


def frames(seconds: float) -> int:
    return round(seconds * RATE)


def timed(*parts: tuple[str, float]) -> list[Timed]:
    return [Timed(symbol, frames(seconds)) for symbol, seconds in parts]


def test_a_stress_and_a_space_go_to_the_phone_behind_and_a_length_to_the_one_before() -> None:
    symbols = timed(("^", 0.05), ("a", 0.1), ("ː", 0.05), (" ", 0.04), ("ˈ", 0.06), ("o", 0.1), ("ʊ", 0.1), ("$", 0.05))
    made = sound((0.55, 0.5))
    cut, placed = phones(symbols, [None, 0, 0, None, 1, 1, 1, None], made, RATE)
    assert [(phone.ipa, phone.stress, phone.word) for phone in placed] == [("aː", 0, 0), ("oʊ", 1, 1)]
    assert placed[0].start == 0
    assert abs(placed[1].start - frames(0.2 - LATE)) <= 2
    assert abs(len(cut) - len(made)) <= frames(0.005)


def test_silence_at_a_comma_is_a_pause_as_long_as_it_is_heard() -> None:
    symbols = timed(("^", 0.05), ("a", 0.2), (",", 0.2), (" ", 0.1), ("o", 0.2), ("$", 0.05))
    _, placed = phones(symbols, [None, 0, None, None, 1, None], sound((0.3, 0.5), (0.22, 0.0), (0.28, 0.5)), RATE)
    assert [phone.ipa for phone in placed] == ["a", "", "o"]
    assert abs(placed[1].start / RATE - 0.3) < 0.01
    assert abs(placed[2].start / RATE - 0.52) < 0.01


def test_without_silence_there_is_no_pause_and_none_in_a_closure() -> None:
    symbols = timed(("^", 0.05), ("a", 0.2), (" ", 0.05), ("p", 0.1), ("o", 0.2), ("$", 0.05))
    _, placed = phones(symbols, [None, 0, None, 1, 1, None], sound((0.24, 0.5), (0.08, 0.0), (0.33, 0.5)), RATE)
    assert [phone.ipa for phone in placed] == ["a", "p", "o"]


def test_two_words_vowels_are_no_diphthong() -> None:
    symbols = timed(("^", 0.05), ("a", 0.2), ("ɪ", 0.2), ("$", 0.05))
    apart = phones(symbols, [None, 0, 1, None], sound((0.5, 0.5)), RATE)[1]
    together = phones(symbols, [None, 0, 0, None], sound((0.5, 0.5)), RATE)[1]
    assert [phone.ipa for phone in apart] == ["a", "ɪ"]
    assert [phone.ipa for phone in together] == ["aɪ"]


def test_silence_alone_says_nothing() -> None:
    cut, placed = phones(timed(("^", 0.1), ("a", 0.1), ("$", 0.1)), [None, 0, None], sound((0.3, 0.0)), RATE)
    assert not len(cut)
    assert not placed


SYMBOLS = st.sampled_from(["a", "ɪ", "t", "ʃ", "ˈ", "ː", "ʲ", " ", ",", "."])


@given(st.lists(st.tuples(SYMBOLS, st.integers(0, 20)), max_size=25), st.integers(0, 1000))
def test_phones_are_contiguous_whatever_comes(told: list[tuple[str, int]], seed: int) -> None:
    symbols = [Timed("^", 3 * HOP), *(Timed(symbol, HOP * count) for symbol, count in told), Timed("$", 3 * HOP)]
    chance = np.random.default_rng(seed)
    total = sum(one.frames for one in symbols)
    made = (chance.normal(0, 0.1, total) * np.repeat(chance.random(total // 64 + 1) > 0.4, 64)[:total]).astype(
        np.float32
    )
    word, owners = 0, list[int | None]()
    for one in symbols:
        word += one.symbol == " "
        owners.append(None if one.symbol in "^$ ,." else word)
    cut, placed = phones(symbols, owners, made, RATE)
    starts = [phone.start for phone in placed]
    assert starts == sorted(set(starts))
    assert not placed or (starts[0] == 0 and starts[-1] < len(cut))
    assert all((phone.word is None) == (phone.ipa == "") for phone in placed)
