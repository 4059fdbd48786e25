"""A sentence's text to a `Sentence`."""

from __future__ import annotations

from typing import Literal

from scorebreath.script.model import ScriptWord, Sentence, SentenceType
from scorebreath.script.normalise.speak import speak
from scorebreath.script.normalise.tables import tables
from scorebreath.script.words import cut
from scorebreath.spans import Span

Ending = Literal["paragraph", "sentence"]
"""What can end with a sentence."""

_QUESTION = frozenset("?？؟⁇⁉⁈‽՞፧")
_EXCLAMATION = frozenset("!！‼")
_ENDING: dict[SentenceType, str] = {"statement": ".", "question": "?", "exclamation": "!"}


def make_sentence(
    text: str,
    gap: str,
    start: int,
    *,
    language: str,
    poem: bool,
    line: int,
    stanza: int,
    edge: Ending | None,
) -> Sentence | None:
    """Read one sentence.

    Args:
        text: As written, from its first word to its last mark.
        gap: What follows, up to the next sentence.
        start: Place of `text` in the whole text.
        language: BCP 47 primary language.
        poem: Whether line ends are edges.
        line: Line it starts in, from 0.
        stanza: Paragraph it stands in, from 0.
        edge: What ends with it; None for a part of a sentence.

    Returns:
        The sentence, or None if there is no word in it.
    """
    written = cut(text, gap, start, poem=poem)
    if not written:
        return None
    kind = _type(text[written[-1].core.end - start :]) if edge else "statement"
    if edge:
        written[-1].edge, written[-1].mark = edge, _ENDING[kind]
    if line:
        for word in written:
            word.line += line
    words: tuple[ScriptWord, ...] = tuple(speak(written, tables(language), text, start))
    return Sentence(
        source=Span(start, start + len(text)),
        text=text,
        gap=gap,
        type=kind,
        words=words,
        complete=edge is not None,
        stanza=stanza,
    )


def _type(tail: str) -> SentenceType:
    """What kind of sentence the marks behind its last word end."""
    marks = set(tail)
    if marks & _QUESTION:
        return "question"
    return "exclamation" if marks & _EXCLAMATION else "statement"
