"""Where the samples of a performance lie while it goes on."""

from __future__ import annotations

import threading
from collections import OrderedDict

import numpy as np
from numpy.typing import NDArray

from scorebreath.media.store import Kind, Media, MediaStore, MemoryStore

MOST = 64 * 1024 * 1024
"""Bytes of speech that stay in memory: some ten minutes."""


class RecentStore:
    """Samples in memory, the oldest speech let go; all of them in another store, if there is one.

    Safe to use from several threads.

    Args:
        kept: Where everything goes as well; None: nowhere.
        most: Bytes of speech in memory.
    """

    def __init__(self, kept: MediaStore | None = None, most: int = MOST) -> None:
        """Nothing is here."""
        self._kept, self._most = kept, most
        self._breaths = MemoryStore()
        self._speech: OrderedDict[str, Media] = OrderedDict()
        self._size = 0
        self._lock = threading.Lock()

    def put(self, samples: NDArray[np.float32], sample_rate: int, kind: Kind) -> str:
        """Keep a sound."""
        if self._kept is not None:
            self._kept.put(samples, sample_rate, kind)
        if kind == "breath":
            with self._lock:
                return self._breaths.put(samples, sample_rate, kind)
        one = MemoryStore()
        name = one.put(samples, sample_rate, kind)
        with self._lock:
            if name not in self._speech:
                self._size += samples.nbytes
            self._speech[name] = one.get(name)
            self._speech.move_to_end(name)
            while self._size > self._most and len(self._speech) > 1:
                _, oldest = self._speech.popitem(last=False)
                self._size -= oldest.samples.nbytes
        return name

    def get(self, name: str) -> Media:
        """The sound of that name."""
        with self._lock:
            if name in self._speech:
                return self._speech[name]
        return self._kept.get(name) if self._kept is not None and name not in self._breaths else self._breaths.get(name)

    def frames(self, name: str) -> int:
        """Its length in frames."""
        return len(self.get(name).samples)

    def __contains__(self, name: str) -> bool:
        """Whether it is here."""
        with self._lock:
            here = name in self._speech or name in self._breaths
        return here or (self._kept is not None and name in self._kept)
