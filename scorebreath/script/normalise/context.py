"""What a rule of reading sees: one word, its neighbours, the language's tables; and what it answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from scorebreath.script.normalise.tables import Tables
from scorebreath.script.words import Written
from scorebreath.spans import Span

Part = tuple[str, Span | None]
"""A piece of spoken text and what it stands for."""


class Said(NamedTuple):
    """How one word, or several together, are said."""

    parts: Sequence[Part]
    taken: int = 1
    """words it takes"""
    stop: bool = False
    """whether the full stop behind them belongs to them: "Dr." """


@dataclass(frozen=True, slots=True)
class Context:
    """A word among the words of its sentence."""

    words: Sequence[Written]
    index: int
    tables: Tables

    @property
    def word(self) -> Written:
        """The word itself."""
        return self.words[self.index]

    @property
    def before(self) -> str:
        """The word before in lower case, or nothing where punctuation stands between."""
        return self._back(1)

    @property
    def before_that(self) -> str:
        """The word before that one, in the same way."""
        return self._back(2)

    @property
    def inner_stop(self) -> bool:
        """Whether a full stop follows that does not end the sentence: of an abbreviation or an ordinal."""
        return self.word.stopped and self.word.edge not in ("sentence", "paragraph")

    def _back(self, steps: int) -> str:
        """The word `steps` before, where only single spaces lie between."""
        first = self.index - steps
        if first < 0 or not all(word.spaced for word in self.words[first : self.index]):
            return ""
        return self.words[first].text.lower()

    def follower(self, steps: int = 1) -> Written | None:
        """The word `steps` further, where only single spaces lie between."""
        last = self.index + steps
        if last >= len(self.words) or not all(word.spaced for word in self.words[self.index : last]):
            return None
        return self.words[last]

    def one(self, spoken: str, count: int = 1, stop: bool = False) -> Said:
        """`spoken` for this word, and the next ones up to `count`; with the full stop behind if `stop`."""
        last = self.words[self.index + count - 1].core.end
        return Said(((spoken, Span(self.word.core.start, last + stop)),), count, stop)
