"""Emotions in time: A40-A44 and Y5 on phrases and words made by hand, and laws for any."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.expression.emotion import CLOSE, DECAY, HOLD, LONGEST_SILENCE, OPEN, RAMP, emotion_events
from scorebreath.score.events import Blink, Emotion, Level, Phone, Phrase, Pitch, Utterance, Word
from scorebreath.script.marks import EmotionMark
from scorebreath.units import snap

GAP = 0.05
"""s of silence between the words made here"""


def mark(at: int, name: str = "sad", intensity: float = 1.0, written: str = ":-(") -> EmotionMark:
    return EmotionMark(at=at, written=written, name=name, intensity=intensity)


def said(group: str, onset: float, *phrases: Sequence[float], start: int = 0) -> tuple[list[Phrase], Utterance]:
    """Words of so many seconds, a phrase each list; a word has 9 letters, a space and a phrase's mark follow.

    The phones end 10 ms before each word's nominal end.
    """
    words: list[Word] = []
    phones: list[Phone] = []
    made: list[Phrase] = []
    at, time = start, 0.0
    for number, lengths in enumerate(phrases):
        begun, from_ = time, at
        for length in lengths:
            words.append(Word(text="abcdefghi", onset=snap(time), duration=length, source=(at, at + 9)))
            phones.append(Phone(ipa="a", onset=snap(time), duration=snap(length - 0.01), word=len(words) - 1))
            phones.append(Phone(ipa="", onset=snap(time + length - 0.01), duration=snap(GAP + 0.01)))
            at, time = at + 10, snap(time + length + GAP)
        made.append(
            Phrase(
                id=f"{group}.phrase{number + 1}", body="body", group=group, onset=snap(onset + begun),
                duration=snap(time - GAP - begun), source=(from_, at - 1), break_index=4, position="internal",
                sentence_type="statement",
            )
        )  # fmt: skip
    phones.pop()
    utterance = Utterance(
        id=f"{group}.speech", body="body", group=group, onset=onset, duration=snap(time - GAP), media="0" * 64,
        gain_db=0.0, closing="final", words=tuple(words), phones=tuple(phones), pitch=Pitch(step=0.005, hertz=()),
        level=Level(step=0.01, db=()),
    )  # fmt: skip
    return made, utterance


def emotions(events: Sequence[Emotion | Blink]) -> list[Emotion]:
    return [event for event in events if isinstance(event, Emotion)]


def spans(events: Sequence[Emotion | Blink]) -> list[tuple[float, float, float]]:
    """Onset, climax and end of each emotion, to a microsecond."""
    return [(event.onset, snap(event.onset + event.apex), snap(event.end)) for event in emotions(events)]


def test_inside_a_phrase_it_is_full_at_its_place_and_gone_at_the_borders() -> None:
    """A40, A41, A19, A44."""
    phrases, speech = said("body.g1", 2.0, [0.5, 0.5], [0.4, 0.6, 0.5])
    found = emotion_events([mark(30, "kidding", written="; - )")], phrases, [speech], body="body")
    (emotion,) = emotions(found)
    onset = 2.0 + 2 * 0.55
    assert spans(found) == [(onset, onset + 0.39, onset + 1.6)]  # the phone's end, not the word's
    assert (emotion.name, emotion.intensity, emotion.phrases) == ("kidding", 1.0, ("body.g1.phrase2",))
    assert (emotion.origin, emotion.group, emotion.id) == ("markup", "body.g1", "body.g1.emotion1")
    assert emotion.rule == "A41: full at ; - ), within its phrase"


@pytest.mark.parametrize("at", [18, 19, 20])
def test_between_two_phrases_it_spans_both_wherever_the_punctuation_is(at: int) -> None:
    """A42: by the order of words, not by what stands between them."""
    phrases, speech = said("body.g1", 1.0, [0.5, 0.5], [0.4, 0.4])
    found = emotion_events([mark(at)], phrases, [speech], body="body")
    assert spans(found) == [(1.0, 2.04, 2.95)]
    assert emotions(found)[0].phrases == ("body.g1.phrase1", "body.g1.phrase2")


def test_between_two_phrases_it_spans_both_across_a_breath() -> None:
    first, one = said("body.g1", 1.0, [0.5, 0.5])
    second, two = said("body.g2", 3.2, [0.4, 0.4], [0.5], start=20)
    found = emotion_events([mark(19)], [*first, *second], [one, two], body="body")
    assert spans(found) == [(1.0, 2.04, 3.2 + 0.85)]
    assert emotions(found)[0].group == "body.g2"  # with whose marks it was given


def test_a_long_rest_is_not_spanned() -> None:
    first, one = said("body.g1", 1.0, [0.5, 0.5])
    second, two = said("body.g2", snap(2.05 + LONGEST_SILENCE + 0.1), [0.4], start=20)
    found = emotion_events([mark(19)], [*first, *second], [one, two], body="body")
    assert spans(found) == [(1.0, 2.04, 2.04 + DECAY)]


def test_at_the_ends_of_the_text_there_is_no_step() -> None:
    """Y5; S3's last `:-)`."""
    phrases, speech = said("body.g1", 2.0, [0.5, 0.5])
    before, behind = mark(0, "happy"), mark(40, "happy")
    found = emotion_events([before, behind], phrases, [speech], body="body", over=10.0)
    assert spans(found) == [(1.5, 2.0, 3.05), (2.0, 3.04, 3.54)]
    assert [event.id for event in found] == ["body.g1.emotion1", "body.g1.emotion2"]
    tight = emotion_events([before, behind], phrases, [speech], body="body", start=1.9, over=3.05)
    assert spans(tight) == [(1.9, 2.05, 3.05), (2.0, 2.9, 3.05)]


