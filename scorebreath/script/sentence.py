"""A sentence's text to a `Sentence`."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import replace
from operator import attrgetter
from typing import Literal

from scorebreath.script.marks import EmotionMark, Mark
from scorebreath.script.model import ScriptWord, Sentence, SentenceType
from scorebreath.script.normalise.speak import speak
from scorebreath.script.normalise.tables import tables
from scorebreath.script.told import Told, together
from scorebreath.script.words import cut
from scorebreath.spans import Span, SpokenText

Ending = Literal["paragraph", "sentence"]
"""What can end with a sentence."""

_QUESTION = frozenset("?？؟⁇⁉⁈‽՞፧")
_DOTTED_CAPITAL = ("az", "tr")
"""Languages with a dot on the capital I."""
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
    marks: Sequence[Mark] = (),
    emotions: Sequence[EmotionMark] = (),
    told: Sequence[tuple[int, Told]] = (),
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
        marks: What the markup asks for in it and up to the next sentence; before it only if it is the text's first.
        emotions: What its emoticons and emoji show, at such places too.
        told: What MaryXML tells of its words, each at a place of one of the word's letters, ascending.

    Returns:
        The sentence, or None if there is no word in it.
    """
    written = cut(text, gap, start, poem=poem, apart=[mark.at for mark in marks])
    if not written:
        return None
    kind = _type(text[written[-1].core.end - start :]) if edge else "statement"
    if edge:
        written[-1].edge, written[-1].mark = edge, _ENDING[kind]
    if line:
        for word in written:
            word.line += line
    first, *others = speak(written, tables(language), text, start)
    words = (_begun(first, language), *others)
    if told:
        words = _with_told(words, told)
    before: tuple[Mark, ...] = ()
    if marks or emotions:
        before, words = _hung(words, sorted((*marks, *emotions), key=attrgetter("at")))
    return Sentence(
        source=Span(start, start + len(text)),
        text=text,
        gap=gap,
        type=kind,
        words=words,
        complete=edge is not None,
        stanza=stanza,
        before=before,
    )


def hanging(sentence: Sentence) -> Iterator[Mark]:
    """All marks of a sentence, in order."""
    yield from sentence.before
    for word in sentence.words:
        yield from word.after


def _hung(words: tuple[ScriptWord, ...], marks: Sequence[Mark]) -> tuple[tuple[Mark, ...], tuple[ScriptWord, ...]]:
    """Marks before the first word, and the words, each with the marks between it and the next."""
    starts = [word.source.start for word in words]
    hung: dict[int, list[Mark]] = {}
    for mark in marks:
        hung.setdefault(bisect_left(starts, mark.at) - 1, []).append(mark)
    before = tuple(hung.pop(-1, ()))
    return before, tuple(
        replace(word, after=tuple(hung[index])) if index in hung else word for index, word in enumerate(words)
    )


def _with_told(words: tuple[ScriptWord, ...], told: Sequence[tuple[int, Told]]) -> tuple[ScriptWord, ...]:
    """The words, each with what is told of it: of several tokens where the word is made of them."""
    starts = [word.source.start for word in words]
    found: dict[int, list[Told]] = {}
    for place, one in told:
        found.setdefault(max(0, bisect_right(starts, place) - 1), []).append(one)
    return tuple(
        replace(word, told=together(found[index])) if index in found else word for index, word in enumerate(words)
    )


def _begun(word: ScriptWord, language: str) -> ScriptWord:
    """A sentence's first word with a capital in its spoken text.

    eSpeak takes a full stop for the end of a sentence only if no small letter follows. Nothing changes where the
    capital is more than one code point, so that the way back stays exact; the bare words stay as they are.
    """
    spoken = word.spoken.text
    place = next((place for place, letter in enumerate(spoken) if letter.isalnum()), None)
    if place is None:
        return word
    capital = "İ" if language in _DOTTED_CAPITAL and spoken[place] == "i" else spoken[place].upper()
    if len(capital) != 1 or capital == spoken[place]:
        return word
    text = spoken[:place] + capital + spoken[place + 1 :]
    return replace(word, spoken=SpokenText(text=text, runs=word.spoken.runs))


def _type(tail: str) -> SentenceType:
    """What kind of sentence the marks behind its last word end."""
    marks = set(tail)
    if marks & _QUESTION:
        return "question"
    return "exclamation" if marks & _EXCLAMATION else "statement"
