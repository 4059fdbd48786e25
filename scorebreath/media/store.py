"""Samples by content: put a sound in, get the name that is its SHA-256, get the sound back by it."""

from __future__ import annotations

import hashlib
import os
import re
import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import ScoreError, shortened

Kind = Literal["speech", "breath"]
_NAME = re.compile(r"[0-9a-f]{64}\Z")
_FLOAT_FORMAT = 3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Media:
    """A mono sound."""

    samples: NDArray[np.float32]
    """(n,), within -1..1"""
    sample_rate: int
    """Hz"""
    kind: Kind


class MediaStore(Protocol):
    """Where samples lie. Names are the SHA-256 of their little-endian float32 values."""

    def put(self, samples: NDArray[np.float32], sample_rate: int, kind: Kind) -> str:
        """Keep a sound; returns its name. Putting the same sound twice keeps it once."""

    def get(self, name: str) -> Media:
        """The sound of that name.

        Raises:
            ScoreError: It is not here, cannot be read, or is not what its name says.
        """

    def frames(self, name: str) -> int:
        """Its length in frames, without reading it whole where that can be avoided."""

    def __contains__(self, name: str) -> bool:
        """Whether it is here."""


def name_of(samples: NDArray[np.float32]) -> str:
    """SHA-256 of the samples as little-endian float32, in hexadecimal.

    >>> name_of(np.zeros(2, np.float32))[:8]
    'af5570f5'
    """
    return hashlib.sha256(np.ascontiguousarray(samples, dtype="<f4").tobytes()).hexdigest()


class MemoryStore:
    """Samples in memory."""

    def __init__(self) -> None:
        """Empty."""
        self._media: dict[str, Media] = {}

    def put(self, samples: NDArray[np.float32], sample_rate: int, kind: Kind) -> str:
        """Keep a copy nobody can change."""
        name = name_of(samples)
        if name not in self._media:
            kept = np.array(samples, dtype=np.float32)
            kept.flags.writeable = False
            self._media[name] = Media(samples=kept, sample_rate=sample_rate, kind=kind)
        return name

    def get(self, name: str) -> Media:
        """The sound of that name."""
        try:
            return self._media[name]
        except KeyError:
            raise ScoreError(f"media {shortened(name)!r} are not in the store") from None

    def frames(self, name: str) -> int:
        """Its length in frames."""
        return len(self.get(name).samples)

    def __contains__(self, name: str) -> bool:
        """Whether it is here."""
        return name in self._media


class FolderStore:
    """Samples as float WAV files `FOLDER/KIND/NAME.wav`, written once and whole.

    Args:
        folder: Where the `speech` and `breath` folders are, or will be.
    """

    def __init__(self, folder: Path) -> None:
        """Nothing is made before the first put."""
        self.folder = folder

    @staticmethod
    def path(name: str, kind: Kind) -> str:
        """Path inside the folder, with forward slashes."""
        return f"{kind}/{name}.wav"

    def put(self, samples: NDArray[np.float32], sample_rate: int, kind: Kind) -> str:
        """Write the sound unless it is here already."""
        name = name_of(samples)
        target = self.folder / self.path(name, kind)
        if not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            part = target.with_name(f".{name}.{os.getpid()}.part")
            part.write_bytes(float_wave(samples, sample_rate))
            part.replace(target)
        return name

    def get(self, name: str) -> Media:
        """Read the sound and check it against its name."""
        path, kind = self._find(name)
        samples, rate = _read_wave(path)
        if name_of(samples) != name:
            raise ScoreError(f"{path}: the samples are not those the score names ({shortened(name)})")
        return Media(samples=samples, sample_rate=rate, kind=kind)

    def frames(self, name: str) -> int:
        """Its length in frames, from the file's header."""
        return _wave_layout(self._find(name)[0])[1] // 4

    def __contains__(self, name: str) -> bool:
        """Whether its file is here."""
        return bool(_NAME.match(name)) and any((self.folder / self.path(name, kind)).is_file() for kind in _KINDS)

    def _find(self, name: str) -> tuple[Path, Kind]:
        if not _NAME.match(name):  # names come from files of others: never a path
            raise ScoreError(f"media name {shortened(name, 80)!r} is not a SHA-256")
        for kind in _KINDS:
            path = self.folder / self.path(name, kind)
            if path.is_file():
                return path, kind
        raise ScoreError(f"{self.folder / self.path(name, 'speech')}: media of the score are missing")