def test_a_short_phrase_borrows_from_the_silence_and_else_is_not_full() -> None:
    phrases, speech = said("body.g1", 2.0, [0.5], [0.06, 0.06], [0.5])
    found = emotion_events([mark(20)], phrases, [speech], body="body")
    onset, apex, end = spans(found)[0]
    assert onset == pytest.approx(2.49)
    assert end == pytest.approx(2.60 + RAMP)
    (emotion,) = emotions(found)
    assert 0.0 < emotion.intensity < 1.0
    ramps = emotion.apex, emotion.duration - emotion.apex
    assert min(ramps) >= RAMP * emotion.intensity - 1e-5
    assert apex == pytest.approx(onset + 0.13)


def test_a_wink_is_one_blink_on_the_right_at_the_climax() -> None:
    phrases, speech = said("body.g1", 2.0, [0.5, 0.5])
    found = emotion_events([mark(10, "kidding", written=";-)"), mark(10, "happy")], phrases, [speech], body="body")
    (wink,) = [event for event in found if isinstance(event, Blink)]
    assert (wink.left, wink.right) == (0.0, 1.0)
    assert (wink.close, wink.hold, wink.open) == (CLOSE, HOLD, OPEN)
    assert wink.onset + wink.close == pytest.approx(2.49)
    assert wink.rule == "A40: winks at ;-)"
    assert (wink.id, wink.group, wink.origin) == ("body.g1.wink1", "body.g1", "markup")


def test_equal_emotions_at_one_place_are_one_and_others_are_not() -> None:
    phrases, speech = said("body.g1", 2.0, [0.5, 0.5])
    marks = [mark(4, "sad", 0.4), mark(6, "happy", 0.5), mark(9, "sad", 0.7), mark(19, "sad", 0.0)]
    found = emotions(emotion_events(marks, phrases, [speech], body="body"))
    assert [(event.name, event.intensity) for event in found] == [("sad", 0.7), ("happy", 0.5)]


def test_speech_without_phrases_or_words() -> None:
    _, speech = said("body.g1", 2.0, [0.5, 0.5])
    (emotion,) = emotions(emotion_events([mark(10)], [], [speech], body="body"))
    assert (emotion.onset, emotion.end, emotion.phrases) == (2.0, 3.05, ())
    assert emotion_events([mark(10)], [], [], body="body") == []


LENGTHS = st.lists(st.lists(st.floats(0.02, 0.9).map(snap), min_size=1, max_size=4), min_size=1, max_size=4)


@given(
    groups=st.lists(st.tuples(st.floats(0.0, 6.0).map(snap), LENGTHS), min_size=1, max_size=4),
    places=st.lists(st.tuples(st.integers(-5, 400), st.sampled_from(["sad", "kidding"]), st.floats(0.0, 1.0))),
    over=st.none() | st.floats(0.0, 2.0).map(snap),
)
def test_no_emotion_ever_steps(
    groups: list[tuple[float, list[list[float]]]],
    places: list[tuple[int, str, float]],
    over: float | None,
) -> None:
    """Whatever the phrases are: no ramp steeper than the limit, nothing outside the time there is, ids apart."""
    phrases: list[Phrase] = []
    speeches: list[Utterance] = []
    time, at = 0.0, 0
    for number, (silence, lengths) in enumerate(groups):
        made, speech = said(f"body.g{number + 1}", snap(time + silence), *lengths, start=at)
        phrases, speeches = [*phrases, *made], [*speeches, speech]
        time, at = speech.end, made[-1].source[1] + 1
    marks = [mark(place, name, snap(share)) for place, name, share in sorted(places)]
    end = None if over is None else snap(time + over)
    found = emotion_events(marks, phrases, speeches, body="body", over=end)
    assert len({event.id for event in found}) == len(found)
    for event in found:
        assert event.onset >= 0.0
        assert end is None or event.end <= end + 2e-6
        if isinstance(event, Emotion):
            assert event.apex >= RAMP * event.intensity - 1e-5
            assert event.duration - event.apex >= RAMP * event.intensity - 1e-5
    assert {event.name for event in emotions(found)} == {one.name for one in marks if one.intensity > 0}
