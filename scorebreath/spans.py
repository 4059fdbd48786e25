"""Places in a text: half-open ranges of Unicode code points, and the way back from spoken to written text."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple


class Span(NamedTuple):
    """A half-open range `[start, end)` of code points."""

    start: int
    end: int

    @property
    def length(self) -> int:
        """Code points in the span."""
        return self.end - self.start

    def cut(self, text: str) -> str:
        """The part of `text` the span names."""
        return text[self.start : self.end]

    def hull(self, other: Span) -> Span:
        """The smallest span that holds both."""
        return Span(min(self.start, other.start), max(self.end, other.end))


class Run(NamedTuple):
    """A stretch of spoken text and the source it stands for."""

    start: int
    end: int
    source: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class SpokenText:
    """Text as a voice is to say it, with a map back to the source, character by character.

    Where a run is as long as its source, characters correspond one to one; elsewhere ("Dr." spoken as
    "Doctor") the whole run stands for its whole source.
    """

    text: str
    """What the voice says."""
    runs: tuple[Run, ...]
    """Ascending, gaps allowed (inserted characters stand for nothing)."""

    def source(self, start: int, end: int) -> Span | None:
        """Source span of spoken characters `[start, end)`, or None where they stand for nothing.

        >>> said = SpokenText(text="Doctor No", runs=(Run(0, 6, Span(0, 3)), Run(7, 9, Span(4, 6))))
        >>> said.source(0, 6), said.source(7, 8), said.source(6, 7)
        (Span(start=0, end=3), Span(start=4, end=5), None)
        """
        found: Span | None = None
        first = max(0, bisect_right(self.runs, start, key=lambda run: run.start) - 1)
        for run in self.runs[first:]:
            if run.start >= end:
                break
            if run.end <= start:
                continue
            part = run.source
            if run.end - run.start == part.length:
                part = Span(part.start + max(start, run.start) - run.start, part.start + min(end, run.end) - run.start)
            found = part if found is None else found.hull(part)
        return found


def join(parts: Iterable[tuple[str, Span | None]]) -> SpokenText:
    """A `SpokenText` from pieces, each with the source it stands for (None: inserted)."""
    text: list[str] = []
    runs: list[Run] = []
    at = 0
    for piece, source in parts:
        if source is not None and piece:
            runs.append(Run(at, at + len(piece), source))
        text.append(piece)
        at += len(piece)
    return SpokenText(text="".join(text), runs=tuple(runs))
