"""The voice of a recording: it says what was recorded, when it is asked for those very words."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import VoiceError
from scorebreath.signal.level import active_db
from scorebreath.signal.pitch import limits_of, pitch_hertz
from scorebreath.spans import Span
from scorebreath.speech.assemble import FramedPhone, SpokenWord, silence, speech
from scorebreath.speech.espeak.voice import tag
from scorebreath.speech.model import Speech, SpeechRequest, Voice, VoiceDetails
from scorebreath.speech.recording.listen import Listened
from scorebreath.speech.recording.model import HeardWord, Take, Written
from scorebreath.speech.recording.pronounce import Pronouncer

ENGINE = "recording"
FADE = 0.002
"""s over which a cut sound fades in and out"""
LEAST_FRAMES = 8
"""frames of a phone, at least"""


class RecordedVoice(Voice):
    """Speaks the words of one recording. Rate and pitch that are asked for are not heeded: it was said as it was."""

    def __init__(self, take: Take, heard: Listened, written: Sequence[Written], language: str) -> None:
        """Nothing is cut yet.

        Args:
            take: The recording.
            heard: What is heard in it.
            written: Its transcript.
            language: BCP 47.
        """
        self._take, self._heard, self._written, self._language = take, heard, written, language
        self._counter: Pronouncer | None = None
        self._first: dict[int, int] = {}
        for place, word in enumerate(heard.words):
            if word.word is not None:
                self._first.setdefault(word.word, place)

    @cached_property
    def details(self) -> VoiceDetails:
        """What it is."""
        digest = hashlib.sha256(self._take.samples.tobytes()).hexdigest()
        return VoiceDetails(
            engine=ENGINE, voice=f"{ENGINE}:{self._take.path.name}", version=digest[:12],
            licence="of the recording; nothing is known about it here",
            provenance=f"{self._take.path.name}, {self._take.duration:.2f} s; words found by {self._heard.by}",
            languages=(tag(self._language.lower()),), sample_rate=self._take.sample_rate, deterministic=True,
        )  # fmt: skip

    @cached_property
    def reference_db(self) -> float:
        """Active RMS of all that is said, dB re full scale."""
        said = [self._cut(word.start, word.end) for word in self._heard.words]
        return active_db(np.concatenate(said), self._take.sample_rate)

    def span(self, source: Span) -> tuple[int, int]:
        """The heard words of a part of the transcript, half-open; those that nobody wrote go with the ones before.

        Args:
            source: In the transcript.
        """
        places = [
            self._first[place]
            for place, word in enumerate(self._written)
            if place in self._first and source.start <= word.source.start < source.end
        ]
        if not places:
            return 0, 0
        first, last = min(places), max(places) + 1
        if first == min(self._first.values()):
            first = 0
        own = self._heard.words
        while last < len(own) and own[last].word is None:
            last += 1
        return first, last

    def speak(self, request: SpeechRequest) -> Speech:
        """The part of the recording in which the words are said; a short silence where none of them is."""
        runs = request.text.runs
        if not runs:
            return silence(self._take.sample_rate)
        first, last = self.span(Span(runs[0].source.start, runs[-1].source.end))
        if first == last:
            return silence(self._take.sample_rate)
        return self._speech(self._heard.words[first:last])

    def syllables(self, words: Sequence[str]) -> Sequence[int]:
        """As eSpeak NG counts them."""
        if self._counter is None:
            self._counter = Pronouncer(self._language)
        return self._counter.syllables(words)

    def close(self) -> None:
        """End whoever counts syllables."""
        if self._counter is not None:
            self._counter.close()

    @cached_property
    def _limits(self) -> tuple[float, float]:
        """Between which its pitch is looked for, Hz."""
        return limits_of(pitch_hertz(self._take.samples, self._take.sample_rate))

    def _speech(self, words: Sequence[HeardWord]) -> Speech:
        rate = self._take.sample_rate
        start, end = words[0].start, words[-1].end
        samples = self._cut(start, end).copy()
        if not len(samples):
            raise VoiceError(f"{self._take.path}: {words[0].text!r} at {start:.2f} s has no length")
        fade = min(round(FADE * rate), len(samples) // 2)
        ramp = ((np.arange(fade) + 0.5) / max(1, fade)).astype(np.float32)
        samples[:fade] *= ramp
        samples[len(samples) - fade :] *= ramp[::-1]
        low, high = self._limits
        return speech(
            samples=samples, sample_rate=rate, phones=_framed(words, start, len(samples), rate),
            words=[SpokenWord(text=word.text, source=self._source(word)) for word in words],
            hertz=pitch_hertz(samples, rate, floor=low, ceiling=high).tolist(),
        )  # fmt: skip

    def _source(self, word: HeardWord) -> tuple[int, int] | None:
        if word.word is None:
            return None
        source = self._written[word.word].bare
        return source.start, source.end

    def _cut(self, start: float, end: float) -> NDArray[np.float32]:
        rate = self._take.sample_rate
        return self._take.samples[round(start * rate) : round(end * rate)]


def _framed(words: Sequence[HeardWord], begun: float, frames: int, rate: int) -> list[FramedPhone]:
    """Phones and pauses, one after the other from the first frame; each word has one at least, none is empty."""
    wanted: list[tuple[float, FramedPhone]] = []
    for number, word in enumerate(words):
        if number and word.start > words[number - 1].end + 1e-9:
            wanted.append((words[number - 1].end, FramedPhone(ipa="", start=0)))
        wanted += (
            (phone.start, FramedPhone(ipa=phone.ipa, start=0, stress=phone.stress, word=number))
            for phone in word.phones
        )
    least = max(1, min(LEAST_FRAMES, frames // max(1, len(wanted))))
    out: list[FramedPhone] = []
    for place, (time, phone) in enumerate(wanted):
        latest = frames - least * (len(wanted) - place)
        start = round((time - begun) * rate)
        start = 0 if not out else min(max(start, out[-1].start + least), latest)
        out.append(FramedPhone(ipa=phone.ipa, start=start, stress=phone.stress, word=phone.word))
    return out


def recorded_from(name: str) -> Path | None:
    """The file that a voice's name means; None: it means no recording.

    >>> recorded_from("recording:take.wav"), recorded_from("espeak")
    (PosixPath('take.wav'), None)
    """
    family, colon, file = name.partition(":")
    return Path(file) if family.lower() == ENGINE and colon and file else None