class LayeredStore:
    """Several stores as one: reads from the first that has it, writes to the first."""

    def __init__(self, *stores: MediaStore) -> None:
        """In order of preference."""
        self._stores = stores

    def put(self, samples: NDArray[np.float32], sample_rate: int, kind: Kind) -> str:
        """Into the first."""
        return self._stores[0].put(samples, sample_rate, kind)

    def get(self, name: str) -> Media:
        """From the first that has it."""
        return self._holder(name).get(name)

    def frames(self, name: str) -> int:
        """Its length in frames."""
        return self._holder(name).frames(name)

    def __contains__(self, name: str) -> bool:
        """Whether one has it."""
        return any(name in store for store in self._stores)

    def _holder(self, name: str) -> MediaStore:
        return next((store for store in self._stores if name in store), self._stores[0])


_KINDS: tuple[Kind, ...] = ("speech", "breath")


def float_wave(samples: NDArray[np.float32], sample_rate: int) -> bytes:
    """A mono float32 WAV file; its bytes depend on nothing but the samples and the rate."""
    data = np.ascontiguousarray(samples, dtype="<f4").tobytes()
    form = struct.pack("<HHIIHHH", _FLOAT_FORMAT, 1, sample_rate, sample_rate * 4, 4, 32, 0)
    chunks = _chunk(b"fmt ", form) + _chunk(b"fact", struct.pack("<I", len(samples))) + _chunk(b"data", data)
    return b"RIFF" + struct.pack("<I", 4 + len(chunks)) + b"WAVE" + chunks


def _chunk(tag: bytes, body: bytes) -> bytes:
    return tag + struct.pack("<I", len(body)) + body


def _read_wave(path: Path) -> tuple[NDArray[np.float32], int]:
    offset, size, rate = _wave_layout(path)
    samples = np.fromfile(path, dtype="<f4", count=size // 4, offset=offset).astype(np.float32, copy=False)
    if not np.all(np.isfinite(samples)):
        raise ScoreError(f"{path}: holds samples that are not finite")
    return samples, rate


def _wave_layout(path: Path) -> tuple[int, int, int]:
    """Offset and bytes of the data, and the rate, of a mono float32 WAV."""
    with path.open("rb") as stream:
        length = path.stat().st_size
        if stream.read(4) != b"RIFF" or stream.read(8)[4:] != b"WAVE":
            raise ScoreError(f"{path}: is not a WAV file")
        rate = 0
        for tag, size in _chunks(stream.read):
            if tag == b"fmt ":
                form = stream.read(min(size, 16))
                if len(form) < 16 or struct.unpack("<HH", form[:4]) != (_FLOAT_FORMAT, 1) or form[14:16] != b"\x20\0":
                    raise ScoreError(f"{path}: expected mono 32-bit float samples")
                rate = struct.unpack("<I", form[4:8])[0]
                stream.seek(size - 16 + size % 2, 1)
            elif tag == b"data":
                if not rate or size % 4 or stream.tell() + size > length:
                    break
                return stream.tell(), size, rate
            else:
                stream.seek(size + size % 2, 1)
        raise ScoreError(f"{path}: the WAV file is cut short")


def _chunks(read: Callable[[int], bytes]) -> Iterator[tuple[bytes, int]]:
    """Headers of the chunks; whoever iterates moves past each body."""
    while len(head := read(8)) == 8:
        yield head[:4], struct.unpack("<I", head[4:])[0]
