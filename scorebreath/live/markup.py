"""Inline tags in a text that arrives in pieces: a piece may end anywhere, even within a tag.

What cannot be a tag's surroundings any more goes on at once. A tag waits for its end and for the word behind it, since
that decides where its mark stands (`script.markup.settle`).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from scorebreath.errors import ScriptError
from scorebreath.script.marks import Mark
from scorebreath.script.markup.origin import Origin
from scorebreath.script.markup.settle import settle
from scorebreath.script.markup.tags import find

CONTEXT = 200
"""Code points of what went before that a tag's place may depend on."""
LONGEST_TAG = 400
"""Code points after which an open bracket is text."""
_UNSURE = re.compile(r"(?:\s+|\s*\S{1,40})$")
"""The end of a text that may go on: a word, which may not be whole, and the space before it."""
_WHOLE = re.compile(r"[.,;:!?\u2026)\]}\"'\u201d\u2019\u00bb]$")
"""What a word ends with that is whole."""
_FACE = re.compile(r">?[:;=]['-]?")
"""What may be half of an emoticon."""
_SAFE = re.compile(r"(?<=[^\s\]\\])\s(?=\w)")
_BRACKET = re.compile(r"\[[^\]\n]*\]?")


class Clean(NamedTuple):
    """A piece without its tags."""

    text: str
    marks: tuple[Mark, ...]
    """their places count from the text's beginning"""
    problem: str = ""
    """what was wrong with a tag, which is left out"""


@dataclass(slots=True)
class TagStream:
    """Takes pieces of one text; gives them back without tags."""

    start: int = 0
    """place of the text's beginning in a larger one"""
    _pending: str = ""
    _behind: str = field(default="", init=False)
    _length: int = field(default=0, init=False)

    def feed(self, piece: str) -> list[Clean]:
        """Take a piece; give what is certain now."""
        self._pending += piece
        if "[" not in self._pending:
            kept = _UNSURE.search(self._pending)
            return self._give(kept.start() if kept else len(self._pending))
        cuts = [match.start() for match in _SAFE.finditer(self._pending)]
        for cut in reversed(cuts):
            if not _open(self._pending[:cut]):
                return self._give(cut)
        return []

    def keep(self, *, word: bool) -> str:
        """Take out the beginning of a tag at the end of what came, or of a word, if that is wanted."""
        at = self._pending.rfind("[") if _open(self._pending) else -1
        token = re.search(r"\S+$", self._pending)
        if at < 0 and word and token and (not _WHOLE.search(token.group()) or _FACE.fullmatch(token.group())):
            at = token.start()
        if at < 0:
            return ""
        begun, self._pending = self._pending[at:], self._pending[:at]
        return begun

    def finish(self) -> list[Clean]:
        """The text is over, or nothing more of it comes for now: give all."""
        return self._give(len(self._pending))

    def _give(self, end: int) -> list[Clean]:
        raw, self._pending = self._pending[:end], self._pending[end:]
        if not raw:
            return []
        pieces, found, problem = _without_tags(raw)
        before = len(self._behind)
        bare = self._behind + "".join(pieces)
        text, marks, _ = settle(bare, [(place + before, mark) for place, mark in found], ())
        clean, shift = text[before:], self.start + self._length - before
        self._length += len(clean)
        self._behind = text[-CONTEXT:]
        return [Clean(clean, tuple(replace(mark, at=mark.at + shift) for mark in marks), problem)]


def _without_tags(raw: str) -> tuple[list[str], list[tuple[int, Mark]], str]:
    """A piece between its tags, the marks, and what is wrong with a tag: that one is left out."""
    problem = ""
    while True:
        try:
            pieces, found = find(Origin(text=raw, file=""))
        except ScriptError as error:
            problem = problem or str(error).splitlines()[0]
            lines = raw.split("\n")
            at = sum(len(line) + 1 for line in lines[: error.line - 1]) + error.column - 1
            bracket = _BRACKET.match(raw, at)
            raw = raw[:at] + raw[bracket.end() if bracket else at + 1 :]
        else:
            return pieces, found, problem


def _open(text: str) -> bool:
    """Whether a text ends within a bracket that may yet become a tag."""
    at = text.rfind("[")
    if at < 0 or len(text) - at > LONGEST_TAG:
        return False
    return "]" not in text[at:] and "\n" not in text[at:]
