"""Text to sentences for these tests alone, simpler than the real reader: words by spaces, edges by the last marks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace

from scorebreath.planning.model import BreathGroup, Planner
from scorebreath.script.model import Edge, ScriptWord, Sentence, SentenceType
from scorebreath.spans import Span, join

MARKS = "\"'()[]“”‘’«»„.,;:!?…—–_-*"
EDGES: tuple[tuple[str, Edge], ...] = ((".!?", "sentence"), (";:…—–)", "semicolon"), (",", "comma"), ("_", "marker"))


def sentences(text: str, poem: bool = False) -> list[Sentence]:
    """A sentence ends with a word that ends in . ! or ?, but not in "Dr."; a paragraph with an empty line."""
    found: list[Sentence] = []
    matches = list(re.finditer(r"[^\s-]+-?|-+", text))
    words: list[ScriptWord] = []
    stanza = 0
    for match, after in zip(matches, [*matches[1:], None], strict=True):
        gap = text[match.end() : after.start()] if after else text[match.end() :]
        edge = _edge(match.group(), gap, after is None, poem)
        words.append(_word(match, edge, text.count("\n", 0, match.start())))
        if edge in ("sentence", "paragraph"):
            found.append(_sentence(words, text, after.start() if after else len(text), stanza))
            stanza += edge == "paragraph"
            words = []
    return found


def windows(whole: Iterable[Sentence], size: int) -> list[Sentence]:
    """The same words, but sentences come in pieces of `size` words; all but the last piece are incomplete."""
    pieces: list[Sentence] = []
    for sentence in whole:
        starts = range(0, len(sentence.words), size)
        for start in starts:
            words = sentence.words[start : start + size]
            last = start == starts[-1]
            origin = sentence.source.start
            source = Span(words[0].source.start, words[-1].source.end)
            until = sentence.source.end if last else sentence.words[start + size].source.start
            gap = sentence.gap if last else sentence.text[source.end - origin : until - origin]
            text = Span(source.start - origin, source.end - origin).cut(sentence.text)
            pieces.append(replace(sentence, source=source, text=text, gap=gap, words=words, complete=last))
    return pieces


def at_once(planner: Planner, given: Sequence[Sentence]) -> list[BreathGroup]:
    """All groups, decided with the whole text in view: nothing is taken from `feed` before the end is known."""
    for sentence in given:
        planner.feed(sentence)
    return list(planner.finish())


def _edge(written: str, gap: str, last: bool, poem: bool) -> Edge:
    if last or gap.count("\n") > 1:
        return "paragraph"
    if not gap:
        return "joint"
    tail = written[len(written.rstrip(MARKS)) :]
    if written == "Dr.":
        tail = ""
    for marks, edge in EDGES:
        if any(mark in tail for mark in marks):
            return edge
    return "line" if poem and "\n" in gap else "word"


def _word(match: re.Match[str], edge: Edge, line: int) -> ScriptWord:
    written, source = match.group(), Span(match.start(), match.end())
    bare = written.strip(MARKS) or written
    said = written.replace("_", "")
    return ScriptWord(
        source=source,
        text=bare,
        spoken=join([(said, source)]),
        words=tuple(re.findall(r"\w+(?:['’]\w+)*", bare)) or (bare,),
        edge=edge,
        line=line,
    )


def _sentence(words: list[ScriptWord], text: str, until: int, stanza: int) -> Sentence:
    source = Span(words[0].source.start, words[-1].source.end)
    tail = words[-1].spoken.text
    kind: SentenceType = "question" if "?" in tail else "exclamation" if "!" in tail else "statement"
    return Sentence(
        source=source,
        text=source.cut(text),
        gap=text[source.end : until],
        type=kind,
        words=tuple(words),
        complete=True,
        stanza=stanza,
    )
