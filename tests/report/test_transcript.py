"""The text in pieces: as written, with the times of what is spoken."""

from __future__ import annotations

import dataclasses
import itertools

import pytest
from hypothesis import given, settings

from scorebreath.report.transcript import Piece, transcript
from scorebreath.score.document import Score
from scorebreath.score.events import Utterance, Word
from tests.curves.scores import Breath, build, scores


def words(pieces: list[Piece]) -> list[Piece]:
    return [piece for piece in pieces if "text" in piece and "onset" in piece]


def said(score: Score, new: tuple[Word, ...]) -> Score:
    events = tuple(dataclasses.replace(e, words=new) if isinstance(e, Utterance) else e for e in score.events)
    return dataclasses.replace(score, events=events)


def word(text: str, onset: float, source: tuple[int, int] | None) -> Word:
    return Word(text=text, onset=onset, duration=0.2, source=source)


@settings(max_examples=30, deadline=None)
@given(scores())
def test_the_pieces_are_the_text(score: Score) -> None:
    pieces = transcript(score, "body", score.duration)
    assert "".join(piece.get("text", "") for piece in pieces).strip() == score.text.strip()
    spoken = words(pieces)
    assert len(spoken) == sum(len(u.words) for u in score.of(Utterance))
    assert all(one["onset"] <= two["onset"] for one, two in itertools.pairwise(spoken))


def test_breaths_stand_before_their_words() -> None:
    score = build([Breath(text='He left. "Why'), Breath(text='not?" she said.')])
    pieces = transcript(score, "body", score.duration)
    kinds = [(p.get("text", "breath")) for p in pieces]
    assert kinds == ["breath", "He", " ", "left.", " ", '"Why', " ", "breath", 'not?"', " ", "she", " ", "said."]
    breath = next(piece for piece in pieces if "text" not in piece)
    assert breath == {"onset": 0.1, "end": 0.7, "depth": 0.16}


def test_marks_stay_with_the_word_they_follow_or_open() -> None:
    score = build([Breath(text="(He) left.")])
    pieces = transcript(said(score, (word("He", 0, (1, 3)), word("left", 0.5, (5, 9)))), "body", 9.0)
    assert [piece.get("text", "breath") for piece in pieces] == ["breath", "(", "He", ") ", "left", "."]


def test_a_breath_comes_after_the_marks_before_it_and_before_those_that_open() -> None:
    score = build([Breath(text="He left."), Breath(text='"Why?"')])
    first, second = score.of(Utterance)
    bare = {
        first.id: (word("He", 0, (0, 2)), word("left", 0.5, (3, 7))),
        second.id: (word("Why", 0, (10, 13)),),
    }
    events = tuple(dataclasses.replace(e, words=bare[e.id]) if isinstance(e, Utterance) else e for e in score.events)
    pieces = transcript(dataclasses.replace(score, events=events), "body", 99.0)
    shown = [piece.get("text", "breath") for piece in pieces]
    assert shown == ["breath", "He", " ", "left", ". ", "breath", '"', "Why", '?"']


def test_words_for_one_written_word_are_one() -> None:
    score = build([Breath(text="I have 23 cats.")])
    pieces = transcript(
        said(
            score,
            (
                word("I", 0, (0, 1)),
                word("twenty", 0.5, (7, 9)),
                word("three", 0.8, (7, 9)),
                word("cats", 1.2, (10, 15)),
            ),
        ),
        "body",
        score.duration,
    )
    assert [piece["text"] for piece in words(pieces)] == ["I", "23", "cats."]
    number = words(pieces)[1]
    assert (number["onset"], number["end"]) == pytest.approx((1.26, 1.76))


def test_words_that_stand_nowhere_appear_as_spoken() -> None:
    score = build([Breath(text="one two")])
    pieces = transcript(
        said(score, (word("two", 0, (4, 7)), word("er", 0.3, None), word("one", 0.5, (0, 3)))), "body", 9.0
    )
    assert [piece["text"] for piece in words(pieces)] == ["two", "er", "one"]


def test_only_what_is_spoken_in_time() -> None:
    score = build([Breath(text="one two three four.", speech=4.0)])
    pieces = transcript(score, "body", 2.0)
    assert [piece["text"] for piece in words(pieces)] == ["one", "two"]
    assert transcript(score, "nobody", 9.0) == [{"text": "one"}]


def test_wrapped_prose_is_unwrapped_and_verse_is_not() -> None:
    prose = "The quick brown fox jumps over the lazy dog, and then it all\nbegins anew."
    verse = "Short line,\nshort line."
    for text, breaks in ((prose, 0), (verse, 1), ("Para " * 14 + "graph.\n\nNext.", 2)):
        score = build([Breath(text=text)])
        shown = "".join(piece.get("text", "") for piece in transcript(score, "body", 99.0))
        assert shown.count("\n") == breaks
        assert len(shown) == len(text)
