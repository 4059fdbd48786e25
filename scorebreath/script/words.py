"""A sentence cut into words as written: what each is, what hangs on it, and what follows it."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from scorebreath.script import emoticons, telephone
from scorebreath.script.items import items
from scorebreath.script.kinds import kinds as kinds_of
from scorebreath.script.model import Edge
from scorebreath.spans import Span

LONGEST = 64
"""Letters of a word; what is longer is cut into pieces, joined by `joint` edges."""

_CORE = re.compile(
    r"""
    (?: (?<![-Nad_.])[-N](?=S{0,4}\.?d) )? (?: (?<![^ n("]) p(?=\.?d) )? S{0,4}   # minus, about, currency, #
    (?: (?<![^ n("NSp-]) \.(?=d) )?                 # .5
    [ad] (?: [adm] | S | ['./&@_N-](?=S?[ad]) | (?<=d)[,:p](?=d) )*
    | km*
    | (?<![^ n(\"]) S (?![^ n.,;:!?)\"])                # a symbol by itself
    | (?<=[^ n][ ]) c (?=[ ][^ n])              # a < b
    | (?:(?<=d[ ])|(?<=[ n]a[ ])|(?<=\Aa[ ])) c (?=\.?d)  # 5 <3.2, x <3
    """,
    re.VERBOSE,
)
_HYPHEN = re.compile(r"(?<=[adm])[-N](?=[ad])|(?<=S)[-N](?=a)")
_RANGE = re.compile(r"[dS][-N][dS]")
_POWER = re.compile(r"(?<![\w.,])[0-9]+(?:[.,][0-9]+)?[eE][+\u2212\u2010\u2011-][0-9]{1,3}(?!\w)")
_LINK = re.compile(r"(?:https?://|www\.)[^\s<>\"“”]+")
_LINK_TAIL = re.compile(r"[^adkm/]+$")
_PIECE = re.compile(rf"(?:.{{1,{LONGEST}}}(?!m)|.{{{LONGEST}}}m*)", re.DOTALL)
_BELOW_ITEM: frozenset[Edge] = frozenset(("comma", "line", "marker", "word", "joint"))
"""Edges weaker than what an item of a list begins with."""
_MARK = re.compile(r"[.!?;:,eFMN_)-]")
_LEAD = re.compile(r"[^ n]*$")
_OPENING = re.compile(r"[(\"]+$")
_SPACED = frozenset((" ", ". ", "n", ".n"))
"""Between two words that are next to each other, perhaps behind the full stop of an abbreviation."""
_JOINT = re.compile(r"(?:[-N'm/]+|[()])?$")

_EDGES: tuple[tuple[re.Pattern[str], Edge, str], ...] = (
    (re.compile(r"\?"), "semicolon", "?"),
    (re.compile(r"!"), "semicolon", "!"),
    (re.compile(r"F"), "semicolon", "."),
    (re.compile(r"\.[\"']*[)\"']"), "semicolon", "."),
    (re.compile(r"e|\.\."), "semicolon", "..."),
    (re.compile(r";"), "semicolon", ";"),
    (re.compile(r":"), "semicolon", ":"),
    (re.compile(r"M|--|(?<=[ n])[-N](?=[ n])|[()]"), "semicolon", ","),
    (re.compile(r","), "comma", ","),
)
"""What stands between two words, in kinds: the edge it makes, and the mark a voice gets for it; first match wins.

A single full stop inside a sentence belongs to an abbreviation or a number and makes no edge, unless quotes close
on it.
"""


@dataclass(slots=True, kw_only=True)
class Written:
    """One word as written. Places are absolute in the text."""

    source: Span
    """with what hangs on it"""
    core: Span
    """without"""
    text: str
    """`core`, cut"""
    plain: bool
    """only letters, as far as can be told cheaply"""
    stopped: bool
    """a full stop follows at once"""
    spaced: bool
    """a single space, perhaps behind a full stop, leads to the next word"""
    edge: Edge
    mark: str
    """what a voice is given for the punctuation"""
    mark_source: Span | None
    """the punctuation it stands for"""
    marked: bool
    """a pause marker follows"""
    line: int


def cut(text: str, gap: str, start: int, *, poem: bool, apart: Sequence[int] = ()) -> list[Written]:
    """The words of a sentence or a part of one.

    Args:
        text: As written, from its first word to its last mark.
        gap: What follows up to the next sentence: decides the last word's edge if no sentence ends there.
        start: Place of `text` in the whole text.
        poem: Whether line ends are edges.
        apart: Places in the whole text, ascending, over which no words are read together.

    Returns:
        Words with lines counted from 0 and the edges they have inside a sentence; may be empty.
    """
    kinds = kinds_of(text + gap)
    shown = _cover(text, gap, kinds, poem=poem, apart=[place - start for place in apart])
    cores = [core for core in _cores(shown[: len(text)]) if core.cut(text) != "#"]
    cores = cores or list(_cores(kinds[: len(text)]))
    if not cores:
        return []
    words: list[Written] = []
    lead = line = place = 0
    opened = False
    lines = "\n" in text
    begun = items(text).newlines if lines else []
    for index, core in enumerate(cores):
        first, stop = core
        last = index == len(cores) - 1
        limit = len(kinds) if last else cores[index + 1].start
        between = shown[stop:limit]
        edge, mark = _edge(between.replace(")", "", 1) if opened else between, poem)
        opened = between == "("  # "engineer(s)": brackets inside a word
        if begun and edge in _BELOW_ITEM and bisect_left(begun, stop) < bisect_left(begun, min(limit, len(text))):
            edge, mark = "semicolon", mark or ","
        end, following = (len(text), limit) if last else _hang(between, stop)
        bare = between == " " and not last
        if lines:
            line += text.count("\n", place, first)
            place = first
        words.append(
            Written(
                source=Span(start + lead, start + end),
                core=Span(start + first, start + stop),
                text=text[first:stop],
                plain=not kinds[first:stop].strip("ak"),
                stopped=between[:1] == ".",
                spaced=bare or between in _SPACED,
                edge=edge,
                mark=mark,
                mark_source=None if bare or not (mark or last) else _mark_source(shown, stop, end, start),
                marked=not bare and "_" in between and (last or " " in between or "n" in between),
                line=line,
            )
        )
        lead = following
    if apart:
        starts = [word.core.start for word in words]
        for place in apart:
            words[max(0, bisect_left(starts, place) - 1)].spaced = False
    return words


def _cover(text: str, gap: str, kinds: str, *, poem: bool, apart: Sequence[int]) -> str:
    """Kinds with emoticons and bullets made spaces, links letters, telephone numbers and powers of ten figures."""
    shown = kinds
    if "\n" in text:
        for span in items(text).bullets:
            shown = shown[: span.start] + " " * span.length + shown[span.end :]
    if emoticons.possible(text) or (gap.strip() and emoticons.possible(gap)):
        for span in emoticons.spans(text + gap):
            shown = shown[: span.start] + " " * span.length + shown[span.end :]
    if "://" in text or "www." in text:
        for match in _LINK.finditer(text):
            stop = match.end()
            if tail := _LINK_TAIL.search(kinds, match.start(), stop):
                stop = tail.start()
            shown = shown[: match.start()] + "a" * (stop - match.start()) + shown[stop:]
    if "d" in shown:
        for match in _POWER.finditer(text):
            shown = shown[: match.start()] + "d" * len(match.group()) + shown[match.end() :]
        for span in telephone.spans(text):
            within = span.cut(shown)
            parted = bisect_right(apart, span.start) < bisect_left(apart, span.end)
            if "a" not in within and not parted and not (poem and "n" in within):
                shown = shown[: span.start] + "d" * span.length + shown[span.end :]
    return shown


def _cores(shown: str) -> Iterator[Span]:
    """The words themselves: compounds cut behind their hyphens, long words cut into pieces."""
    for match in _CORE.finditer(shown):
        first, last = match.span()
        found = match.group()
        if "-" not in found and "N" not in found:
            if last - first <= LONGEST:
                yield Span(first, last)
            else:
                yield from _pieces(shown, first, last)
            continue
        for hyphen in _HYPHEN.finditer(shown, first, last):
            place = hyphen.start()
            if _RANGE.match(shown, place - 1) or place <= first:
                continue
            yield from _pieces(shown, first, place)
            first = place + 1
        yield from _pieces(shown, first, last)


def _pieces(shown: str, first: int, last: int) -> Iterator[Span]:
    """A word of any length, in pieces that start with a letter or digit."""
    if last - first <= LONGEST:
        yield Span(first, last)
        return
    start = first
    for match in _PIECE.finditer(shown, first, last):
        if _has_letter(shown, match.end(), last) and _has_letter(shown, start, match.end()):
            yield Span(start, match.end())
            start = match.end()
    yield Span(start, last)


def _has_letter(shown: str, start: int, end: int) -> bool:
    """Whether a letter or digit stands near the start of a stretch."""
    return any(kind in "adk" for kind in shown[start : min(end, start + LONGEST)])


def _hang(between: str, end: int) -> tuple[int, int]:
    """Where a word's punctuation ends and the next word's begins, from the kinds between their letters."""
    if between == " ":
        return end, end + 1
    if " " not in between and "n" not in between:
        opening = _OPENING.search(between)
        stop = end + (opening.start() if opening and opening.start() else len(between))
        return stop, stop
    lead = _LEAD.search(between)
    following = lead.start() if lead else len(between)
    left = between[:following].rstrip(" n")
    glued = min((place for place in (left.find(" "), left.find("n")) if place >= 0), default=len(left))
    marks = [match.end() for match in _MARK.finditer(left)]
    return end + max([glued, *marks[-1:]]), end + following


def _edge(between: str, poem: bool) -> tuple[Edge, str]:
    """What follows a word inside a sentence, and the mark for it."""
    if between == " ":
        return "word", ""
    if between in ("", "-"):
        return "joint", between
    space = " " in between or "n" in between
    if not space and _JOINT.match(between) and "--" not in between:
        return "joint", "-" if between[0] in "-N" else ""
    for pattern, edge, mark in _EDGES:
        if pattern.search(between):
            return edge, mark
    if poem and "n" in between:
        return "line", ","
    return ("marker" if "_" in between and space else "word"), ""


def _mark_source(shown: str, core: int, end: int, start: int) -> Span | None:
    """The punctuation that hangs on a word, from its first mark to its last."""
    marks = [match.end() for match in _MARK.finditer(shown, core, end)]
    return Span(start + marks[0] - 1, start + marks[-1]) if marks else None
