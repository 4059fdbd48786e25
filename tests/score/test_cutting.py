"""Tests of what cuts do to events."""

from __future__ import annotations

import dataclasses
import json

import pytest

from scorebreath.errors import ScoreError
from scorebreath.score.codec import dumps, loads
from scorebreath.score.cutting import Ending, beginning, end_of, endings
from scorebreath.score.document import Body, MediaInfo, Person, Score, VoiceInfo
from scorebreath.score.events import Cut, Event, Hold, Level, Marker, Motion, Phone, Pitch, Utterance, Word

MEDIA = "0" * 64
STILL = Motion(thorax=1.0, abdomen=1.0, shoulder=0.0, neck_pitch=0.0)


def hold(name: str, onset: float = 1.0, duration: float = 2.0, body: str = "a") -> Hold:
    """Something to cut."""
    return Hold(id=name, body=body, onset=onset, duration=duration, volume=0.4, thorax_share=0.5, motion=STILL)


def cut(onset: float, *targets: str, fade: float = 0.05, name: str = "c", body: str = "a") -> Cut:
    """A cut."""
    return Cut(id=name, body=body, onset=onset, duration=fade, targets=targets, fade=fade)


def score_of(*events: Event) -> Score:
    """A Score of two bodies."""
    voice = VoiceInfo(
        engine="tone", voice="tone", version="1", licence="CC0-1.0", sample_rate=24000, reference_db=-20.0
    )
    person = Person(vital_capacity=5.0, resting_volume=0.38)
    return Score(
        made_by="tests", seed=1, language="en", model="natural", text="", duration=9.0,
        bodies=(Body(id="a", voice=voice, person=person), Body(id="b", voice=voice, person=person)),
        media={MEDIA: MediaInfo(path="s.wav", frames=1, sample_rate=24000, kind="speech")}, events=events,
    )  # fmt: skip


def test_the_earliest_cut_counts_and_of_two_at_once_the_faster_fade() -> None:
    """In whatever order they come."""
    cuts = [cut(2.0, "h", name="late"), cut(1.5, "h", fade=0.2, name="slow"), cut(1.5, "h", "i", fade=0.1, name="fast")]
    for order in (cuts, cuts[::-1]):
        assert endings(order) == {"h": Ending(time=1.5, fade=0.1), "i": Ending(time=1.5, fade=0.1)}


@pytest.mark.parametrize(
    ("time", "end", "shortened", "prevented"),
    [(0.5, 1.0, False, True), (1.0, 1.0, False, True), (2.5, 2.5, True, False), (3.0, 3.0, False, False),
     (4.0, 3.0, False, False)],
)  # fmt: skip
def test_when_a_cut_event_is_over(time: float, end: float, shortened: bool, prevented: bool) -> None:
    """What would begin at the cut or later never happens; what has ended has ended."""
    event = hold("h")
    ends = endings([event, cut(time, "h")])
    assert end_of(event, ends) == end
    assert (ends["h"].shortens(event), ends["h"].prevents(event)) == (shortened, prevented)
    assert end_of(hold("other"), ends) == 3.0


@pytest.mark.parametrize(
    ("targets", "message"),
    [(("nobody",), "event 'c' cuts 'nobody', which is no event of the score"),
     (("h", "theirs"), "event 'c' cuts 'theirs', an event of 'b'; expected one of its own, 'a'"),
     (("c",), "event 'c' cuts 'c', which is a cut, too; what is cut stays cut")],
)  # fmt: skip
def test_a_cut_of_what_it_cannot_cut_is_refused(targets: tuple[str, ...], message: str) -> None:
    """As soon as the Score is made, in whatever order its events stand."""
    events = (cut(2.0, *targets), hold("h"), hold("theirs", body="b"))
    with pytest.raises(ScoreError) as caught:
        score_of(*events)
    assert str(caught.value) == message
    document = json.loads(dumps(score_of(*events[1:], cut(2.0, "h"))))
    document["events"][-1]["targets"] = list(targets)
    with pytest.raises(ScoreError, match="event 'c' cuts"):
        loads(json.dumps(document).encode(), "it")


def test_a_cut_may_stand_before_what_it_cuts_and_end_it_twice() -> None:
    """Nothing is wrong with that."""
    score = score_of(cut(0.5, "h", name="one"), cut(0.5, "h", name="two"), hold("h"), Marker(
        id="m", body="a", onset=0.0, duration=0.0, name="here"
    ))  # fmt: skip
    assert endings(score.events)["h"].prevents(hold("h"))
    assert loads(dumps(score), "it") == score


def said() -> Utterance:
    """Three words of half a second, a phone each; values every 10 ms."""
    return Utterance(
        id="u", body="a", onset=1.0, duration=1.5, media=MEDIA, gain_db=0.0, closing="final",
        words=tuple(Word(text=text, onset=0.5 * n, duration=0.5) for n, text in enumerate("abc")),
        phones=tuple(Phone(ipa="a", onset=0.5 * n, duration=0.5, word=n) for n in range(3)),
        pitch=Pitch(step=0.01, hertz=tuple(100.0 + n for n in range(150))),
        level=Level(step=0.01, db=tuple(-20.0 - n / 10 for n in range(150))),
    )  # fmt: skip


def test_the_beginning_of_an_utterance_is_what_was_said() -> None:
    """Words and phones under way are shortened, later ones gone; level and pitch go one step further."""
    part = beginning(said(), 1.7)
    assert (part.onset, part.duration) == (1.0, 0.7)
    assert [(word.text, word.duration) for word in part.words] == [("a", 0.5), ("b", 0.2)]
    assert [(phone.word, phone.duration) for phone in part.phones] == [(0, 0.5), (1, 0.2)]
    assert part.level.db == said().level.db[: len(part.level.db)]
    assert 70 <= len(part.level.db) <= 72
    assert len(part.pitch.hertz) == len(part.level.db)


def test_a_word_that_begins_at_the_cut_was_not_said() -> None:
    """Not even for no time; and a phone of a word that is gone has none."""
    assert [word.text for word in beginning(said(), 1.5).words] == ["a"]
    turned = dataclasses.replace(said(), words=said().words[::-1])
    assert [(phone.word, phone.ipa) for phone in beginning(turned, 1.7).phones] == [(None, "a"), (0, "a")]


def test_an_utterance_cut_after_its_end_is_whole() -> None:
    """Nothing is missing."""
    assert beginning(said(), 2.5) == said()
    assert beginning(said(), 7.0) == said()
