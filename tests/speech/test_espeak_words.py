"""Which word of the text is spoken when."""

from __future__ import annotations

import pytest

from scorebreath.spans import Span, SpokenText, join
from scorebreath.speech.espeak.library import WORD, Event
from scorebreath.speech.espeak.voice import EspeakVoice
from scorebreath.speech.espeak.words import words
from scorebreath.speech.model import SpeechRequest
from tests.speech.speaking import check, request

EVENTS: dict[str, tuple[str, list[tuple[int, int]], str]] = {
    "one each": ("The old man", [(1, 3), (5, 3), (9, 3)], "The|old|man"),
    "merged": ("It was the first", [(1, 2), (4, 3), (12, 5)], "It|was the|first"),
    "merged at the start": ("in the end", [(4, 3), (8, 3)], "in the|end"),
    "a number's overlap": ("of 1984 people", [(1, 2), (4, 4), (5, 4), (5, 4), (9, 6)], "of|1984***|people"),
    "an apostrophe": ("isn't it", [(1, 3), (7, 2)], "isn't|it"),
    "a hyphen": ("a well-known fact", [(1, 1), (3, 4), (14, 4)], "a|well-known|fact"),
    "a dash alone": ("one — two", [(1, 3), (7, 3)], "one|two"),
    "a dash between": ("one—two", [(1, 3), (5, 3)], "one|two"),
    "a spoken slash": ("/ b", [(1, 1), (3, 1)], "/|b"),
    "no spaces": ("天気 ok", [(1, 1), (2, 1), (4, 2)], "天|気|ok"),
    "a position behind the text": ("a b", [(1, 1), (9, 1)], "a|b"),
    "a position that goes back": ("a bc d", [(1, 1), (6, 1), (3, 2)], "a bc|d**"),
    "no events": ("a b", [], ""),
    "no words": ("— ...", [(1, 1)], "—"),
}
"""A text, its events' positions and lengths, and the words; a star for each event where there are several."""


@pytest.mark.parametrize("name", EVENTS)
def test_events_become_words(name: str) -> None:
    text, positions, expected = EVENTS[name]
    found = words(text, [Event(WORD, position, length, 0, "") for position, length in positions])
    stars = ["*" * len(word.events) if len(word.events) > 1 else "" for word in found]
    shown = [text[word.start : word.end] for word in found]
    assert "|".join(one + star for one, star in zip(shown, stars, strict=True)) == expected
    assert [word.merged for word in found] == [" " in one for one in shown]
    assert [event for word in found for event in word.events] == list(range(len(positions)))


ENGLISH = {
    "The old man said it was the best of 1984, didn't he?":
        ["The", "old", "man", "said", "it", "was the", "best", "of", "1984", "didn't", "he"],
    'She said: "a well-known café" — and left (quickly).':
        ["She", "said", "a", "well-known", "café", "and", "left", "quickly"],
}  # fmt: skip
GERMAN = {
    "Über die 23 Häuser flog, so heißt es, ein Käfer; er war's.":
        ["Über", "die", "23", "Häuser", "flog", "so", "heißt", "es", "ein", "Käfer", "er", "war's"],
}  # fmt: skip


@pytest.mark.parametrize("text", ENGLISH)
def test_english_words_know_their_places(english: EspeakVoice, text: str) -> None:
    speech = english.speak(request(text))
    check(text, speech)
    assert [word.text for word in speech.words] == ENGLISH[text]
    assert [word.merged for word in speech.words] == [" " in word for word in ENGLISH[text]]


@pytest.mark.parametrize("text", GERMAN)
def test_german_words_know_their_places(german: EspeakVoice, text: str) -> None:
    speech = german.speak(request(text))
    check(text, speech)
    assert [word.text for word in speech.words] == GERMAN[text]


def test_places_are_in_the_source_where_the_spoken_text_differs(english: EspeakVoice) -> None:
    source = "Ask Dr. No, please."
    spoken = join(
        [
            ("Ask ", Span(0, 4)),
            ("Doctor", Span(4, 7)),
            (" No", Span(7, 10)),
            (" then", None),
            (", please.", Span(10, 19)),
        ]
    )
    speech = english.speak(SpeechRequest(text=spoken, closing="final"))
    assert [(word.text, word.source and source[slice(*word.source)]) for word in speech.words] == [
        ("Ask", "Ask"), ("Doctor", "Dr."), ("No", "No"), ("then", None), ("please", "please"),
    ]  # fmt: skip


def test_places_far_into_the_text(english: EspeakVoice) -> None:
    text = "x" * 7
    spoken = SpokenText(text="hello world", runs=join([("hello", Span(1000, 1005)), (" world", Span(2000, 2006))]).runs)
    speech = english.speak(SpeechRequest(text=spoken, closing="final"))
    assert [word.source for word in speech.words] == [(1000, 1005), (2001, 2006)], text
