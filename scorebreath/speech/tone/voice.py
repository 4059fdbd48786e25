"""The tone voice: everything about its speech is known beforehand, and nothing has to be installed for it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from scorebreath.signal.level import active_db
from scorebreath.spans import SpokenText
from scorebreath.speech.assemble import FramedPhone, SpokenWord, silence, speech
from scorebreath.speech.model import ANY_LANGUAGE, Speech, SpeechRequest, Voice, VoiceDetails
from scorebreath.speech.tone.letters import Read, Sound, read, sounds_of
from scorebreath.speech.tone.sound import FULL_SCALE, SAMPLE_RATE, STEP, Placed, contour, render

VERSION = "1"
"""Rises when its bytes change."""
THOUSANDTHS = 1000
CALIBRATION = "The old ferryman rowed slowly over the river."

DETAILS = VoiceDetails(
    engine="tone",
    voice="tone",
    version=VERSION,
    licence="GPL-3.0-or-later",
    provenance="tones and noise by rule, for tests; part of scorebreath",
    languages=(ANY_LANGUAGE,),
    sample_rate=SAMPLE_RATE,
    deterministic=True,
)


class ToneVoice(Voice):
    """Reads any text letter by letter. Equal requests give equal samples on every machine."""

    @property
    def details(self) -> VoiceDetails:
        """What it is."""
        return DETAILS

    @cached_property
    def reference_db(self) -> float:
        """Active RMS of `CALIBRATION`, dB re full scale."""
        said = self.speak(SpeechRequest(text=SpokenText(text=CALIBRATION, runs=()), closing="final"))
        return active_db(said.samples, SAMPLE_RATE)

    def speak(self, request: SpeechRequest) -> Speech:
        """Speak one breath group."""
        words = read(request.text.text)
        if not words:
            return silence(SAMPLE_RATE)
        placed, owners = _place(words, max(1, round(request.rate * THOUSANDTHS)))
        steps = placed[-1].start + placed[-1].steps
        pitch = contour(steps, request.closing, max(1, round(request.pitch * THOUSANDTHS)))
        voiced = np.repeat([one.voiced for one in placed], [one.steps for one in placed])
        stressed = _stressed(placed, owners)
        return speech(
            samples=np.asarray(render(placed, pitch) / FULL_SCALE, dtype=np.float32),
            sample_rate=SAMPLE_RATE,
            phones=[
                FramedPhone(ipa=one.sound.ipa, start=one.start * STEP, stress=int(index in stressed), word=owner)
                for index, (one, owner) in enumerate(zip(placed, owners, strict=True))
            ],
            words=[_word(request.text, word) for word in words],
            hertz=(np.where(voiced, pitch, 0) / 100).tolist(),
        )

    def syllables(self, words: Sequence[str]) -> Sequence[int]:
        """Groups of vowel letters, and digits."""
        return [_syllables(word) for word in words]

    def close(self) -> None:
        """Nothing to end."""


def _place(words: Sequence[Read], thousandths: int) -> tuple[list[Placed], list[int | None]]:
    """Phones and pauses in time, and whose they are."""
    placed: list[Placed] = []
    owners: list[int | None] = []
    at = 0

    def put(sound: Sound, owner: int | None) -> None:
        nonlocal at
        steps = max(2, (sound.steps * THOUSANDTHS + thousandths // 2) // thousandths)
        placed.append(Placed(sound=sound, start=at, steps=steps))
        owners.append(owner)
        at += steps

    for index, word in enumerate(words):
        if word.pause is not None:
            put(word.pause, None)
        for sound in word.sounds:
            put(sound, index)
    return placed, owners


def _stressed(placed: Sequence[Placed], owners: Sequence[int | None]) -> frozenset[int]:
    """The first vowel of each word."""
    first: dict[int, int] = {}
    for index, (one, owner) in enumerate(zip(placed, owners, strict=True)):
        if owner is not None and one.sound.kind == "vowel":
            first.setdefault(owner, index)
    return frozenset(first.values())


def _word(text: SpokenText, word: Read) -> SpokenWord:
    source = text.source(word.start, word.end)
    written = text.text[word.start : word.end]
    return SpokenWord(text=written, source=None if source is None else (source.start, source.end))


def _syllables(word: str) -> int:
    vowels = sum(sound.kind == "vowel" for sound in sounds_of(word))
    return max(vowels, int(any(character.isalpha() for character in word)))
