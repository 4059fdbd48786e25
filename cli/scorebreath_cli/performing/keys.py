"""A terminal's keys, one by one, without waiting for the end of a line; its settings come back at the end."""

from __future__ import annotations

import codecs
import os
import re
import sys
import time
from collections.abc import Mapping
from types import MappingProxyType, TracebackType
from typing import Any, Protocol, Self

ALONE = 0.1
"""s after which an escape that nothing follows is the key of that name: keys that send more send it at once"""
CONTROLS: Mapping[str, str] = MappingProxyType(
    {
        "\r": "enter", "\n": "enter", "\t": "tab", "\x7f": "backspace", "\x08": "backspace", "\x18": "panic",
        "\x03": "interrupt", "\x04": "over", "\x01": "home", "\x05": "end", "\x02": "left", "\x06": "right",
        "\x10": "up", "\x0e": "down", "\x0b": "erase-behind", "\x15": "erase-before", "\x17": "erase-word",
        "\x0c": "redraw",
    }
)  # fmt: skip
"""Controls that are keys, as Emacs and shells have them; Ctrl-X is panic."""
SEQUENCES: Mapping[str, str] = MappingProxyType(
    {
        "[A": "up", "[B": "down", "[C": "right", "[D": "left", "OA": "up", "OB": "down", "OC": "right", "OD": "left",
        "[H": "home", "[F": "end", "OH": "home", "OF": "end", "[1~": "home", "[4~": "end", "[7~": "home", "[8~": "end",
        "[3~": "delete",
    }
)  # fmt: skip
"""What follows an escape."""
_SEQUENCE = re.compile(r"\[[0-9;?<>=]*[ -/]*[@-~]|O[@-~]|[^\[O\x1b]", re.DOTALL)
_LONGEST = 32
_WINDOWS: Mapping[str, str] = MappingProxyType(
    {"H": "up", "P": "down", "K": "left", "M": "right", "G": "home", "O": "end", "S": "delete"}
)


class Decoder:
    """Bytes of a terminal made keys: characters, and names of others."""

    def __init__(self) -> None:
        """Nothing was pressed."""
        self._decoder = codecs.getincrementaldecoder("utf-8")("ignore")
        self._left = ""

    @property
    def waiting(self) -> bool:
        """Whether an escape waits for what follows."""
        return bool(self._left)

    def feed(self, data: bytes) -> list[str]:
        """Keys that are complete."""
        self._left += self._decoder.decode(data)
        keys: list[str] = []
        while self._left:
            first = self._left[0]
            if first != "\x1b":
                self._left = self._left[1:]
                if key := CONTROLS.get(first, first if first.isprintable() else ""):
                    keys.append(key)
                continue
            if self._left.startswith("\x1b\x1b"):
                keys.append("escape")
                self._left = self._left[1:]
                continue
            found = _SEQUENCE.match(self._left, 1)
            if found is None:
                if len(self._left) > _LONGEST:
                    self._left = ""
                break
            self._left = self._left[found.end() :]
            if key := SEQUENCES.get(found.group(), ""):
                keys.append(key)
        return keys

    def settle(self) -> list[str]:
        """Nothing followed: an escape alone is a key, too."""
        left, self._left = self._left, ""
        return ["escape"] if left == "\x1b" else []


class Keyboard(Protocol):
    """Keys as they are pressed; a context manager."""

    def read(self, timeout: float) -> list[str]:
        """Keys that were pressed, waiting for the first at most so long, s; `over` where there is nobody any more."""

    def __enter__(self) -> Self:
        """Take the terminal."""

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """Leave the terminal as it was."""


class Terminal:
    """Keys of a terminal.

    Args:
        descriptor: Of the terminal.
        raw: Whether it is to be changed; else it gives whole lines, as it echoes them.
    """

    def __init__(self, descriptor: int, *, raw: bool = True) -> None:
        """Nothing is taken yet."""
        self._descriptor, self._raw = descriptor, raw
        self._decoder = Decoder()
        self._since = 0.0
        self._saved: list[Any] | None = None
        self._gone = False

    def __enter__(self) -> Self:
        """No echo, no lines, and Ctrl-C as a key: the engine is not to be hit by it."""
        import termios

        if not self._raw:
            return self
        self._saved = termios.tcgetattr(self._descriptor)
        mode = termios.tcgetattr(self._descriptor)
        mode[0] &= ~(termios.ICRNL | termios.IXON)
        mode[3] &= ~(termios.ECHO | termios.ICANON | termios.IEXTEN | termios.ISIG)
        termios.tcsetattr(self._descriptor, termios.TCSADRAIN, mode)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """As it was."""
        import termios
        from contextlib import suppress

        if self._saved is not None:
            with suppress(termios.error, OSError):  # it is gone
                termios.tcsetattr(self._descriptor, termios.TCSADRAIN, self._saved)

    def read(self, timeout: float) -> list[str]:
        """Keys that were pressed."""
        import select

        if self._gone:
            time.sleep(timeout)
            return []
        if not select.select([self._descriptor], [], [], timeout)[0]:
            return self._decoder.settle() if self._decoder.waiting and time.monotonic() - self._since > ALONE else []
        try:
            data = os.read(self._descriptor, 4096)
        except OSError:
            data = b""
        if not data:
            self._gone = True
            return ["over"]
        self._since = time.monotonic()
        return self._decoder.feed(data)


class Console:
    """Keys of a console of Windows."""

    def read(self, timeout: float) -> list[str]:
        """Keys that were pressed."""
        import msvcrt

        console: Any = msvcrt
        until = time.monotonic() + timeout
        keys: list[str] = []
        while not keys and time.monotonic() < until:
            while console.kbhit():
                keys += self._key(console)
            if not keys:
                time.sleep(0.01)
        return keys

    def _key(self, console: Any) -> list[str]:
        character = console.getwch()
        if character in "\0\xe0":
            character = _WINDOWS.get(console.getwch(), "")
        elif character == "\x1b":
            character = "escape"
        else:
            character = CONTROLS.get(character, character if character.isprintable() else "")
        return [character] if character else []

    def __enter__(self) -> Self:
        """Nothing to take."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """Nothing to leave."""


def open_keyboard(*, stdin: bool, raw: bool) -> Keyboard | None:
    """The terminal's keys; None: there is no terminal.

    Args:
        stdin: Whether stdin is for keys. Else it is text, and the terminal itself is asked for, as pagers do.
        raw: Whether keys come one by one; else in whole lines.
    """
    if os.name == "nt":
        return Console() if stdin and sys.stdin.isatty() else None
    try:
        if stdin:
            return Terminal(sys.stdin.fileno(), raw=raw) if sys.stdin.isatty() else None
        return Terminal(os.open("/dev/tty", os.O_RDONLY | os.O_NOCTTY | os.O_CLOEXEC), raw=raw)
    except (OSError, ValueError):
        return None
