"""Pictures as lines of JSON, for anything that reads a pipe, a file or a WebSocket.

    {"schema":"scorebreath.picture/1","body":"body","name":"scorebreath","time":1.5,"unix":1795459200.25,"number":90,
     "channels":{"lung_volume":0.38,...}}                        and "rig":{"jawOpen":0.2,...} if one is asked for

Numbers have six decimals, as in curves.csv. A stream that is slow holds nobody up: a thread of its own writes, and what
does not fit into its queue is left out and counted.
"""

from __future__ import annotations

import json
import threading
import time
from collections import deque
from collections.abc import Mapping
from contextlib import suppress
from types import MappingProxyType
from typing import BinaryIO

from scorebreath.curves.rigs.table import rig_named
from scorebreath.live.picture import Picture

SCHEMA = "scorebreath.picture/1"
WAITING = 600
"""Lines that wait for a slow reader: ten seconds of one body at the usual rate."""
PATIENCE = 1.0
"""s that closing waits for a reader to take what is left"""
BREAK = 0.005
"""s before a stream that takes nothing is asked again"""


def line(picture: Picture, rig: str = "", more: Mapping[str, object] = MappingProxyType({})) -> bytes:
    """A picture as one line, with its end.

    Args:
        picture: What is shown.
        rig: Whose columns are added; empty for none.
        more: Further keys, with values that JSON has.

    Raises:
        InputError: There is no such rig.
    """
    told: dict[str, object] = {
        "schema": SCHEMA, "body": picture.body, "name": picture.name, "time": round(picture.time, 6) + 0.0,
        "unix": round(picture.unix, 6), "number": picture.number, "channels": _rounded(picture.channels),
    }  # fmt: skip
    if rig:
        told["rig"] = _rounded(picture.rig(rig))
    told |= more
    return json.dumps(told, separators=(",", ":"), allow_nan=False).encode("ascii") + b"\n"


def _rounded(values: Mapping[str, float]) -> dict[str, float]:
    return {name: round(value, 6) + 0.0 for name, value in values.items()}


class LineTarget:
    """A binary stream that takes lines: stdout, a pipe, a file.

    Args:
        name: What it is, for people.
        stream: Takes bytes; it belongs to the target from now on.
        rig: Whose columns are added; empty for none.
        keep: Whether the stream stays open at the end, as stdout does.
        waiting: Lines that wait at most.

    Raises:
        InputError: There is no such rig.
    """

    def __init__(
        self, name: str, stream: BinaryIO, *, rig: str = "", keep: bool = False, waiting: int = WAITING
    ) -> None:
        """Start the thread that writes."""
        if rig:
            rig_named(rig)
        self._name, self._stream, self._rig, self._keep, self._most = name, stream, rig, keep, waiting
        self._lines: deque[bytes] = deque()
        self._changed = threading.Condition()
        self._over = False
        self._broken: OSError | None = None
        self._lost = 0
        self._writer = threading.Thread(target=self._write, name=f"lines to {name}", daemon=True)
        self._writer.start()

    @property
    def name(self) -> str:
        """What it is, for people."""
        return self._name

    @property
    def lost(self) -> int:
        """Lines left out because the reader was too slow."""
        return self._lost

    def send(self, picture: Picture) -> None:
        """Put one picture into the queue; the oldest goes where there is no place.

        Raises:
            OSError: The stream is broken or its reader gone; it stays so.
        """
        if self._broken is not None:
            raise OSError(str(self._broken))
        made = line(picture, self._rig)
        with self._changed:
            if len(self._lines) >= self._most:
                self._lines.popleft()
                self._lost += 1
            self._lines.append(made)
            self._changed.notify()

    def close(self) -> None:
        """Write what is left, for a second at most, and let go of the stream."""
        with self._changed:
            self._over = True
            self._changed.notify()
        self._writer.join(PATIENCE)

    def _write(self) -> None:
        try:
            while True:
                with self._changed:
                    self._changed.wait_for(lambda: self._lines or self._over)
                    if not self._lines:
                        break
                    waiting = b"".join(self._lines)
                    self._lines.clear()
                self._put(waiting)
        except (OSError, ValueError) as error:  # ValueError: somebody closed it
            self._broken = error if isinstance(error, OSError) else OSError(str(error))
        if not self._keep:
            with suppress(OSError):  # what is left cannot be written: its reader is gone
                self._stream.close()

    def _put(self, data: bytes) -> None:
        """Write all of it: a stream without a buffer may take a part at a time, or nothing for now."""
        left = memoryview(data)
        while left:
            taken: int | None = self._stream.write(left)
            if not taken:
                if self._over:
                    return
                time.sleep(BREAK)
            left = left[taken or 0 :]
        self._stream.flush()
