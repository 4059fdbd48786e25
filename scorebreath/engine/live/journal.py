"""What an engine was told and when: a line of JSON for each bundle."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from scorebreath.errors import EnvironmentFailure

What = Literal["sound", "cut", "move", "free"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """A bundle that was sent."""

    kind: What
    """`free`: a sound that had been announced and is taken back before it begins"""
    event: str
    """id of the event it belongs to; of a move the body's"""
    instrument: str
    """what sounds; empty where nothing begins"""
    time: float
    """s of the performance at which it happens"""
    frame: int
    """that time on the engine's frames, from the performance's beginning"""
    tag: int
    """NTP time tag"""
    lead: float
    """s before its time that it was sent"""
    late: float = 0.0
    """s that it happens later than it should"""

    def line(self) -> str:
        """As JSON."""
        return json.dumps(
            {
                "kind": self.kind, "event": self.event, "instrument": self.instrument, "time": round(self.time, 6),
                "frame": self.frame, "tag": f"{self.tag:016x}", "lead": round(self.lead, 6),
                "late": round(self.late, 6),
            }
        )  # fmt: skip


Journal = Callable[[Entry], None]
"""Told of every bundle; must return at once."""


class JournalFile:
    """A journal that is a file, a line each; use it as a journal and close it.

    Raises:
        EnvironmentFailure: The file cannot be written.
    """

    def __init__(self, path: Path) -> None:
        """Begin the file anew."""
        try:
            self._stream = path.open("w", encoding="utf-8", buffering=1)  # a line at a time: kill -9 loses none
        except OSError as error:
            raise EnvironmentFailure(f"{path}: cannot be written: {error.strerror}") from None

    def __call__(self, entry: Entry) -> None:
        """Write an entry."""
        if not self._stream.closed:
            self._stream.write(entry.line() + "\n")

    def close(self) -> None:
        """Close the file."""
        self._stream.close()
