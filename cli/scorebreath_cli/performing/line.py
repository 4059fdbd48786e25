"""A line that is typed: cursor, history, completion. It knows names of keys and no terminal."""

from __future__ import annotations

from collections.abc import Callable

LONGEST = 10_000
"""Characters of a line."""
REMEMBERED = 500
"""Lines."""


class Line:
    """Press keys; `press` gives the line when it is complete.

    Args:
        completions: Lines that a line may become.
    """

    def __init__(self, completions: Callable[[str], list[str]] = lambda _: []) -> None:
        """Nothing is typed."""
        self._completions = completions
        self._history: list[str] = []
        self._place = 0
        self._draft = ""
        self.text = ""
        self.cursor = 0

    def press(self, key: str) -> str | None:
        """A key: a character, or a name as `keys` has them; the line, if that was its end."""
        if key == "enter":
            return self._entered()
        if len(key) == 1:
            self._insert(key)
        elif key in MOVES:
            MOVES[key](self)
        return None

    def hints(self) -> list[str]:
        """What the line may become."""
        return [] if not self.text else [line for line in self._completions(self.text) if line != self.text]

    def _entered(self) -> str:
        line, self.text, self.cursor = self.text, "", 0
        if line.strip() and (not self._history or self._history[-1] != line):
            self._history = [*self._history[1 - REMEMBERED :], line]
        self._place, self._draft = len(self._history), ""
        return line

    def _insert(self, character: str) -> None:
        if len(self.text) < LONGEST:
            self.text = self.text[: self.cursor] + character + self.text[self.cursor :]
            self.cursor += 1

    def _take(self, start: int, end: int) -> None:
        self.text = self.text[:start] + self.text[end:]
        self.cursor = start

    def _word(self) -> int:
        """Where the word before the cursor begins."""
        return self.text[: self.cursor].rstrip().rfind(" ") + 1

    def _recall(self, by: int) -> None:
        place = self._place + by
        if not 0 <= place <= len(self._history):
            return
        if self._place == len(self._history):
            self._draft = self.text
        self._place = place
        self.text = self._draft if place == len(self._history) else self._history[place]
        self.cursor = len(self.text)

    def _complete(self) -> None:
        found = self._completions(self.text)
        if self.cursor == len(self.text) and found:
            ending = " " if len(found) == 1 and not found[0].endswith("=") else ""
            self.text = _shared(found) + ending
            self.cursor = len(self.text)

    def _move(self, to: int) -> None:
        self.cursor = min(max(to, 0), len(self.text))


def _shared(lines: list[str]) -> str:
    """What all begin with."""
    first, last = min(lines), max(lines)
    same = next((n for n, (a, b) in enumerate(zip(first, last, strict=False)) if a != b), min(len(first), len(last)))
    return first[:same]


MOVES: dict[str, Callable[[Line], None]] = {
    "left": lambda line: line._move(line.cursor - 1),
    "right": lambda line: line._move(line.cursor + 1),
    "home": lambda line: line._move(0),
    "end": lambda line: line._move(len(line.text)),
    "up": lambda line: line._recall(-1),
    "down": lambda line: line._recall(1),
    "backspace": lambda line: line._take(max(0, line.cursor - 1), line.cursor),
    "delete": lambda line: line._take(line.cursor, line.cursor + 1),
    "erase-word": lambda line: line._take(line._word(), line.cursor),
    "erase-before": lambda line: line._take(0, line.cursor),
    "erase-behind": lambda line: line._take(line.cursor, len(line.text)),
    "tab": lambda line: line._complete(),
}
"""What keys do that are no characters."""
