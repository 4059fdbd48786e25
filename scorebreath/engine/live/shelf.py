"""Media made ready for a live engine: files under plain names, and the numbers of its buffers. Safe between threads."""

from __future__ import annotations

import threading
from collections import Counter, deque
from pathlib import Path

from scorebreath.engine.live.conductor import Played
from scorebreath.engine.live.layout import Layout
from scorebreath.engine.staging import stage_one
from scorebreath.errors import EngineError
from scorebreath.media.store import MediaStore


class Shelf:
    """Files and buffers that are in use, and those that are free.

    Args:
        folder: Where files go.
        layout: Which buffers are ours.
        sample_rate: The engine's, Hz.
    """

    def __init__(self, folder: Path, layout: Layout, sample_rate: int) -> None:
        """Begin with nothing."""
        self._folder, self._rate = folder, sample_rate
        self._free = deque(range(layout.first_buffer, layout.first_buffer + layout.buffers))
        self._users: Counter[str] = Counter()
        self._files: dict[str, str] = {}
        self._made = 0
        self._lock = threading.Lock()

    def file(self, name: str, length: float, media: MediaStore) -> str:
        """The file of some media, made now or still there; to be released.

        Raises:
            ScoreError: Media are missing, of another length, or broken.
            EnvironmentFailure: The disk refuses.
        """
        with self._lock:
            if name not in self._files:
                self._files[name] = f"s{self._made:06d}.wav"
                self._made += 1
                try:
                    stage_one(name, length, media, self._folder / self._files[name], sample_rate=self._rate)
                except BaseException:
                    del self._files[name]
                    raise
            file = self._files[name]
            self._users[file] += 1
            return file

    def buffer(self) -> int:
        """A free buffer; the one that was freed longest ago.

        Raises:
            EngineError: There is none.
        """
        with self._lock:
            if not self._free:
                raise EngineError("too many sounds are waiting: the engine has no buffer left")
            return self._free.popleft()

    def release(self, played: Played) -> None:
        """A sound needs its file and its buffer no more."""
        with self._lock:
            if played.buffer is None:
                return
            self._free.append(played.buffer)
            played.buffer = None
            self._users[played.file] -= 1
            if self._users[played.file] <= 0:
                del self._users[played.file]
                self._files = {name: file for name, file in self._files.items() if file != played.file}
                (self._folder / played.file).unlink(missing_ok=True)
