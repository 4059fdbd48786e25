"""From units to breath groups: their parts, and what the markup asks for before, between and after them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from scorebreath.planning.model import BreathGroup, Part
from scorebreath.planning.units import Unit
from scorebreath.score.document import CutReason, Site
from scorebreath.script.marks import Act, ActName, Mark, ProsodyMark, VoiceMark
from scorebreath.script.model import Edge, ScriptWord, SentenceType
from scorebreath.spans import Run, Span, SpokenText

SITES: dict[Edge, Site] = {
    "paragraph": "paragraph",
    "sentence": "sentence",
    "semicolon": "semicolon",
    "comma": "comma",
    "line": "line",
    "marker": "marker",
    "word": "word",
    "joint": "word",
}
"""What a cut after each edge is called: by what stands there, whichever rule chose it; `tag` where the markup chose,
`text end` at the end of all."""

PARTING: frozenset[ActName] = frozenset({"pause", "hold", "sniff"})
"""Acts that divide a group into parts."""


class _Word(NamedTuple):
    """A word of a group, as far as its parts go."""

    word: ScriptWord
    syllables: int
    end: int
    sentence_type: SentenceType
    closes: bool
    stanza: int | None


class Assembler:
    """Groups of one text, in order; carries what stays in force from group to group.

    Args:
        sentences_apart: Whether a sentence's end inside a group divides it.
    """

    def __init__(self, *, sentences_apart: bool) -> None:
        """Start before the text."""
        self._sentences_apart = sentences_apart
        self._index = 0
        self._before: tuple[Mark, ...] = ()
        self._prosody: ProsodyMark | None = None
        self._voice = ""

    def begin(self, marks: Sequence[Mark]) -> None:
        """Marks that stand before a text's first word: the next group's."""
        self._before = (*self._before, *marks)

    def group(self, units: Sequence[Unit], reason: CutReason, *, last: bool) -> BreathGroup:
        """The next group.

        Args:
            units: All of them.
            reason: Why it ends there.
            last: Whether the text ends with it: what the markup asks for behind it is then its own.
        """
        before, behind = self._before, units[-1].after
        self._heed(before)
        voice = self._voice
        parts = tuple(self._parts(units))
        source = Span(units[0].start, units[-1].end)
        words = tuple(word for part in parts for word in part.words)
        group = BreathGroup(
            index=self._index,
            source=source,
            text="".join(unit.written for unit in units)[: source.length],
            spoken=say(words),
            words=words,
            syllables=sum(part.syllables for part in parts),
            sentence_type=parts[-1].sentence_type,
            ends_sentence=parts[-1].ends_sentence,
            parts=parts,
            cut=reason,
            before=before,
            after=behind if last else (),
            voice=voice,
        )
        self._index += 1
        self._before = () if last else behind
        if last:
            self._heed(behind)
        return group

    def _heed(self, marks: Sequence[Mark]) -> None:
        for mark in marks:
            if isinstance(mark, ProsodyMark):
                self._prosody = mark
            elif isinstance(mark, VoiceMark):
                self._voice = mark.voice

    def _parts(self, units: Sequence[Unit]) -> Iterator[Part]:
        before: tuple[Mark, ...] = ()
        site: Site = "word"
        words = list(_words(units))
        start = 0
        for count, one in enumerate(words, 1):
            if count < len(words) and not self._divided(one):
                continue
            yield _part(words[start:count], before, site, self._prosody)
            before, site, start = one.word.after, SITES[one.word.edge], count
            if count < len(words):
                self._heed(before)

    def _divided(self, one: _Word) -> bool:
        if self._sentences_apart and one.closes:
            return True
        return any(
            isinstance(mark, ProsodyMark) or (isinstance(mark, Act) and mark.name in PARTING) for mark in one.word.after
        )


def _words(units: Sequence[Unit]) -> Iterator[_Word]:
    for unit in units:
        last = len(unit.words) - 1
        for place, (word, count, end) in enumerate(zip(unit.words, unit.counts, unit.ends, strict=True)):
            yield _Word(word, count, end, unit.sentence_type, unit.closes and place == last, unit.stanza)


def _part(words: Sequence[_Word], before: tuple[Mark, ...], site: Site, prosody: ProsodyMark | None) -> Part:
    said = tuple(one.word for one in words)
    return Part(
        source=Span(said[0].source.start, words[-1].end),
        spoken=say(said),
        words=said,
        syllables=sum(one.syllables for one in words),
        sentence_type=words[-1].sentence_type,
        ends_sentence=words[-1].closes,
        site=site,
        before=before,
        prosody=prosody,
        stanza=words[0].stanza,
    )


def say(words: Sequence[ScriptWord]) -> SpokenText:
    """The words as a voice is to say them, a space between them except after `joint`; spans stay absolute."""
    text: list[str] = []
    runs: list[Run] = []
    at = 0
    space = ""
    for word in words:
        if not word.spoken.text:
            continue
        text += (space, word.spoken.text)
        at += len(space)
        runs += (Run(at + run.start, at + run.end, run.source) for run in word.spoken.runs)
        at += len(word.spoken.text)
        space = "" if word.edge == "joint" else " "
    return SpokenText(text="".join(text), runs=tuple(runs))
