"""The eSpeak NG voice: requests to its worker, and what comes back made into `Speech`."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property

from scorebreath.errors import VoiceError
from scorebreath.signal.level import active_db
from scorebreath.signal.pitch import CEILING, FLOOR
from scorebreath.speech.calibration import LEAST_DB, TYPICAL_DB, sentences
from scorebreath.speech.espeak.catalogue import Catalogue, catalogue
from scorebreath.speech.espeak.launch import installed, worker_command
from scorebreath.speech.espeak.library import SAMPLE_RATE
from scorebreath.speech.espeak.prosody import settings
from scorebreath.speech.espeak.syllables import nuclei
from scorebreath.speech.espeak.text import Said, prepare
from scorebreath.speech.espeak.utterance import samples_of, utterance
from scorebreath.speech.model import Speech, SpeechRequest, Voice, VoiceDetails
from scorebreath.speech.worker import Worker

DEADLINE = 30.0
"""s for any answer; the worker's start is part of the first one's"""
DEADLINE_PER_CHARACTER = 0.02
"""s more for each character; it takes about 0.0003"""
AHEAD = 6
"""requests each worker has before it while `speak_all` waits for one"""
LANES = 2
"""Workers at most; pitch takes five times as long as synthesis, and both are done beside the program's own work."""
SECOND_STARTS, SECOND_WORKS = 6, 16
"""Requests of one `speak_all` after which a second worker is started, and after which it is given work: it takes a few
hundred ms to start, which short texts need not wait for."""
MANY_WORDS = 500
"""Asked for at once, they start it as well: as much will have to be spoken."""
WORDS_AT_ONCE = 1000
"""in one request for syllables"""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Asked:
    """A request on its way."""

    request: SpeechRequest
    said: Said
    worker: Worker
    ticket: int


