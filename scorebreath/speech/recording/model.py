"""What is heard in a recording: words and phones in time, breaths, and where the transcript says something else."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import shortened
from scorebreath.spans import Span

LONGEST = 120
"""Characters of a mismatch that are told; all of them are in its fields"""
Progress = Callable[[float], None]
"""Told the fraction that is done, 0..1."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Take:
    """A recording, read."""

    path: Path
    samples: NDArray[np.float32]
    """(n,), within -1..1, n > 0, not silent"""
    sample_rate: int
    """Hz"""
    notes: tuple[str, ...]
    """what was done to it, or is wrong with it"""

    @property
    def duration(self) -> float:
        """Seconds."""
        return len(self.samples) / self.sample_rate


@dataclass(frozen=True, slots=True, kw_only=True)
class Written:
    """A word of the transcript."""

    text: str
    """as written, without punctuation"""
    spoken: tuple[str, ...]
    """the bare words it is said as: ("twenty", "three") for 23"""
    source: Span
    """in the transcript, with its punctuation"""
    bare: Span
    """likewise, without it: as voices that speak name their words"""
    phrase_ends: bool = False
    """whether punctuation follows"""


@dataclass(frozen=True, slots=True, kw_only=True)
class HeardPhone:
    """A phone in the recording."""

    ipa: str
    start: float
    """s of the recording"""
    end: float
    """s"""
    stress: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class HeardWord:
    """A word in the recording."""

    word: int | None
    """its place in the transcript; None: it is not written there"""
    text: str
    start: float
    """s of the recording"""
    end: float
    """s"""
    phones: tuple[HeardPhone, ...] = ()
    """one after the other from start to end; empty where only the word's own times are known"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mismatch:
    """Where recording and transcript say different things."""

    kind: Literal["missing", "extra", "instead"]
    """written but not heard; heard but not written; something else is heard"""
    written: str
    """words of the transcript; empty for `extra`"""
    heard: str
    """as far as it was understood; empty for `missing`"""
    at: float
    """s of the recording"""

    def __str__(self) -> str:
        """As it is told.

        >>> print(Mismatch(kind="missing", written="very", heard="", at=3.2))
        3.20 s: 'very' is written and not heard
        """
        where, written, heard = f"{self.at:.2f} s", shortened(self.written, LONGEST), shortened(self.heard, LONGEST)
        if self.kind == "missing":
            return f"{where}: {written!r} is written and not heard"
        if self.kind == "extra":
            return f"{where}: {heard!r} is heard and not written"
        return f"{where}: {written!r} is written, and what is heard sounds like {heard!r}"


@dataclass(frozen=True, slots=True, kw_only=True)
class HeardBreath:
    """A breath in a silence of the recording."""

    start: float
    """s of the recording"""
    end: float
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Alignment:
    """The words of a transcript in a recording."""

    words: tuple[HeardWord, ...]
    """in the order of their times, none before the one before it ends"""
    mismatches: tuple[Mismatch, ...]
    by: str
    """what found them"""
