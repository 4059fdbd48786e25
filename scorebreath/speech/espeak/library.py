"""The eSpeak NG library by ctypes: loaded, used once and unloaded, because it remembers.

What was measured with eSpeak NG 1.52.0:

- A second synthesis in the same process gives other lengths (by 10 to 200 samples). Loaded anew it gives the same
  bytes, for 1 ms more.
- Its noise (breathy variants such as `f3`) is seeded from the clock, and the `klatt 6` variants draw from libc's
  `rand`, which survives unloading. Both are seeded here.
- The bytes depend on the buffer's length, so it stays at the library's own.
- Selecting a voice by name searches the whole data folder (4 ms); by file it takes 0.1 ms.
- The path of its data must be shorter than 160 bytes, and a "+" in the path of a voice file starts a variant's name.

Not thread-safe, and only one handle to the library may be open in a process. The working directory must be one that
can be written to: voice files are put there for a moment.
"""

from __future__ import annotations

import _ctypes
import ctypes
import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

SAMPLE_RATE = 22050
"""Hz; of all voices without mbrola"""
WORD, PHONEME = 1, 7
"""event types"""

_SYNCHRONOUS = 2
_PHONEME_EVENTS, _PHONEME_IPA, _DONT_EXIT = 1, 2, 0x8000
_UTF8 = 1
_RATE, _PITCH, _RANGE = 1, 3, 4
_SEED = 1
_IPA, _SEPARATE = 2, ord("_") << 8
_LONGEST_PATH = 120
"""bytes; the rest of the 160 is for file names"""


class Event(NamedTuple):
    """A word or phoneme begins."""

    type: int
    """`WORD` or `PHONEME`"""
    position: int
    """of the word, in characters from 1"""
    length: int
    """of the word, in characters"""
    sample: int
    """from the start of the sound"""
    ipa: str
    """of the phoneme, with stress marks; empty for a pause, or for nothing at all"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """What one synthesis is done with."""

    definition: str
    """a voice file's lines"""
    rate: int = 175
    """words a minute, 80..450"""
    pitch: int = 50
    """0..99"""
    range: int = 50
    """of the pitch; 50 is the voice's own"""


class _Id(ctypes.Union):
    _fields_ = (("number", ctypes.c_int), ("name", ctypes.c_char_p), ("string", ctypes.c_char * 8))


class _Event(ctypes.Structure):
    _fields_ = (
        ("type", ctypes.c_int),
        ("unique_identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", _Id),
    )


_Callback = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(_Event))


@dataclass(frozen=True, slots=True, kw_only=True)
class Library:
    """Where the library and its data are."""

    path: str
    data: str

    def version(self) -> str:
        """Of the library, e.g. `1.52.0`.

        Raises:
            OSError: It cannot be loaded.
        """
        handle = ctypes.CDLL(self.path)
        try:
            handle.espeak_Info.restype = ctypes.c_char_p
            said = handle.espeak_Info(None)
        finally:
            _unload(handle)
        return str(said.decode("ascii", "replace")).split()[0]

    def synthesise(self, text: str, settings: Settings) -> tuple[bytes, list[Event]]:
        """Speak a text.

        Args:
            text: Plain text, without markup or control characters.
            settings: Voice, rate and pitch.

        Returns:
            Samples as native int16 at `SAMPLE_RATE`, and the events in order.

        Raises:
            OSError: The library cannot be loaded, or refuses the voice.
        """
        blocks: list[bytes] = []
        events: list[Event] = []

        def take(samples: Any, count: int, found: Any) -> int:
            if count > 0:
                blocks.append(ctypes.string_at(samples, 2 * count))
            index = 0
            while found[index].type:
                if found[index].type in (WORD, PHONEME):
                    events.append(_event(found[index]))
                index += 1
            return 0

        callback = _Callback(take)  # the library keeps only a pointer: this name must outlive the synthesis
        with self._opened(settings) as handle:
            handle.espeak_SetSynthCallback(callback)
            said = text.encode("utf-8") + b"\0"
            handle.espeak_Synth(said, ctypes.c_size_t(len(said)), 0, 1, 0, _UTF8, None, None)
        return b"".join(blocks), events

    def phonemes(self, words: Sequence[str], settings: Settings) -> list[str]:
        """IPA of each word as it is spoken alone, its phonemes separated by `_`.

        Raises:
            OSError: The library cannot be loaded, or refuses the voice.
        """
        with self._opened(settings) as handle:
            handle.espeak_TextToPhonemes.restype = ctypes.c_char_p
            return [_phonemes(handle, word) for word in words]

    @contextmanager
    def _opened(self, settings: Settings) -> Iterator[Any]:
        handle = ctypes.CDLL(self.path)
        try:
            with _short(self.data) as data:
                options = _PHONEME_EVENTS | _PHONEME_IPA | _DONT_EXIT
                if handle.espeak_Initialize(_SYNCHRONOUS, 0, os.fsencode(data), options) != SAMPLE_RATE:
                    raise OSError(f"eSpeak NG finds no data in {self.data}")
                try:
                    _prepare(handle, settings)
                    yield handle
                finally:
                    handle.espeak_Terminate()
        finally:
            _unload(handle)


def _prepare(handle: Any, settings: Settings) -> None:
    handle.espeak_ng_SetRandSeed(ctypes.c_long(_SEED))
    _libc().srand(_SEED)
    with _temporary(settings.definition.encode("utf-8", "surrogateescape")) as name:
        if handle.espeak_ng_SetVoiceByFile(os.fsencode(name)):
            raise OSError("eSpeak NG refuses the voice")
    for parameter, value in ((_RATE, settings.rate), (_PITCH, settings.pitch), (_RANGE, settings.range)):
        handle.espeak_SetParameter(parameter, value, 0)


@contextmanager
def _temporary(content: bytes) -> Iterator[str]:
    """A file in the working directory, by its bare name."""
    descriptor, name = tempfile.mkstemp(prefix="scorebreath-voice-", dir=".")
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
        yield Path(name).name
    finally:
        Path(name).unlink()


@contextmanager
def _short(folder: str) -> Iterator[str]:
    """A path to the folder that the library's buffers hold: a link in the working directory if need be."""
    if len(os.fsencode(folder)) < _LONGEST_PATH:
        yield folder
        return
    link = Path(f"scorebreath-data-{os.getpid()}")
    link.symlink_to(folder, target_is_directory=True)
    try:
        yield link.name
    finally:
        link.unlink()


def _event(found: Any) -> Event:
    spoken = ctypes.string_at(ctypes.addressof(found) + _Event.id.offset, 8) if found.type == PHONEME else b""
    # at most 8 bytes are kept, so a long one may end inside a character
    ipa = spoken.partition(b"\0")[0].decode("utf-8", "ignore")
    return Event(found.type, found.text_position, found.length, found.sample, ipa)


def _phonemes(handle: Any, word: str) -> str:
    rest = ctypes.c_char_p(word.encode("utf-8", "replace"))
    clauses = []
    while rest.value is not None:
        clauses.append((handle.espeak_TextToPhonemes(ctypes.byref(rest), _UTF8, _IPA | _SEPARATE) or b"").decode())
    return " ".join(clauses)


def _libc() -> Any:
    return ctypes.cdll.msvcrt if sys.platform == "win32" else ctypes.CDLL(None)


def _unload(handle: Any) -> None:
    if sys.platform == "win32":
        _ctypes.FreeLibrary(handle._handle)
    else:
        _ctypes.dlclose(handle._handle)
