"""The cache on disk: a folder of utterances and their samples, whole or not there, never larger than told.

    FOLDER/utterances/ab/abcd....json    words, phones, pitch, level, and the name of the samples
    FOLDER/speech/SHA256.wav             samples, as every Score has them (`media.FolderStore`)
    FOLDER/voices/KEY.json               what is known of a voice: its reference level, syllables of words

A file is written beside its place and renamed, the samples first; whoever reads what is torn, foreign or gone takes it
for nothing. So any number of processes can share a folder. What was used last is kept longest.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any

from scorebreath.errors import InputError, ScorebreathError, ScoreError
from scorebreath.media.store import FolderStore
from scorebreath.score.events import Level, Phone, Pitch, Word
from scorebreath.speech.cache.keys import SCHEMA
from scorebreath.speech.model import Speech

FOLDER, LIMIT, OFF = "SCOREBREATH_CACHE", "SCOREBREATH_CACHE_LIMIT", "off"
"""Environment variables; and what the first one may say instead of a folder."""
DEFAULT_LIMIT = 2 * 10**9
"""bytes: six hours of speech at 22050 Hz"""
ROOM = 0.9
"""Share of the limit that is left after files had to go, so that they need not go one by one."""
LARGEST = 64 << 20
"""bytes of a JSON file; more is not read"""
KINDS = ("utterances", "speech", "voices")
_KEY = re.compile(r"[0-9a-f]{64}\Z")
_SIZE = re.compile(r"(\d+(?:\.\d+)?)\s*([kmgt]?)i?b?\Z", re.IGNORECASE)
_POWERS = {"": 0, "k": 1, "m": 2, "g": 3, "t": 4}


@dataclass(frozen=True, slots=True, kw_only=True)
class Holding:
    """A file of the cache."""

    path: Path
    size: int
    """bytes"""
    used: float
    """Unix time, s"""


def default_folder() -> Path | None:
    """Where the cache is; None: there shall be none."""
    told = os.environ.get(FOLDER, "")
    if told:
        return None if told.lower() == OFF else Path(told).expanduser()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local") / "scorebreath" / "cache"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "scorebreath"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "scorebreath"


def size_of(text: str, name: str) -> int:
    """Bytes from a size such as `500MB`.

    Args:
        text: A number, perhaps with k, M, G or T (powers of 1000), perhaps with B.
        name: Where it stands, for the message.

    Raises:
        InputError: It is none.

    >>> size_of("2 GB", ""), size_of("1.5k", "")
    (2000000000, 1500)
    """
    found = _SIZE.match(text.strip())
    if found is None:
        raise InputError(f"{name}={text!r}: expected a size such as 500MB or 2GB")
    return int(float(found[1]) * 1000 ** _POWERS[found[2].lower()])


class Shelf:
    """A cache in a folder."""

    def __init__(self, folder: Path, limit: int | None = None) -> None:
        """Nothing is made before something is kept.

        Args:
            folder: Where.
            limit: Bytes; None: as the environment says, or `DEFAULT_LIMIT`.

        Raises:
            InputError: The environment's limit is no size.
        """
        told = os.environ.get(LIMIT, "")
        self.folder = folder
        self.limit = limit if limit is not None else size_of(told, LIMIT) if told else DEFAULT_LIMIT
        self.problem = ""
        """why nothing more is kept; empty as long as all is well"""
        self._media = FolderStore(folder)
        self._written = 0

    def has(self, key: str) -> bool:
        """Whether an utterance seems to be here."""
        return self._utterance(key).is_file()

    def get(self, key: str) -> Speech | None:
        """An utterance, its sources counted from the first place; None where it is not here, or not whole."""
        path = self._utterance(key)
        samples: Path | None = None
        try:
            told = _read(path)
            if told is None:
                return None
            samples = self.folder / FolderStore.path(_sha(told["media"]), "speech")
            speech = _speech(told, key, self._media)
        except (ScorebreathError, OSError, ValueError, TypeError, KeyError):
            for broken in (path, samples):  # samples of a name that is there would not be written again
                if broken is not None:
                    _remove(broken)
            return None
        for used in (samples, path):
            _use(used)
        return speech

    def put(self, key: str, speech: Speech, voice: str) -> None:
        """Keep an utterance. What the disk refuses is not kept, and `problem` says why.

        Args:
            key: Its own.
            speech: Sources counted from the first place.
            voice: Name of the voice, for whoever looks into the cache.
        """
        if self.problem or 4 * len(speech.samples) > self.limit:
            return
        about = {
            "schema": SCHEMA, "key": key, "voice": voice, "sample_rate": speech.sample_rate,
            "words": [asdict(word) for word in speech.words], "phones": [asdict(phone) for phone in speech.phones],
            "pitch": asdict(speech.pitch), "level": asdict(speech.level),
        }  # fmt: skip
        try:
            about["media"] = self._media.put(speech.samples, speech.sample_rate, "speech")
            self._written += 4 * len(speech.samples) + _write(self._utterance(key), about)
        except OSError as error:
            self.problem = f"{self.folder}: {error.strerror or error}: nothing more is kept there"
        if self._written > self.limit * (1 - ROOM):
            self.prune()

    def known(self, voice: str) -> dict[str, Any]:
        """What is kept about a voice, by its key."""
        try:
            told = _read(self.folder / "voices" / f"{voice}.json")
        except (OSError, ValueError):
            return {}
        return told if told is not None and told.get("schema") == SCHEMA else {}

    def tell(self, voice: str, about: Mapping[str, Any]) -> None:
        """Keep what is known about a voice."""
        if self.problem:
            return
        with suppress(OSError):
            _write(self.folder / "voices" / f"{voice}.json", {"schema": SCHEMA, **about})

    def holdings(self) -> Iterator[Holding]:
        """Every file of the cache, as it is found."""
        for kind in KINDS:
            for path in (self.folder / kind).rglob("*"):
                with suppress(OSError):
                    found = path.stat()
                    if path.is_file():
                        yield Holding(path=path, size=found.st_size, used=found.st_mtime)

    def prune(self, limit: int | None = None) -> int:
        """Remove what was not used for longest until the rest is well below the limit.

        Args:
            limit: Bytes; None: its own.

        Returns:
            Bytes that went.
        """
        most = self.limit if limit is None else limit
        self._written = 0
        held = sorted(self.holdings(), key=lambda holding: holding.used)
        total = sum(holding.size for holding in held)
        if total <= most:
            return 0
        gone = 0
        for holding in held:
            if total - gone <= ROOM * most:
                break
            _remove(holding.path)
            gone += holding.size
        return gone

    def clear(self, voice: str = "") -> int:
        """Remove everything, or what one voice said; how many utterances went.

        Args:
            voice: Its name; empty: of all.
        """
        count = 0
        for path in list((self.folder / "utterances").glob("*/*.json")):
            if not voice or self.voice_of(path) == voice:
                _remove(path)
                count += 1
        if voice:
            self._sweep()
        else:
            for holding in list(self.holdings()):
                _remove(holding.path)
        return count

    def check(self) -> tuple[int, int]:
        """Read everything, remove what is broken or used by nothing; how many utterances are whole, and files gone."""
        whole, gone = 0, 0
        for path in list((self.folder / "utterances").glob("*/*.json")):
            if self.get(path.stem) is None:
                _remove(path)
                gone += 1
            else:
                whole += 1
        return whole, gone + self._sweep()

    def voice_of(self, path: Path) -> str:
        """Name of the voice whose utterance a file holds; empty where it is none."""
        with suppress(OSError, ValueError):
            told = _read(path)
            if told is not None and isinstance(told.get("voice"), str):
                return str(told["voice"])
        return ""

    def _sweep(self) -> int:
        """Remove samples that no utterance names."""
        named = set()
        for path in (self.folder / "utterances").glob("*/*.json"):
            with suppress(OSError, ValueError):
                named.add((_read(path) or {}).get("media"))
        lone = [path for path in (self.folder / "speech").glob("*") if path.stem not in named]
        for path in lone:
            _remove(path)
        return len(lone)

    def _utterance(self, key: str) -> Path:
        if not _KEY.match(key):
            raise ScoreError(f"cache key {key[:80]!r} is not a SHA-256")
        return self.folder / "utterances" / key[:2] / f"{key}.json"


def moved(speech: Speech, by: int) -> Speech:
    """The same speech, its words' sources so many code points later."""
    if not by:
        return speech
    words = (
        word if word.source is None else replace(word, source=(word.source[0] + by, word.source[1] + by))
        for word in speech.words
    )
    return replace(speech, words=tuple(words))


