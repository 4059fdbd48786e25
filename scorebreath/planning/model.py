"""What planning makes: breath groups, each with the reason for its cut; and what a planner is."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from scorebreath.score.document import CutReason, Site
from scorebreath.script.marks import Mark, ProsodyMark
from scorebreath.script.model import ScriptWord, Sentence, SentenceType
from scorebreath.spans import Span, SpokenText

SyllableCounter = Callable[[Sequence[str]], Sequence[int]]
"""Syllables of each bare spoken word; called with many words at a time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """A stretch of a breath group that is spoken in one go; between two parts there is a pause without a breath.

    A group is divided where its markup asks for a pause, a sniff, a held breath or another way of speaking, and, by
    `natural`, where a sentence ends inside it.
    """

    source: Span
    spoken: SpokenText
    words: tuple[ScriptWord, ...]
    syllables: int
    sentence_type: SentenceType
    ends_sentence: bool
    site: Site = "word"
    """what stands before it; of the first part: of no meaning"""
    before: tuple[Mark, ...] = ()
    """what the markup asks for between the part before and this one; empty in the first part (see the group's)"""
    prosody: ProsodyMark | None = None
    """in force while it is spoken"""
    stanza: int | None = None
    """of verse, from 0: its first word's; None in prose"""


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
    parts: tuple[Part, ...]
    """at least one; together they are the group"""
    before: tuple[Mark, ...] = ()
    """what the markup asks for between the group before (or the beginning) and this one"""
    after: tuple[Mark, ...] = ()
    """what it asks for after the last word of the text; empty in all other groups"""
    voice: str = ""
    """name of the voice that speaks it; empty: the one the text began with"""


class Planner(Protocol):
    """Cuts text into breath groups as it arrives.

    A group is released as soon as later text can no longer change it. It ends where the markup asks for what takes a
    new breath (`marks.DIVIDING`) or for another voice, and never where it forbids one.
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
