"""The text of an SSML document, while it is put together from its pieces."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from scorebreath.script.kinds import ALNUM, kinds
from scorebreath.script.marks import Mark

_SPACES = re.compile(r"[ \t\n]+")
_CLOSERS = frozenset("\"')")
_MARKS = frozenset(".!?Fe,;:M-N")
"""Kinds of what may end a sentence that the document ends."""
_GAPS = ("", " ", "\n\n")
_END = 16


@dataclass(slots=True)
class Writer:
    """White space counts as in XML: any run of it is one space; paragraphs are the document's own."""

    pieces: list[str] = field(default_factory=list)
    marks: list[tuple[int, Mark]] = field(default_factory=list)
    """places in the text so far, and what stands there"""
    ends: list[int] = field(default_factory=list)
    """places of characters that end a sentence"""
    length: int = 0
    tail: str = ""
    """the last code points"""
    gap: str = ""
    """white space that waits for the next letter"""
    said: bool = False
    """whether the sentence has a letter or a figure"""

    def text(self, text: str) -> None:
        """Append what is said."""
        words = _SPACES.sub(" ", text)
        core = words.strip(" ")
        if words[:1] == " ":
            self._widen(" ")
        if core:
            self._push(self.gap if self.length else "")
            self.gap = ""
            self._push(core)
            self.said = self.said or any(kind in ALNUM for kind in set(kinds(core)))
            if words[-1] == " ":
                self._widen(" ")

    def mark(self, mark: Mark) -> None:
        """Put a mark behind what is there."""
        self.marks.append((self.length, mark))

    def sentence(self) -> None:
        """A sentence ends here, if there is any: with a full stop of its own, or one it is given."""
        if self.said:
            shown = kinds(self.tail)
            while shown and shown[-1] in _CLOSERS:
                shown = shown[:-1]
            if shown[-1:] not in _MARKS or not shown:
                self._push(".")
            self.ends.append(self.length - 1)
        self.said = False
        self._widen(" ")

    def paragraph(self) -> None:
        """A paragraph ends here."""
        self.said = False
        self._widen("\n\n")

    def _widen(self, gap: str) -> None:
        """White space that is at least `gap`."""
        self.gap = max(self.gap, gap, key=_GAPS.index)

    def _push(self, piece: str) -> None:
        if piece:
            self.pieces.append(piece)
            self.length += len(piece)
            self.tail = (self.tail + piece[-_END:])[-_END:]
