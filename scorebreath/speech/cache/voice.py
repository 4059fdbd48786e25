"""A voice with a memory: what it has said once, it need not say again."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from scorebreath.speech.cache.keys import first_place, request_key, voice_key
from scorebreath.speech.cache.shelf import Shelf, default_folder, moved
from scorebreath.speech.model import Speech, SpeechRequest, Voice, VoiceDetails

STRETCH = 64
"""Utterances in a row that are kept, after which the voice is not asked to look further ahead."""
MOST_WORDS = 50_000
"""words whose syllables are kept for a voice"""
UNKEPT = frozenset({"tone"})
"""Engines that speak faster than a disk reads."""


@dataclass(frozen=True, slots=True)
class _Entry:
    request: SpeechRequest
    key: str
    asked: bool
    """of the voice; else it is kept already, or will be by its turn"""


class CachedVoice(Voice):
    """Another voice, asked only for what it has not said yet. What it gives is equal bit for bit."""

    def __init__(self, voice: Voice, shelf: Shelf) -> None:
        """Nothing is asked or read yet.

        Args:
            voice: Who speaks; closed with this one.
            shelf: Where utterances are kept.
        """
        self._voice, self.shelf = voice, shelf
        self._key = ""
        self._reference: float | None = None
        self._counts: dict[str, int] = {}
        self._learnt = False
        self.spoken = 0
        """utterances that the voice was asked for"""
        self.kept = 0
        """utterances that were here already"""

    @property
    def details(self) -> VoiceDetails:
        """What it is: the other voice's own."""
        return self._voice.details

    @property
    def reference_db(self) -> float:
        """As the voice says, or said."""
        self._know()
        if self._reference is None:
            self._reference = self._voice.reference_db
            self._learnt = True
        return self._reference

    def speak(self, request: SpeechRequest) -> Speech:
        """Speak one breath group, or remember it."""
        return next(self.speak_all((request,)))

    def speak_all(self, requests: Iterable[SpeechRequest]) -> Iterator[Speech]:
        """Speak one group after the other; the voice is kept busy with those that are new."""
        self._know()
        source = iter(requests)
        waiting: deque[_Entry] = deque()
        asked: set[str] = set()
        over = False

        def new() -> Iterator[SpeechRequest]:
            """Requests for the voice, up to a long run of what is kept."""
            nonlocal over
            run = 0
            for request in source:
                key = request_key(self._key, request, context=self.details.heeds_context)
                if key in asked or self.shelf.has(key):
                    waiting.append(_Entry(request, key, False))
                    run += 1
                    if run >= STRETCH:
                        return
                    continue
                asked.add(key)
                waiting.append(_Entry(request, key, True))
                run = 0
                yield request
            over = True

        while not over or waiting:
            for speech in self._voice.speak_all(new()):
                while not waiting[0].asked:
                    yield self._remembered(waiting.popleft())
                entry = waiting.popleft()
                self.spoken += 1
                self.shelf.put(entry.key, moved(speech, -first_place(entry.request)), self.details.voice)
                yield speech
            while waiting:
                yield self._remembered(waiting.popleft())

    def syllables(self, words: Sequence[str]) -> Sequence[int]:
        """As the voice counts them, or counted."""
        self._know()
        new = [word for word in dict.fromkeys(words) if word not in self._counts]
        if new:
            self._counts.update(zip(new, self._voice.syllables(new), strict=True))
            self._learnt = True
        return [self._counts[word] for word in words]

    def close(self) -> None:
        """Keep what was learnt about the voice, and end it."""
        if self._learnt and self._key:
            known = self.shelf.known(self._key)
            counts = {**_counts(known), **self._counts}
            about = {"voice": self.details.voice, "syllables": dict(list(counts.items())[-MOST_WORDS:])}
            self.shelf.tell(
                self._key, about | ({"reference_db": self._reference} if self._reference is not None else {})
            )
            self._learnt = False
        self._voice.close()

    def _remembered(self, entry: _Entry) -> Speech:
        speech = self.shelf.get(entry.key)
        if speech is None:  # broken, or just removed by another process
            speech = moved(self._voice.speak(entry.request), -first_place(entry.request))
            self.spoken += 1
            self.shelf.put(entry.key, speech, self.details.voice)
        else:
            self.kept += 1
        return moved(speech, first_place(entry.request))

    def _know(self) -> None:
        """Read what is kept about the voice."""
        if self._key:
            return
        self._key = voice_key(self.details)
        known = self.shelf.known(self._key)
        self._counts = _counts(known)
        reference = known.get("reference_db")
        self._reference = reference if isinstance(reference, float) else None


def _counts(known: dict[str, object]) -> dict[str, int]:
    told = known.get("syllables")
    if not isinstance(told, dict):
        return {}
    return {word: count for word, count in told.items() if type(count) is int and count >= 0}


def cached(voice: Voice, shelf: Shelf | None = None) -> Voice:
    """A voice with a memory, where that serves: it gives equal bytes for equal requests, and there is a cache.

    Args:
        voice: Who speaks.
        shelf: Where utterances are kept; None: in the cache's own folder (`shelf.default_folder`).

    Raises:
        InputError: The environment's limit is no size.
    """
    details = voice.details
    if shelf is None and (folder := default_folder()) is not None:
        shelf = Shelf(folder)
    if shelf is None or not details.deterministic or details.engine in UNKEPT:
        return voice
    return CachedVoice(voice, shelf)
