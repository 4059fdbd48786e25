"""How a word is said, by eSpeak NG: its phones, their stress, and how long each is beside the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Self

from scorebreath.equations.phones import is_vowel
from scorebreath.spans import Span, join
from scorebreath.speech.espeak.voice import EspeakVoice
from scorebreath.speech.model import Speech, SpeechRequest


@dataclass(frozen=True, slots=True, kw_only=True)
class Sound:
    """A phone of a word."""

    ipa: str
    stress: int
    share: float
    """of the word's length"""


class Pronouncer:
    """Says words; each once."""

    def __init__(self, language: str) -> None:
        """Nothing is said yet.

        Raises:
            InputError: eSpeak NG does not speak the language.
            VoiceError: It is not installed.
        """
        self._voice = EspeakVoice(language)
        self._known: dict[str, tuple[Sound, ...]] = {}

    def words(self, words: Sequence[str]) -> list[tuple[Sound, ...]]:
        """Phones of each word; none for one that is silent."""
        new = [word for word in dict.fromkeys(words) if word not in self._known]
        said = self._voice.speak_all(
            SpeechRequest(text=join([(word, Span(0, len(word)))]), closing="final") for word in new
        )
        for word, speech in zip(new, said, strict=True):
            self._known[word] = _sounds(speech)
        return [self._known[word] for word in words]

    def say(self, requests: Sequence[SpeechRequest]) -> list[Speech]:
        """Whole texts."""
        return list(self._voice.speak_all(requests))

    def syllables(self, words: Sequence[str]) -> Sequence[int]:
        """A `SyllableCounter`."""
        return self._voice.syllables(words)

    def close(self) -> None:
        """End it."""
        self._voice.close()

    def __enter__(self) -> Self:
        """Itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End it."""
        self.close()


def _sounds(speech: Speech) -> tuple[Sound, ...]:
    phones = [phone for phone in speech.phones if phone.ipa]
    whole = sum(phone.duration for phone in phones)
    return tuple(Sound(ipa=phone.ipa, stress=phone.stress, share=phone.duration / whole) for phone in phones)


def stressed(phones: Sequence[str], said: Sequence[Sound]) -> list[int]:
    """Stress of phones that come from elsewhere: the n-th vowel's is that of the n-th vowel as it is said.

    >>> stressed(["b", "ə", "n", "ɑ"], [Sound(ipa="ə", stress=0, share=0.5), Sound(ipa="ɑ", stress=1, share=0.5)])
    [0, 0, 0, 1]
    """
    told = [sound.stress for sound in said if is_vowel(sound.ipa)]
    out, vowels = [], 0
    for ipa in phones:
        if is_vowel(ipa):
            out.append(told[vowels] if vowels < len(told) else 0)
            vowels += 1
        else:
            out.append(0)
    return out