def _sha(name: object) -> str:
    if not isinstance(name, str) or not _KEY.match(name):
        raise ValueError("samples without a name")
    return name


def _speech(told: Mapping[str, Any], key: str, media: FolderStore) -> Speech:
    """The utterance in a file.

    Raises:
        ScoreError, OSError, ValueError, TypeError, KeyError: It is not whole.
    """
    if told["schema"] != SCHEMA or told["key"] != key:
        raise ValueError("another file")
    sound = media.get(told["media"])
    if sound.sample_rate != told["sample_rate"]:
        raise ValueError("another rate")
    return Speech(
        samples=sound.samples,
        sample_rate=sound.sample_rate,
        words=tuple(_part(Word, each) for each in told["words"]),
        phones=tuple(_part(Phone, each) for each in told["phones"]),
        pitch=Pitch(step=told["pitch"]["step"], hertz=tuple(told["pitch"]["hertz"])),
        level=Level(step=told["level"]["step"], db=tuple(told["level"]["db"])),
    )


def _part(kind: type[Any], told: Mapping[str, Any]) -> Any:
    """A word or a phone."""
    known = {field.name for field in fields(kind)}
    values = {name: tuple(value) if isinstance(value, list) else value for name, value in told.items() if name in known}
    return kind(**values)


def _read(path: Path) -> dict[str, Any] | None:
    """A JSON object; None where there is no file.

    Raises:
        OSError, ValueError: It cannot be read, or is none.
    """
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST + 1)
    except FileNotFoundError:
        return None
    try:
        told = json.loads(data)
    except RecursionError:
        raise ValueError("nested too deeply") from None
    if not isinstance(told, dict):
        raise ValueError("no object")
    return told


def _write(path: Path, about: Mapping[str, Any]) -> int:
    """Write a JSON file whole; its bytes."""
    data = json.dumps(about, separators=(",", ":")).encode("ascii")
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        part.write_bytes(data)
        part.replace(path)
    except BaseException:
        _remove(part)
        raise
    return len(data)


def _use(path: Path) -> None:
    with suppress(OSError):
        os.utime(path)


def _remove(path: Path) -> None:
    with suppress(OSError):
        path.unlink()
