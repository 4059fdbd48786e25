"""Instruments as the bytes engines load: `scsyndef/*.scsyndef`, which SuperCollider reads as well.

`python -m scorebreath_synthdefs.compiled` makes the files anew. They carry a digest of what they were made from; where
that has changed since, instruments are built on the spot.
"""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Iterable
from functools import cache
from importlib.resources import files
from pathlib import Path

from scorebreath_synthdefs.catalogue import ALL, synthdef

FOLDER, DIGEST = "scsyndef", "sources.sha256"
SOURCES = (
    "breath.py", "catalogue.py", "envelope.py", "graph.py", "loop.py", "loudness.py", "mixing.py", "moving.py",
    "recording.py", "speech.py", "touch.py", "tracts.py",
)  # fmt: skip
"""What instruments are made from."""
_HEAD = struct.Struct(">4sih")  # SCgf, version, how many
_VERSION = 2


@cache
def digest() -> str:
    """SHA-256 of the sources."""
    package = files(__package__)
    return hashlib.sha256(b"".join((package / name).read_bytes() for name in SOURCES)).hexdigest()


@cache
def compiled(name: str) -> bytes:
    """An instrument of the catalogue as a file of one SynthDef.

    Raises:
        KeyError: The catalogue has no such name.
    """
    ALL[name]
    folder = files(__package__) / FOLDER
    try:
        if (folder / DIGEST).read_text("ascii").strip() == digest():
            return (folder / f"{name}.scsyndef").read_bytes()
    except OSError:
        pass  # as good as outdated
    return bytes(synthdef(name).compile())


def together(names: Iterable[str]) -> bytes:
    """Several instruments as one file of SynthDefs, in the order given."""
    bodies = [compiled(name)[_HEAD.size :] for name in names]
    return _HEAD.pack(b"SCgf", _VERSION, len(bodies)) + b"".join(bodies)


def write(folder: Path) -> None:
    """Build all instruments into a folder, with the digest of their sources."""
    folder.mkdir(exist_ok=True)
    for name in ALL:
        (folder / f"{name}.scsyndef").write_bytes(synthdef(name).compile())
    (folder / DIGEST).write_text(f"{digest()}\n", "ascii")


if __name__ == "__main__":
    write(Path(__file__).parent / FOLDER)
