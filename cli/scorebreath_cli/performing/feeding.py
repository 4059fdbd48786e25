"""Text on its way to a performance: whole files, and stdin piece by piece as it comes."""

from __future__ import annotations

import codecs
import os
import sys
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from scorebreath.errors import InputError
from scorebreath.live.desk import OverError

if TYPE_CHECKING:
    from scorebreath.live.desk import Desk

PIECE = 65536
"""Bytes that are taken at once."""
BURST = 1_000_000
"""Code points that may come at once;"""
STEADY = 1000.0
"""and a second, in the long run: forty times what anybody says. What comes faster waits in its pipe."""
FULL = 0.1
"""s before a desk that takes no more is asked again"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Whole:
    """A text that is there."""

    name: str
    text: str
    """as it was written, markup and all"""


class Feeder:
    """Gives texts to a desk, one behind the other, from a thread of its own.

    Args:
        texts: In order; None: what comes from stdin.
        note: Told what could not be taken.
        descriptor: Of stdin; None: that of the process.
    """

    def __init__(
        self, texts: Sequence[Whole | None], note: Callable[[str], None], *, descriptor: int | None = None
    ) -> None:
        """Nothing is given yet."""
        self._texts, self._note, self._descriptor = tuple(texts), note, descriptor
        self._over = threading.Event()
        self._done = threading.Event()
        self.refused = False
        """whether one of the texts is wrong"""
        self._allowance, self._since = float(BURST), time.monotonic()

    @property
    def done(self) -> bool:
        """Whether all has been given."""
        return self._done.is_set()

    def start(self, desk: Desk) -> None:
        """Begin."""
        threading.Thread(target=self._run, args=(desk,), name="text", daemon=True).start()

    def stop(self) -> None:
        """Give no more."""
        self._over.set()

    def _run(self, desk: Desk) -> None:
        try:
            for text in self._texts:
                if self._over.is_set():
                    return
                try:
                    if text is None:
                        self._stream(desk)
                    else:
                        desk.say(text.text)
                except (InputError, OSError) as error:
                    self.refused = self.refused or not isinstance(error, OverError)
                    self._note(f"{'<stdin>' if text is None else text.name}: {error}")
        finally:
            self._done.set()

    def _stream(self, desk: Desk) -> None:
        decoder = codecs.getincrementaldecoder("utf-8-sig")("replace")
        descriptor = sys.stdin.fileno() if self._descriptor is None else self._descriptor
        said, held = False, ""
        document: bool | None = None  # whether it is SSML or MaryXML, which must be whole; None: not known yet
        while not self._over.is_set():
            data = os.read(descriptor, PIECE)
            piece = decoder.decode(data, final=not data)
            if "\N{REPLACEMENT CHARACTER}" in piece and not said:
                said = True
                self._note("<stdin>: not all of it is UTF-8; what is not is left out")
            piece = piece.replace("\N{REPLACEMENT CHARACTER}", "")
            if document is None and (begun := (held + piece).lstrip()):
                document = begun.startswith("<")
            if document is False:
                self._give(desk, held + piece)
                held = ""
            else:
                held += piece
                if len(held) > BURST:
                    raise InputError(f"a document of more than {BURST} characters")
            if not data:
                break
        if self._over.is_set():
            return
        if document:
            desk.say(held)
        else:
            desk.end_stream()

    def _give(self, desk: Desk, piece: str) -> None:
        """One piece, as soon as there is room for it."""
        now = time.monotonic()
        self._allowance = min(float(BURST), self._allowance + STEADY * (now - self._since)) - len(piece)
        self._since = now
        if self._allowance < 0:
            self._over.wait(-self._allowance / STEADY)
        while piece and not self._over.is_set():
            try:
                desk.stream(piece)
                return
            except OverError:
                raise
            except InputError:  # too many orders wait
                self._over.wait(FULL)
