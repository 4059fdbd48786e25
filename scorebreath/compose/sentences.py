"""The sentences that the words of a breath group belong to: of what kind, and how their phrases begin."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from scorebreath.planning.model import Part
from scorebreath.score.event import SentenceType
from scorebreath.script.asking import OPENING, asks_for_word
from scorebreath.script.model import Edge, ScriptWord

CLOSING: tuple[Edge, ...] = ("paragraph", "sentence")
"""Edges that end a sentence."""
PHRASES: tuple[Edge, ...] = (*CLOSING, "semicolon", "comma", "line")
"""Edges that end a phrase, strongest first."""
TYPES: dict[str, SentenceType] = {"?": "question", "!": "exclamation"}
"""Sentences by the mark a voice is given for their end; all others are statements."""


class SentenceSaid(NamedTuple):
    """The sentence a word belongs to, as far as it is known."""

    type: SentenceType
    openings: tuple[tuple[str, ...], ...]
    """first words of its phrases"""
    stanza: int | None

    def rises(self, language: str) -> bool:
        """Whether it ends high: a question for yes or no does; one for a word falls, as statements do."""
        return self.type == "question" and not asks_for_word(self.openings, language)


def sentences_of(parts: Sequence[Part], opening: tuple[str, ...]) -> list[SentenceSaid]:
    """The sentence of each word of a group; of the first one, `opening` is what was said of it before."""
    out: list[SentenceSaid] = []
    own: list[ScriptWord] = []
    stanza: int | None = None
    for number, part in enumerate(parts, 1):
        if not own:
            stanza = part.stanza
        for stop, word in enumerate(part.words, 1):
            own.append(word)
            last = stop == len(part.words)
            if word.edge not in CLOSING and not (last and (number == len(parts) or part.ends_sentence)):
                continue
            kind = part.sentence_type if last else TYPES.get(word.spoken.text[-1:], "statement")
            ended = word.edge in CLOSING or part.ends_sentence
            sentence = SentenceSaid(kind, _openings(own, opening, ended=ended), stanza)
            before = _asked_from(own, ended=ended) if kind == "question" else 0
            out += [sentence._replace(type="statement")] * before + [sentence] * (len(own) - before)
            own, opening = [], ()
            if stanza is not None and word.edge == "paragraph":
                stanza += 1
    return out


def _openings(own: Sequence[ScriptWord], begun: tuple[str, ...], *, ended: bool) -> tuple[tuple[str, ...], ...]:
    """The first words of a sentence's phrases, the first of which has begun already with `begun`.

    Where what ends a sentence is quoted, the mark at its end is the quotation's: that begins where it opens.
    """
    starts = [0, *(place for place, word in enumerate(own[:-1], 1) if word.edge in PHRASES)]
    quoted = _asked_from(own, ended=ended)
    if quoted:
        starts, begun = [quoted, *(place for place in starts if place > quoted)], ()
    return tuple(_opening(begun if not number else (), own[start:]) for number, start in enumerate(starts))


def _asked_from(own: Sequence[ScriptWord], *, ended: bool) -> int:
    """Where what a sentence ends with begins: with its last quotation, if the mark at its end is quoted; else 0."""
    last = own[-1]
    closed = ended and bool(last.spoken.runs) and last.spoken.runs[-1].source.end < last.source.end
    return (_quoted(own) or 0) if closed else 0


def _quoted(words: Sequence[ScriptWord]) -> int | None:
    """The last word that something unspoken, such as a quotation mark, stands before; None: there is none."""
    return next(
        (
            place
            for place in range(len(words) - 1, -1, -1)
            if words[place].spoken.runs and words[place].source.start < words[place].spoken.runs[0].source.start
        ),
        None,
    )


def _opening(begun: tuple[str, ...], words: Sequence[ScriptWord]) -> tuple[str, ...]:
    """The first words of what has begun already and goes on with `words`."""
    return (*begun, *(spoken for one in words[:OPENING] for spoken in one.words))[:OPENING]


def opening_left(parts: Sequence[Part], sentences: Sequence[SentenceSaid]) -> tuple[str, ...]:
    """The first words of the sentence that the last of some parts leaves unfinished; none where it ends."""
    return sentences[-1].openings[0] if sentences and not parts[-1].ends_sentence else ()


def quotation(said: Sequence[ScriptWord], stanza: int | None) -> SentenceSaid:
    """The question that is quoted at the end of what was said."""
    return SentenceSaid("question", (_opening((), said[_quoted(said) or 0 :]),), stanza)
