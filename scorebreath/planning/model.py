"""What planning makes: breath groups, each with the reason for its cut; and what a planner is."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from scorebreath.score.document import CutReason
from scorebreath.script.model import ScriptWord, Sentence, SentenceType
from scorebreath.spans import Span, SpokenText

SyllableCounter = Callable[[Sequence[str]], Sequence[int]]
"""Syllables of each bare spoken word; called with many words at a time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BreathGroup:
    """What is said on one breath (B52), before anyone has spoken it."""

    index: int
    """from 0 in its body's text"""
    source: Span
    """first word to last mark"""
    text: str
    """as written: `source` cut from the text"""
    spoken: SpokenText
    """as a voice is to say it; source spans are absolute places in the text"""
    words: tuple[ScriptWord, ...]
    syllables: int
    """of all words"""
    sentence_type: SentenceType
    """of the sentence its last word belongs to"""
    ends_sentence: bool
    """whether its last word ends a sentence"""
    cut: CutReason


class Planner(Protocol):
    """Cuts text into breath groups as it arrives.

    A group is released as soon as later text can no longer change it.
    """

    def feed(self, sentence: Sentence) -> Iterator[BreathGroup]:
        """Take one sentence more; give the groups that are now certain."""

    def finish(self) -> Iterator[BreathGroup]:
        """The text is over; give all that is left."""


def plan(planner: Planner, sentences: Iterable[Sentence]) -> Iterator[BreathGroup]:
    """All groups of a text, each as soon as it is certain."""
    for sentence in sentences:
        yield from planner.feed(sentence)
    yield from planner.finish()
