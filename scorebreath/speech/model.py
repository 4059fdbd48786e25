"""What a voice is asked for, what it gives, and what a voice is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from scorebreath.score.events import Closing, Level, Phone, Pitch, Word
from scorebreath.spans import SpokenText

ANY_LANGUAGE = "mul"
"""What a voice without a language of its own says it speaks (ISO 639-2)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class VoiceDetails:
    """Where a voice comes from and what it promises."""

    engine: str
    """e.g. `espeak-ng`"""
    voice: str
    """its whole name, by which it opens again whatever it was asked for by: `espeak:en-us` for `espeak`"""
    version: str
    licence: str
    """SPDX, or a sentence"""
    provenance: str
    """what it was made or trained from, for those who must know"""
    languages: tuple[str, ...]
    """BCP 47"""
    sample_rate: int
    """Hz"""
    deterministic: bool
    """equal requests give equal bytes, on one machine with one set of versions"""
    fingerprint: str = ""
    """what else its bytes depend on, such as the digest of a model; for the cache"""
    heeds_context: bool = False
    """whether it speaks otherwise for what is said before and after"""

    @property
    def language(self) -> str:
        """The primary language, such as `de`, of a voice that speaks one alone; else empty."""
        primaries = {language.partition("-")[0].lower() for language in self.languages} - {ANY_LANGUAGE}
        return primaries.pop() if len(primaries) == 1 else ""


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeechRequest:
    """One breath group to be spoken."""

    text: SpokenText
    """what to say; `source` spans are places in the Score's text"""
    closing: Closing
    """`continuing` asks for continuation intonation: the group does not end its sentence"""
    rate: float = 1.0
    """of the voice's own, 0.5..2"""
    pitch: float = 1.0
    """of the voice's own mean, 0.5..2"""
    before: str = ""
    """what was said just before, for voices that want it"""
    after: str = ""
    """what will be said next"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Speech:
    """One breath group, spoken and measured. The sound begins with its first phone and ends with its last.

    Times are seconds on the 1e-6 grid; phones are contiguous from 0 to the duration.
    """

    samples: NDArray[np.float32]
    """(n,), within -1..1"""
    sample_rate: int
    """Hz"""
    words: tuple[Word, ...]
    phones: tuple[Phone, ...]
    pitch: Pitch
    level: Level

    @property
    def duration(self) -> float:
        """Seconds."""
        return len(self.samples) / self.sample_rate


class Voice(Protocol):
    """Someone who can speak. Made by `speech.voices.open_voice`; close it, or use it as a context manager."""

    @property
    def details(self) -> VoiceDetails:
        """What it is."""

    @property
    def reference_db(self) -> float:
        """Active RMS of one calibration sentence at the voice's own rate and pitch, dB re full scale."""

    def speak(self, request: SpeechRequest) -> Speech:
        """Speak one breath group; where there is nothing to say, a short silence that is one pause.

        Raises:
            VoiceError: It crashed twice, or missed its deadline twice.
        """

    def speak_all(self, requests: Iterable[SpeechRequest]) -> Iterator[Speech]:
        """Speak one group after the other; equal to `speak` for each.

        A voice may take a few requests ahead of what it gives, so that its worker is busy while the caller is.

        Raises:
            VoiceError: As `speak`.
        """
        for request in requests:
            yield self.speak(request)

    def syllables(self, words: Sequence[str]) -> Sequence[int]:
        """Syllables of each bare word, at least 1 for one with a letter in it: a `SyllableCounter`."""

    def close(self) -> None:
        """End what runs in the background."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
