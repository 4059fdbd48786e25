"""A Score with a face made by hand, every kind of event of a face in it, for the tests of the report."""

from __future__ import annotations

import dataclasses

from scorebreath.score.document import Score
from scorebreath.score.events import Blink, Brow, Emotion, Event, Gaze, Head, Phone, Phrase, Utterance
from scorebreath.units import snap
from tests.curves.scores import Breath, build

SPEECH = 0.76
"""s at which the words of `faced` begin, seven in 3.5 s"""


def faced(*more: Event, tail: float = 1.0) -> Score:
    """Seven words with a question at their end, and a face that does a bit of everything."""
    score = build([Breath(speech=3.5, text="Poppy may bake a warm apple pie?")], tail=tail)
    return with_face(score, *acts(), *more)


def with_face(score: Score, *events: Event) -> Score:
    """The Score with more events, and with phones that open and shut the mouth in its utterances."""
    spoken = tuple(_phoned(event) if isinstance(event, Utterance) else event for event in score.events)
    return dataclasses.replace(score, events=(*spoken, *events))


def _phoned(utterance: Utterance) -> Utterance:
    phones = []
    for number, word in enumerate(utterance.words):
        half = snap(word.duration / 2)
        phones.append(Phone(ipa="p", onset=word.onset, duration=half, word=number))
        phones.append(
            Phone(ipa="a", onset=snap(word.onset + half), duration=snap(word.duration - half), word=number, stress=1)
        )
    return dataclasses.replace(utterance, phones=tuple(phones))


def acts() -> tuple[Event, ...]:
    """What the face of `faced` does."""
    return (
        blink("b1", 0.3),
        blink("wink", 2.2, left=0.0, rule="wink: ;-)"),
        Brow(
            id="w1", body="body", onset=1.2, duration=0.55, left=0.28, right=0.35, frown=0.0, apex=0.15, hold=0.15,
            rule="brow_at_maximum: 4.2 st",
        ),
        Brow(id="w2", body="body", onset=4.3, duration=0.7, left=0.0, right=0.0, frown=0.8, apex=0.2, hold=0.2,
             rule="word_search"),
        Head(
            id="h1", body="body", onset=1.2, duration=0.8, pitch=2.6, yaw=0.0, roll=-1.5, apex=0.3, rule="raise"
        ),
        Head(id="h2", body="body", onset=3.6, duration=1.2, pitch=4.0, yaw=3.0, roll=0.0, apex=0.3, hold=0.5,
             rule="question"),
        Gaze(id="g1", body="body", onset=0.0, duration=1.5, target="listener", yaw=0.0, pitch=0.0, move=0.0,
             rule="look"),
        Gaze(id="g2", body="body", onset=1.5, duration=1.5, target="away", yaw=-9.0, pitch=4.0, move=0.045,
             rule="away"),
        Gaze(id="g3", body="body", onset=3.0, duration=2.0, target="listener", yaw=0.0, pitch=0.0, from_yaw=-9.0,
             from_pitch=4.0, move=0.045, rule="glance"),
        Emotion(id="e1", body="body", onset=0.76, duration=2.5, name="kidding", apex=1.45, intensity=1.0,
                phrases=("p1",), origin="markup", rule=";-)"),
        Emotion(id="e2", body="body", onset=3.26, duration=1.4, name="happy", apex=0.9, intensity=0.7,
                phrases=("p2",), origin="markup", rule=":-)"),
        Phrase(id="p1", body="body", onset=0.76, duration=2.5, source=(0, 17), break_index=3, tone="h-l%",
               position="internal", sentence_type="question"),
        Phrase(id="p2", body="body", onset=3.26, duration=1.0, source=(17, 31), break_index=5, tone="h-h%",
               position="final", sentence_type="question"),
    )  # fmt: skip


def blink(id: str, onset: float, *, left: float = 1.0, right: float = 1.0, rule: str = "blink_by_itself") -> Blink:  # noqa: A002
    """A blink of 0.25 s, or a wink."""
    return Blink(
        id=id, body="body", onset=onset, duration=0.25, left=left, right=right, close=0.075, hold=0.015, open=0.16,
        rule=rule,
    )  # fmt: skip
