"""What happens while something is performed: put in by any thread, told by one."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from scorebreath_cli.printers import Printer

KEPT = 100
"""Messages that a screen can show."""
MOST_WAITING = 10_000
COUNTED = {"late": "late", "unspoken": "unspoken"}
"""What a performance calls its warnings: the events they are told as."""


class Message(NamedTuple):
    """Something that happened."""

    event: str
    text: str
    """for people; empty: nothing for them"""
    row: dict[str, Any]
    """for programs"""


class Teller:
    """Collects messages; `drain` tells them.

    Args:
        printer: Who tells them.
        json_lines: Whether programs listen.
    """

    def __init__(self, printer: Printer, *, json_lines: bool) -> None:
        """Nothing has happened."""
        self._printer, self._json = printer, json_lines
        self._waiting: deque[Message] = deque(maxlen=MOST_WAITING)
        self.shown: deque[Message] = deque(maxlen=KEPT)
        """the latest ones for people, for a screen"""
        self.screen = False
        """whether a screen shows them: then they are not printed"""

    def tell(self, event: str, said: str = "", /, **row: Any) -> None:
        """Something happened; from any thread, returns at once."""
        self._waiting.append(Message(event, said, row))

    def warned(self, text: str) -> None:
        """A performance says something."""
        code, colon, rest = text.partition(": ")
        event = COUNTED.get(code, "") if colon else ""
        self.tell(event or "warning", text, text=rest if event else text)

    def engine(self, text: str) -> None:
        """An engine is in trouble, or out of it."""
        self.tell("trouble", text, source="engine", text=text)

    def stream(self, name: str, text: str) -> None:
        """A stream of curves is in trouble."""
        self.tell("trouble", f"{name}: {text}", source=name, text=text)

    def note(self, text: str) -> None:
        """Worth knowing."""
        self.tell("note", text, text=text)

    def drain(self) -> None:
        """Tell what has come; from one thread."""
        while self._waiting:
            message = self._waiting.popleft()
            if self._json:
                self._printer.item(message.event, message.row, "")
            if not message.text:
                continue
            self.shown.append(message)
            if not self._json and not self.screen:
                self._printer.note(message.text)
