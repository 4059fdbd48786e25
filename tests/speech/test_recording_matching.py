"""A transcript against what was understood, and what labels mean."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import InputError
from scorebreath.speech.recording.arpabet import IPA, from_ipa
from scorebreath.speech.recording.labels import as_ipa, silent
from scorebreath.speech.recording.matching import Token, check_share, differences, distance
from scorebreath.speech.recording.model import Mismatch

WORDS = ("the", "ferryman", "rowed", "slowly", "over", "river", "children", "waved", "bank", "lantern")


def tokens(*words: str) -> list[Token]:
    return [
        Token(text=word, sounds=tuple(word), at=float(place), until=place + 0.9) for place, word in enumerate(words)
    ]


texts = st.lists(st.sampled_from(WORDS), max_size=12)


@given(text=texts, exact=st.booleans())
def test_a_text_is_itself(text: list[str], exact: bool) -> None:
    assert differences(tokens(*text), tokens(*text), exact=exact) == []


@given(one=texts, two=texts)
def test_every_difference_is_told_once_and_in_order(one: list[str], two: list[str]) -> None:
    found = differences(tokens(*one), tokens(*two), exact=True)
    assert (found == []) == (one == two)
    rest = list(one)
    for part in reversed(found):
        rest[part.written.start : part.written.stop] = [two[place] for place in part.heard]
    assert rest == two
    for before, behind in pairwise(found):
        assert before.written.stop <= behind.written.start
        assert before.heard.stop <= behind.heard.start


@given(one=st.text("abc", max_size=8), two=st.text("abc", max_size=8), three=st.text("abc", max_size=8))
def test_a_distance_is_one(one: str, two: str, three: str) -> None:
    assert distance(one, one) == 0
    assert distance(one, two) == distance(two, one) <= 1
    if one and two and three:
        plain = [distance(a, b) * max(len(a), len(b)) for a, b in ((one, two), (two, three), (one, three))]
        assert plain[2] <= plain[0] + plain[1] + 1e-9


def test_what_sounds_alike_is_no_difference_but_what_does_not_is() -> None:
    written = tokens("the", "ferryman", "rowed", "slowly")
    assert differences(written, tokens("the", "ferrymen", "rode", "slowly")) == []
    (part,) = differences(written, tokens("the", "ferryman", "lantern", "slowly"))
    assert str(part.mismatch) == "2.00 s: 'rowed' is written, and what is heard sounds like 'lantern'"
    (part,) = differences(written, tokens("the", "slowly"))
    assert (part.mismatch.kind, part.mismatch.written) == ("missing", "ferryman rowed")
    (part,) = differences(written, tokens("the", "ferryman", "children", "rowed", "slowly"))
    assert (part.mismatch.kind, part.mismatch.heard) == ("extra", "children")


def test_most_of_a_transcript_must_be_heard() -> None:
    told = [Mismatch(kind="missing", written="slowly", heard="", at=1.0)]
    check_share(Path("take.wav"), told, 5, 10)
    with pytest.raises(InputError, match="6 of 10 words of the transcript are not heard in it"):
        check_share(Path("take.wav"), told, 6, 10)


def test_arpabet_goes_there_and_back() -> None:
    assert all(from_ipa(ipa) == [name] for name, ipa in IPA.items())
    assert from_ipa("ˈlaɪtˌhaʊs") == ["L", "AY", "T", "HH", "AW", "S"]


@pytest.mark.parametrize("label", ["", "sil", " SP ", "<eps>", "<p:>", "#"])
def test_silence_has_many_names(label: str) -> None:
    assert silent(label)
    assert not silent(f"{label} word")


def test_phones_are_read_in_whatever_alphabet_they_are() -> None:
    assert as_ipa(["T", "OW1", "N"]) == ["t", "oʊ", "n"]
    assert as_ipa(["ʃ", "øː", "n"]) == ["ʃ", "øː", "n"]
    assert as_ipa(["S", "2:", "n", "6"]) == ["ʃ", "øː", "n", "ɐ"]
    assert as_ipa(["T", "!!", "N"]) == ["t", "ə", "n"]
