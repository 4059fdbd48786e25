"""Words as written to words as spoken, each with the way back."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence

from scorebreath.script.kinds import kinds
from scorebreath.script.model import ScriptWord
from scorebreath.script.normalise.amounts import say_amount
from scorebreath.script.normalise.clean import clean, is_link, read_link
from scorebreath.script.normalise.context import Context, Part, Said
from scorebreath.script.normalise.figures import has_figures
from scorebreath.script.normalise.names import say_name
from scorebreath.script.normalise.tables import Tables
from scorebreath.script.words import Written
from scorebreath.spans import Run, Span, SpokenText, join

_BARE = re.compile(r"[ad][adm]*(?:'[ad][adm]*)*|km*")


def speak(words: Sequence[Written], tables: Tables, text: str, start: int) -> Iterator[ScriptWord]:
    """A sentence's words as a voice is to say them; several written words may become one ("7.30 Uhr").

    Args:
        words: As cut.
        tables: The language's.
        text: The sentence as written.
        start: Its place in the whole text.
    """
    index = 0
    while index < len(words):
        word = words[index]
        ruled = tables.known and not _as_written(word, tables)
        said = _say(Context(words, index, tables)) if ruled else None
        if said is None and word.plain and (word.text.isascii() or unicodedata.is_normalized("NFKC", word.text)):
            yield _plain(word)
            index += 1
            continue
        if said is None or not any(part for part, _ in said.parts):
            said = Said(clean(word.text, word.core.start, tables) or [(word.text, word.core)])
        last = words[index + said.taken - 1]
        yield _spoken(word, last, said, text[word.core.start - start : last.core.end - start])
        index += said.taken


def _as_written(word: Written, tables: Tables) -> bool:
    """Whether no rule can apply: small letters or a script without capitals, no full stop behind, no unit."""
    text = word.text
    if not word.plain or word.stopped or text in tables.unit:
        return False
    if text.isascii():
        return text.islower()
    return (text.islower() or text.lower() == text.upper()) and not any(mark in tables.special for mark in text)


def _say(context: Context) -> Said | None:
    """How a word is said, or None: as it is written."""
    word, tables = context.word, context.tables
    if is_link(word.text):
        return Said(read_link(word.text, word.core.start, tables))
    if said := say_name(context):
        return said
    if has_figures(word.text, tables):
        return say_amount(context)
    if word.text in tables.symbol:
        before = context.before
        return context.one(
            tables.one.get(word.text, tables.symbol[word.text]) if before == "1" else tables.symbol[word.text]
        )
    return None


def _plain(word: Written) -> ScriptWord:
    """A word said as it is written."""
    text, length = word.text, len(word.text)
    runs: tuple[Run, ...] = (Run(0, length, word.core),)
    if word.mark and word.mark_source:
        runs = (*runs, Run(length, length + len(word.mark), word.mark_source))
    return ScriptWord(
        source=word.source,
        text=text,
        spoken=SpokenText(text=text + word.mark, runs=runs),
        words=(text,),
        edge=word.edge,
        line=word.line,
        marked=word.marked,
    )


def _spoken(first: Written, last: Written, said: Said, text: str) -> ScriptWord:
    """Words from `first` to `last`, written as `text`, said as `said`."""
    parts: list[Part] = [*said.parts]
    if last.mark:
        parts.append((last.mark, _outside(last.mark_source, said)))
    elif last.edge == "joint" and parts[-1][0] != last.text:
        parts.append((" ", None))
    return ScriptWord(
        source=first.source.hull(last.source),
        text=text,
        spoken=join(parts),
        words=bare("".join(part for part, _ in said.parts)) or (first.text,),
        edge=last.edge,
        line=first.line,
        marked=last.marked,
    )


def _outside(mark: Span | None, said: Said) -> Span | None:
    """A mark's place, unless an abbreviation's full stop is all there is."""
    if mark is None or not said.stop:
        return mark
    start = max((place.end for _, place in said.parts if place), default=mark.start)
    return Span(max(mark.start, start), mark.end) if mark.end > start else None


def bare(spoken: str) -> tuple[str, ...]:
    """Words of a spoken text without punctuation.

    >>> bare("twenty-three o'clock, F.B.I")
    ('twenty', 'three', "o'clock", 'F', 'B', 'I')
    """
    return tuple(spoken[match.start() : match.end()] for match in _BARE.finditer(kinds(spoken)))