class EspeakVoice(Voice):
    """A language and variant of eSpeak NG, in worker processes of its own. Safe to use from several threads.

    A text in which there is nothing to say, for this voice, gives `assemble.SILENCE` seconds of pause.
    """

    def __init__(self, language: str, variant: str = "", *, command: Sequence[str] = ()) -> None:
        """Choose it; a worker is started by `start` or the first request.

        Args:
            language: Code, e.g. `en-us`; `en` is American, and `de-AT`, which there is not, `de`.
            variant: e.g. `f3`; may be empty.
            command: Instead of its worker's.

        Raises:
            InputError: There is no such language or variant.
            VoiceError: eSpeak NG is not installed.
        """
        self._library = installed()
        self._chosen = known().choose(language, variant)
        self._name = f"espeak:{self._chosen.name}"
        command = command or worker_command(self._library)
        self._workers = [Worker(command, self._name) for _ in range(LANES)]
        self._worker = self._workers[0]
        self._own = settings(self._chosen)
        self._counts: dict[str, int] = {}

    @cached_property
    def details(self) -> VoiceDetails:
        """What it is."""
        codes = [code for code, _ in self._chosen.language.codes]
        try:
            version = self._library.version()
        except OSError as error:
            raise VoiceError(f"voice {self._name}: {error}") from error
        return describe(self._name, codes, version)

    @cached_property
    def reference_db(self) -> float:
        """Active RMS of the language's calibration sentence, dB re full scale."""
        problem: VoiceError | None = None
        for text in sentences(self._chosen.language.code):
            asked = {"do": "speak", "text": text, "settings": asdict(self._own), "pitch": None}
            try:
                answer = self._worker.receive(self._worker.send(asked, deadline=DEADLINE))
            except VoiceError as error:
                problem = error
                continue
            level = active_db(samples_of(answer), SAMPLE_RATE)
            if level > LEAST_DB:
                return level
        if problem is not None:
            raise problem
        return TYPICAL_DB

    @property
    def pids(self) -> tuple[int, ...]:
        """Process ids of the live workers."""
        return tuple(worker.pid for worker in self._workers if worker.pid is not None)

    def start(self) -> None:
        """Start the worker, so that it is ready sooner."""
        self._worker.start()

    def close(self) -> None:
        """End the workers."""
        for worker in self._workers:
            worker.close()

    def speak(self, request: SpeechRequest) -> Speech:
        """Speak one breath group."""
        return next(self.speak_all((request,)))

    def speak_all(self, requests: Iterable[SpeechRequest]) -> Iterator[Speech]:
        """Speak one group after the other; each worker is up to `AHEAD` requests ahead of what is given."""
        asked: deque[_Asked] = deque()
        try:
            for index, request in enumerate(requests):
                if index == SECOND_STARTS:
                    self._workers[-1].start()
                lanes = LANES if index >= SECOND_WORKS else 1
                asked.append(self._ask(request, self._workers[index % lanes]))
                if len(asked) > AHEAD * lanes:
                    yield _take(asked.popleft())
            while asked:
                yield _take(asked.popleft())
        finally:
            for one in asked:
                one.worker.forget(one.ticket)

    def syllables(self, words: Sequence[str]) -> Sequence[int]:
        """Vowels, diphthongs and syllabic consonants of each word as it is spoken alone; kept for the next time."""
        new = [word for word in dict.fromkeys(words) if word not in self._counts]
        if len(words) >= MANY_WORDS:
            self._workers[-1].start()
        for first in range(0, len(new), WORDS_AT_ONCE):
            some = new[first : first + WORDS_AT_ONCE]
            said = [prepare(word, "final").text[:-1] for word in some]
            asked = {"do": "phonemes", "words": said, "settings": asdict(self._own)}
            deadline = DEADLINE + DEADLINE_PER_CHARACTER * sum(map(len, said))
            found = self._worker.receive(self._worker.send(asked, deadline=deadline)).fields["phonemes"]
            for word, phonemes in zip(some, found, strict=True):
                least = 1 if any(character.isalpha() for character in word) else 0
                self._counts[word] = max(least, nuclei(phonemes, self._chosen.language.code))
        return [self._counts[word] for word in words]

    def _ask(self, request: SpeechRequest, worker: Worker) -> _Asked:
        said = prepare(request.text.text, request.closing)
        set_up = settings(
            self._chosen, rate=request.rate, pitch=request.pitch, continuing=request.closing == "continuing"
        )
        asked = {
            "do": "speak",
            "text": said.text,
            "settings": asdict(set_up),
            "pitch": (FLOOR * min(1.0, request.pitch), CEILING * max(1.0, request.pitch)),
        }
        deadline = DEADLINE + DEADLINE_PER_CHARACTER * len(said.text)
        return _Asked(request=request, said=said, worker=worker, ticket=worker.send(asked, deadline=deadline))


def _take(asked: _Asked) -> Speech:
    return utterance(asked.request.text, asked.said, asked.worker.receive(asked.ticket))


def known() -> Catalogue:
    """All languages and variants.

    Raises:
        VoiceError: eSpeak NG is not installed.
    """
    return catalogue(installed().data)


def describe(name: str, languages: Sequence[str], version: str) -> VoiceDetails:
    """Details of a voice of this engine."""
    return VoiceDetails(
        engine="espeak-ng",
        voice=name,
        version=version,
        licence="GPL-3.0-or-later",
        provenance="formant synthesis by rule; no recordings of a speaker",
        languages=tuple(dict.fromkeys(tag(code) for code in languages)),
        sample_rate=SAMPLE_RATE,
        deterministic=True,
    )


def tag(code: str) -> str:
    """A language code with its region in capitals, as BCP 47 writes it.

    >>> tag("en-us"), tag("vi-vn-x-south"), tag("de")
    ('en-US', 'vi-VN-x-south', 'de')
    """
    first, *rest = code.split("-")
    private = rest.index("x") if "x" in rest else len(rest)
    shown = [part.upper() if len(part) == 2 and place < private else part for place, part in enumerate(rest)]
    return "-".join((first, *shown))
