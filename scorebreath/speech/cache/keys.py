"""By what an utterance is kept: everything that its bytes depend on, and nothing else."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import fields
from functools import cache
from importlib import metadata
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any

from scorebreath.spans import SpokenText
from scorebreath.speech.model import SpeechRequest, VoiceDetails

SCHEMA = "scorebreath.utterance/1"
LIBRARIES = ("numpy", "praat-parselmouth", "soxr")
"""What samples, pitch and level are computed with."""
ROOMS = ("signal", "speech")
"""Parts of this program whose code the bytes depend on: a changed program speaks anew."""
SOURCES = (".py", ".toml")
CONTEXT = ("before", "after")
"""Fields of a request that only some voices heed."""


def voice_key(details: VoiceDetails) -> str:
    """SHA-256, in hexadecimal, of what a voice is and of the code that makes its utterances."""
    about = {
        "schema": SCHEMA,
        "engine": details.engine,
        "voice": details.voice,
        "version": details.version,
        "fingerprint": details.fingerprint,
        "code": code_digest(),
        "libraries": _versions(),
    }
    return _digest(about)


def request_key(voice: str, request: SpeechRequest, *, context: bool) -> str:
    """SHA-256, in hexadecimal, of a request to a voice.

    Places in the source are counted from the first one, so that text inserted before it changes nothing.

    Args:
        voice: The voice's key.
        request: What is asked for.
        context: Whether the voice heeds what is said before and after.
    """
    asked: dict[str, Any] = {"voice": voice}
    for field in fields(request):
        value = getattr(request, field.name)
        if field.name in CONTEXT and not context:
            continue
        asked[field.name] = _plain(value, first_place(request))
    return _digest(asked)


def first_place(request: SpeechRequest) -> int:
    """Where a request's source begins."""
    runs = request.text.runs
    return runs[0].source.start if runs else 0


def _plain(value: object, base: int) -> object:
    if isinstance(value, SpokenText):
        runs = [(run.start, run.end, run.source.start - base, run.source.end - base) for run in value.runs]
        return [value.text, runs]
    if value is None or isinstance(value, str | int | float | bool):
        return value
    raise TypeError(f"a request's {type(value).__name__} has no place in a key yet")


def _digest(about: Mapping[str, Any]) -> str:
    text = json.dumps(about, sort_keys=True, ensure_ascii=True, separators=(",", ":"))
    return hashlib.sha256(text.encode("ascii")).hexdigest()


@cache
def code_digest() -> str:
    """SHA-256 of the program's own code that speaks and measures."""
    found = hashlib.sha256()
    for room in ROOMS:
        for name, data in sorted(_sources(files("scorebreath") / room, room)):
            found.update(f"{name}\0{len(data)}\0".encode())
            found.update(data)
    return found.hexdigest()


def _sources(folder: Traversable, name: str) -> list[tuple[str, bytes]]:
    out: list[tuple[str, bytes]] = []
    for entry in folder.iterdir():
        if entry.is_dir():
            out += _sources(entry, f"{name}/{entry.name}") if entry.name != "__pycache__" else []
        elif entry.name.endswith(SOURCES):
            out.append((f"{name}/{entry.name}", entry.read_bytes()))
    return out


@cache
def _versions() -> tuple[str, ...]:
    found = []
    for library in LIBRARIES:
        version = ""
        with suppress(metadata.PackageNotFoundError):
            version = metadata.version(library)
        found.append(version)
    return tuple(found)
