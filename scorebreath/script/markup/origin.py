"""The text as somebody wrote it, markup and all: where errors point."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.errors import ScriptError


@dataclass(frozen=True, slots=True, kw_only=True)
class Origin:
    """A text with its name."""

    text: str
    file: str = ""
    """for messages"""

    def error(self, at: int, problem: str, expected: str) -> ScriptError:
        """The error for a place, with its line, column, and a caret under it.

        Args:
            at: Code points before it.
            problem: What was found.
            expected: What should stand there instead.
        """
        start = self.text.rfind("\n", 0, at) + 1
        end = self.text.find("\n", at)
        line = self.text[start:] if end < 0 else self.text[start:end]
        number, column = self.text.count("\n", 0, at) + 1, at - start + 1
        return ScriptError(problem, expected=expected, file=self.file, line=number, column=column, text=line or " ")

    def line(self, at: int) -> int:
        """Line of a place, from 1."""
        return self.text.count("\n", 0, at) + 1
