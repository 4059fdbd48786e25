"""The Piper voice: requests to its workers, and what comes back made into `Speech`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from scorebreath.errors import InputError
from scorebreath.signal.level import active_db
from scorebreath.spans import SpokenText
from scorebreath.speech.assemble import FramedPhone, silence, speech
from scorebreath.speech.calibration import LEAST_DB, TYPICAL_DB, sentences
from scorebreath.speech.espeak.text import Said, prepare
from scorebreath.speech.espeak.utterance import written
from scorebreath.speech.espeak.voice import EspeakVoice, known, tag
from scorebreath.speech.lanes import Lanes, Question, Turns
from scorebreath.speech.model import Speech, SpeechRequest, Voice, VoiceDetails
from scorebreath.speech.piper.models import JOE, Model, installed, version
from scorebreath.speech.process import module_command
from scorebreath.speech.worker import Answer

DEADLINE = 90.0
"""s for any answer: a worker loads its model for the first one"""
DEADLINE_PER_CHARACTER = 0.2
"""s more for each character; it takes about 0.006"""
LANES = 2
"""Workers at most, each with a model of its own of 0.3 GB."""
TURNS = Turns(ahead=3, starts=2, works=4)
HUNDREDTHS = 100
"""Pitch comes in hundredths of a Hz."""
_TOKEN = re.compile(r"[^\s–—―…/]+")
"""What may be one word: anything between spaces, dashes, ellipses and slashes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Wanted:
    """A request, ready to be asked."""

    request: SpeechRequest
    said: Said
    places: tuple[tuple[int, int], ...]
    """of each word, in the text that is said"""


class PiperVoice(Voice):
    """A Piper voice in worker processes of its own, each with one loaded model. Safe to use from several threads.

    A text in which there is nothing to say, for this voice, gives `assemble.SILENCE` seconds of pause.
    """

    def __init__(self, model: Model) -> None:
        """Choose it; a worker loads the model when it is first asked.

        Args:
            model: As `models.find` gives it.

        Raises:
            InputError: Its phonemes are of a language that eSpeak NG does not have.
        """
        self._model = model
        self._name = f"piper:{model.name}"
        if known().find(model.espeak) is None:
            raise InputError(
                f"voice {self._name!r}: {model.config.name}: espeak.voice={model.espeak!r} is no language of eSpeak NG"
            )
        speaker = "" if model.speaker is None else str(model.speaker)
        command = module_command("scorebreath.speech.piper.worker", str(model.path), str(model.config), speaker)
        self._lanes = Lanes(command, self._name, LANES, TURNS)
        self._counter: EspeakVoice | None = None

    @cached_property
    def details(self) -> VoiceDetails:
        """What it is."""
        digest = self._model.digest()
        return VoiceDetails(
            engine="piper",
            voice=self._name,
            version=f"{version()} {digest[:12]}",
            licence=self._model.licence,
            provenance=self._model.provenance,
            languages=(tag(self._model.language.lower()),),
            sample_rate=self._model.sample_rate,
            deterministic=True,
            fingerprint=f"{digest} {' '.join(installed())}",
        )

    @cached_property
    def reference_db(self) -> float:
        """Active RMS of the language's calibration sentence, dB re full scale."""
        for text in sentences(self._model.language):
            said = self.speak(SpeechRequest(text=SpokenText(text=text, runs=()), closing="final"))
            level = active_db(said.samples, said.sample_rate)
            if level > LEAST_DB:
                return level
        return TYPICAL_DB

    @property
    def pids(self) -> tuple[int, ...]:
        """Process ids of the live workers."""
        return self._lanes.pids

    def close(self) -> None:
        """End the workers."""
        self._lanes.close()
        if self._counter is not None:
            self._counter.close()

    def speak(self, request: SpeechRequest) -> Speech:
        """Speak one breath group."""
        return next(self.speak_all((request,)))

    def speak_all(self, requests: Iterable[SpeechRequest]) -> Iterator[Speech]:
        """Speak one group after the other; each worker is some requests ahead of what is given.

        Raises:
            InputError: The file is no Piper voice.
            VoiceError: The worker failed.
        """
        for wanted, answer in self._lanes.in_turn(
            map(_wanted, requests), partial(_question, known_sentence=sentences(self._model.language)[-1])
        ):
            yield self._speech(wanted, answer)

    def syllables(self, words: Sequence[str]) -> Sequence[int]:
        """Vowels, diphthongs and syllabic consonants, as eSpeak NG's voice of the language counts them."""
        if self._counter is None:
            code = next((code for code in (self._model.espeak, self._model.language) if known().find(code)), "en")
            self._counter = EspeakVoice(code)
        return self._counter.syllables(words)

    def _speech(self, wanted: _Wanted, answer: Answer) -> Speech:
        fields, rate = answer.fields, self._model.sample_rate
        if "refused" in fields:
            shown = "joe" if self._model.name == JOE else str(self._model.path)
            raise InputError(f"voice 'piper:{shown}': {fields['refused']}")
        frames, placed = int(fields["frames"]), fields["phones"]
        if not placed:
            return silence(rate)
        samples = np.frombuffer(answer.payload, dtype="<f4", count=frames).astype(np.float32)
        hertz = np.frombuffer(answer.payload, dtype="<i4", offset=4 * frames) / HUNDREDTHS
        said, words, numbers = _words(wanted, [word for *_, word in placed])
        return speech(
            samples=samples,
            sample_rate=rate,
            phones=[
                FramedPhone(ipa=ipa, start=start, stress=stress, word=None if word is None else numbers[word])
                for ipa, start, stress, word in placed
            ],
            words=[written(wanted.request.text, said, start, end, merged=merged) for start, end, merged in words],
            hertz=hertz.tolist(),
        )


def _wanted(request: SpeechRequest) -> _Wanted:
    said = prepare(request.text.text, request.closing)
    matches = _TOKEN.finditer(said.text[:-1])
    places = tuple(match.span() for match in matches if any(character.isalnum() for character in match.group()))
    return _Wanted(request=request, said=said, places=places)


def _question(wanted: _Wanted, known_sentence: str) -> Question:
    request, text = wanted.request, wanted.said.text
    fields = {
        "text": text,
        "words": [text[start:end] for start, end in wanted.places],
        "rate": request.rate,
        "pitch": request.pitch,
        "known": known_sentence,
    }
    return Question(fields=fields, deadline=DEADLINE + DEADLINE_PER_CHARACTER * len(text))


def _words(wanted: _Wanted, heard: Sequence[int | None]) -> tuple[Said, list[tuple[int, int, bool]], dict[int, int]]:
    """Ranges of the words that are heard, silent ones taken in by the one before; and each one's new number."""
    present = sorted({word for word in heard if word is not None})
    numbers = {word: number for number, word in enumerate(present)}
    ranges: list[tuple[int, int, bool]] = []
    for number, word in enumerate(present):
        first = word if number else 0
        last = present[number + 1] - 1 if number + 1 < len(present) else len(wanted.places) - 1
        ranges.append((wanted.places[first][0], wanted.places[last][1], last > first))
    return wanted.said, ranges, numbers
