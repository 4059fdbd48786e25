"""What `doctor` tries: each check does the thing itself and says how it went."""

from __future__ import annotations

import io
import re
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import scorebreath
from scorebreath.errors import EngineError, ScorebreathError, VoiceError

if TYPE_CHECKING:
    from scorebreath.speech.voices import VoiceRow

State = Literal["works", "missing", "broken"]
TEXT = "One."
"""What is spoken and rendered."""
QUIETEST_DB = -60.0
"""A rendering whose peak is below this is silent."""
_NOTHING = re.compile(r"\s*\(Built from\s+''[^)]*\)")
"""What a packaged scsynth says of its source where it knows none."""
LEAST_FREE = 1 << 30
"""Bytes of disk for temporary files."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """How one thing fares."""

    kind: str
    """`system`, `library`, `engine`, `voice`"""
    name: str
    state: State
    what: str
    """version, or what went wrong"""
    remedy: str = ""
    """how to get it, where it does not work"""
    needed: bool = False
    """whether a plain `render` needs it"""


def checks() -> Iterator[Check]:
    """All checks, one after the other."""
    yield _python()
    yield _disk()
    yield from _libraries()
    yield from _engines()
    yield from _voices()


def _python() -> Check:
    version = ".".join(map(str, sys.version_info[:3]))
    return Check(kind="system", name="python", state="works", what=f"{version}, {sys.executable}", needed=True)


def _disk() -> Check:
    folder = tempfile.gettempdir()
    free = shutil.disk_usage(folder).free
    said = f"{folder}: {free / 1e9:.1f} GB free"
    if free >= LEAST_FREE:
        return Check(kind="system", name="temporary files", state="works", what=said)
    return Check(
        kind="system", name="temporary files", state="broken", what=said, remedy="TMPDIR names a folder with more room"
    )


def _libraries() -> Iterator[Check]:
    """What the package itself says it needs, on this platform."""
    try:
        wanted = metadata.requires("scorebreath") or []
    except metadata.PackageNotFoundError:
        folder = Path(scorebreath.__file__).parents[1]
        yield Check(kind="library", name="scorebreath", state="works", what=f"in {folder}, not installed")
        return
    yield Check(kind="library", name="scorebreath", state="works", what=metadata.version("scorebreath"))
    for line in wanted:
        name = re.match(r"[\w.-]+", line)
        if name is None or "extra ==" in line:
            continue
        yield _library(name.group(), needed=";" not in line)


def _library(name: str, *, needed: bool) -> Check:
    try:
        return Check(kind="library", name=name, state="works", what=metadata.version(name), needed=needed)
    except metadata.PackageNotFoundError:
        return Check(
            kind="library", name=name, state="missing", what="not installed", remedy=f"pip install {name}",
            needed=needed,
        )  # fmt: skip


def _engines() -> Iterator[Check]:
    from scorebreath.engine.engines import DEFAULT, ENGINES, engine_named

    for name in ENGINES:
        engine = engine_named(name)

        def render(name: str = name) -> str:
            return _rendered(name)

        yield _tried("engine", name, engine.version, render, engine.remedy, needed=name == DEFAULT)


def _voices() -> Iterator[Check]:
    from scorebreath.speech.voices import DEFAULT, list_voices

    for voice in list_voices():

        def speak(row: VoiceRow = voice) -> str:
            return "files of your own" if row.files else _spoken(row.name)

        def version(row: VoiceRow = voice) -> str:
            if not row.installed:
                raise VoiceError(row.how)
            return f"{row.engine} {row.version}"

        yield _tried("voice", voice.name, version, speak, voice.how, needed=voice.name == DEFAULT)


def _tried(
    kind: str, name: str, version: Callable[[], str], use: Callable[[], str], remedy: str, *, needed: bool
) -> Check:
    try:
        found = _NOTHING.sub("", version())
    except ScorebreathError as error:
        said = str(error).removesuffix(f": {remedy}")
        return Check(kind=kind, name=name, state="missing", what=said, remedy=remedy, needed=needed)
    try:
        return Check(kind=kind, name=name, state="works", what=f"{found}; {use()}", needed=needed)
    except Exception as error:  # whatever it is, the others are still worth trying
        said = f"{found}; {type(error).__name__}: {error}"
        return Check(kind=kind, name=name, state="broken", what=said, remedy=remedy, needed=needed)


def _rendered(engine: str) -> str:
    """Render a word of the test voice."""
    from scorebreath.engine.offline import render
    from scorebreath.media.store import MemoryStore
    from scorebreath.pipeline import compile_text
    from scorebreath.speech.voices import open_voice

    media = MemoryStore()
    voice = open_voice("tone", "en")
    try:
        score = compile_text(TEXT, voice=voice, media=media)
    finally:
        voice.close()
    made = render(score, media, io.BytesIO(), engine=engine)
    if made.peak_db < QUIETEST_DB:
        raise EngineError(f"rendered silence, peak {made.peak_db:.0f} dB")
    return f"rendered {made.frames / made.sample_rate:.1f} s, peak {made.peak_db:.0f} dB"


def _spoken(voice: str) -> str:
    """Have a voice say a word."""
    from scorebreath.media.store import MemoryStore
    from scorebreath.pipeline import compile_text
    from scorebreath.score.events import Utterance
    from scorebreath.speech.voices import open_voice

    opened = open_voice(voice, "en")
    try:
        score = compile_text(TEXT, voice=opened, media=MemoryStore())
    finally:
        opened.close()
    spoken = sum(event.duration for event in score.of(Utterance))
    if spoken <= 0:
        raise VoiceError("said nothing")
    return f"said a word of {spoken:.2f} s"
