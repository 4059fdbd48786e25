"""What is seen of a placed group: pauses by their length, wherever the group lies; words of hesitation."""

from __future__ import annotations

from dataclasses import replace

import pytest

from scorebreath.expression.scene import Silence, scene
from scorebreath.expression.state import Placed
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.score.events import Phone, Utterance, Word
from scorebreath.speech.voices import open_voice
from scorebreath.units import snap
from tests.expression.performed import performed, placed, scenes


def with_gap(gap: float) -> Placed:
    """Two words of one utterance, a silence between them."""
    (step,) = (s for s in placed(performed("He went to")) if any(isinstance(e, Utterance) for e in s.events))
    (said,) = (event for event in step.events if isinstance(event, Utterance))
    ends = (said.phones[0].onset, 0.2, snap(0.2 + gap), snap(0.4 + gap))
    phones = (
        Phone(ipa="a", onset=ends[0], duration=snap(ends[1] - ends[0]), word=0),
        Phone(ipa="", onset=ends[1], duration=gap),
        Phone(ipa="a", onset=ends[2], duration=snap(ends[3] - ends[2]), word=1),
    )
    words = (Word(text="a", onset=0.0, duration=0.2), Word(text="a", onset=ends[2], duration=0.2))
    return Placed(events=(replace(said, phones=phones, words=words, duration=ends[3]),), place="here")


def silences(step: Placed, later: float) -> list[Silence]:
    moved = tuple(replace(event, onset=snap(event.onset + later)) for event in step.events)
    return list(scene(replace(step, events=moved), "en").silences)


@pytest.mark.parametrize("gap", [0.15, 0.6])
def test_a_pause_is_as_long_wherever_its_group_is_placed(gap: float) -> None:
    step, shorter = with_gap(gap), with_gap(snap(gap - 1e-5))
    for number in range(300):
        found = silences(step, number * 0.0377)
        assert len(found) == 1
        missed = silences(shorter, number * 0.0377)
        assert len(missed) == (gap > 0.15)
        if missed:
            assert found[0].search != missed[0].search


@pytest.mark.parametrize("text", ["It was, uhm, very nice.", "Uhm, the garden was so, er, wonderfully green."])
def test_a_word_of_hesitation_has_neither_accent_nor_maximum(text: str) -> None:
    with open_voice("espeak", "en") as voice:
        score = compile_text(text, voice=voice, media=MemoryStore(), parameters=Parameters(face="albrecht-2002"))
    (said,) = (seen for seen in scenes(score) if seen.hesitations)
    assert said.peaks and said.accents
    for word in said.hesitations:
        assert not any(peak.time in word or peak.text == word.text for peak in said.peaks)
        assert not any(accent.onset in word for accent in said.accents)
        marked = f" on {word.text!r}"
        assert {event.rule.partition(" (")[0] for event in score.events if event.rule.endswith(marked)} == {"search"}


def test_a_question_is_one_wherever_its_group_is_placed() -> None:
    """Its last word is often a phrase of its own: a sum of times must not fall before the phrase's beginning."""
    with open_voice("espeak", "en") as voice:
        score = compile_text("She went on, What is your name, child?", voice=voice, media=MemoryStore())
    (step,) = (s for s in placed(score) if any(isinstance(e, Utterance) for e in s.events))
    for number in range(300):
        later = snap(number * 0.003701)
        moved = tuple(replace(event, onset=snap(event.onset + later)) for event in step.events)
        found = scene(replace(step, events=moved), "en").questions
        assert [question.text for question in found] == ["child"]
