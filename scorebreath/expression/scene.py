"""What is known of a group that has been placed: where its phones, words, accents, phrases and pauses lie in time."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise

from scorebreath.compose.phrasing import HIGH, LOW
from scorebreath.expression.accents import Peak, Span, accents, peaks
from scorebreath.expression.state import Placed
from scorebreath.score.events import Event, Expiration, Hold, Inspiration, Phone, Phrase, Utterance, Word
from scorebreath.script.accents import is_hesitation
from scorebreath.units import snap

PAUSE = 0.15
"""s of silence that make a pause (A4)."""
PROLONGED = 0.6
"""s of an unfilled pause within a sentence in which a word is searched for (Y2)."""
NEAR = 0.05
"""s that a phrase's end and the silence behind it may lie apart."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Silence(Span):
    """A pause inside a group."""

    free: bool
    """between two utterances: there are no phones' boundaries to keep to"""
    search: bool
    """whether a word is searched for in it"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Question(Span):
    """A question's last word; `until` is where speech goes on inside the group, None: not before its end."""

    until: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """A group in time."""

    onset: float
    """of the first sound"""
    end: float
    """of the last sound"""
    edges: tuple[float, ...]
    """boundaries of phones, ascending"""
    stressed: tuple[Span, ...]
    """stressed vowels"""
    accents: tuple[Span, ...]
    """accented syllables"""
    peaks: tuple[Peak, ...]
    silences: tuple[Silence, ...]
    phrases: tuple[Span, ...]
    asking: tuple[Span, ...]
    """from a question's first sound to where speech goes on behind it"""
    questions: tuple[Question, ...]
    hesitations: tuple[Span, ...]

    def edge(self, time: float, low: float = 0.0) -> float:
        """The phones' boundary nearest to a time, not before `low` (A19)."""
        first = bisect_left(self.edges, low)
        place = max(first, bisect_left(self.edges, time))
        near = self.edges[max(first, place - 1) : place + 1]
        return min(near, key=lambda edge: abs(edge - time)) if near else max(low, time)

    def between(self, low: float, high: float) -> Sequence[float]:
        """Boundaries in [low, high]."""
        return self.edges[bisect_left(self.edges, low - 1e-9) : bisect_left(self.edges, high + 1e-9)]


def speech(placed: Placed) -> list[Utterance]:
    """Its utterances in time."""
    return sorted((e for e in placed.events if isinstance(e, Utterance)), key=lambda e: e.onset)


def first_sound(placed: Placed) -> float | None:
    """When it begins to speak; None: it does not."""
    onsets = [sound.onset for utterance in speech(placed) for sound in _sounds(utterance)]
    return min(onsets, default=None)


def last_sound(placed: Placed) -> float:
    """When it ends to speak; it does."""
    return max(sound.end for utterance in speech(placed) for sound in _sounds(utterance))


def opening(placed: Placed, language: str) -> tuple[float, ...]:
    """Onsets of what the eyes may do as soon as it speaks: a search on its first word, a glance right behind that."""
    begun = [sound for utterance in speech(placed) for sound in _sounds(utterance)]
    near = [sound for sound in begun if sound.onset <= begun[0].onset + PAUSE]
    found = [one.end for one, other in pairwise(begun[: len(near) + 1]) if snap(other.onset - one.end) >= PAUSE]
    words = [(_span(u, word, word.text), word) for u in speech(placed) for word in u.words[:2]]
    found += [span.onset for span, word in words if is_hesitation(word.text, language)]
    return tuple(found)


def questions(placed: Placed) -> tuple[Question, ...]:
    """Last words of the questions that end in a group."""
    utterances = speech(placed)
    sounds = [sound for utterance in utterances for sound in _sounds(utterance)]
    words = [(word, utterance) for utterance in utterances for word in utterance.words]
    asking = [each for each in _phrases(placed.events, utterances) if each.sentence_type == "question"]
    return _questions(asking, words, sounds)


def scene(placed: Placed, language: str) -> Scene:
    """Look at a group that speaks."""
    utterances = speech(placed)
    sounds = [sound for utterance in utterances for sound in _sounds(utterance)]
    phrases = _phrases(placed.events, utterances)
    asking = [each for each in phrases if each.sentence_type == "question"]
    words = [(word, utterance) for utterance in utterances for word in utterance.words]
    asked = _questions(asking, words, sounds)
    edges = {snap(u.onset + t) for u in utterances for p in u.phones for t in (p.onset, p.onset + p.duration)}
    edges |= {time for sound in sounds for time in (sound.onset, sound.end)}
    silences = _silences(sounds, utterances, phrases, placed.events)
    hesitations = tuple(_span(u, word, word.text) for word, u in words if is_hesitation(word.text, language))

    def meant(time: float, since: float | None = None) -> bool:
        """Whether something is an accent of what is said: a word of hesitation has none (A32)."""
        return not any(time in word or (since is not None and since in word) for word in hesitations)

    return Scene(
        onset=sounds[0].onset,
        end=sounds[-1].end,
        edges=tuple(sorted(edges)),
        stressed=tuple(_span(u, p) for u in utterances for p in u.phones if p.stress == 1),
        accents=tuple(accent for u in utterances for accent in accents(u) if meant(accent.onset)),
        peaks=tuple(peak for u in utterances for peak in peaks(u) if meant(peak.time, peak.syllable)),
        silences=silences,
        phrases=tuple(Span(onset=each.onset, end=each.end) for each in phrases),
        asking=tuple(_asking(phrases, asked)),
        questions=asked,
        hesitations=hesitations,
    )


def _asking(phrases: Sequence[_Phrase], asked: Sequence[Question]) -> Iterator[Span]:
    """Questions as a whole: runs of their phrases, with the pauses in between and the one behind (A22)."""
    for kind, run in groupby(phrases, key=lambda phrase: phrase.sentence_type):
        if kind == "question":
            parts = list(run)
            low, high = parts[0].onset, max(part.end for part in parts)
            behind = [each.until for each in asked if each.until is not None and low <= each.onset < high]
            yield Span(onset=low, end=max([high, *behind]))


def _span(utterance: Utterance, part: Phone | Word, text: str = "") -> Span:
    onset = utterance.onset + part.onset
    return Span(onset=snap(onset), end=snap(onset + part.duration), text=text)


def _sounds(utterance: Utterance) -> list[Span]:
    """Phones that are heard; of a voice that tells none, the whole utterance."""
    heard = [_span(utterance, phone) for phone in utterance.phones if phone.ipa]
    return heard or [Span(onset=utterance.onset, end=utterance.end)]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Phrase(Span):
    position: str
    sentence_type: str
    tone: str = ""

    @property
    def asked(self) -> bool:
        """Whether a question ends with it: with its sentence, or where it is quoted and the sentence goes on."""
        return self.sentence_type == "question" and (self.position == "final" or self.tone in (HIGH, LOW))


def _phrases(events: Sequence[Event], utterances: Sequence[Utterance]) -> list[_Phrase]:
    """Phrases as placed; what is in none is one by itself."""
    found = [
        _Phrase(onset=e.onset, end=e.end, position=e.position, sentence_type=e.sentence_type, tone=e.tone)
        for e in events
        if isinstance(e, Phrase)
    ]
    for utterance in utterances:
        if not any(each.onset < utterance.end and utterance.onset < each.end for each in found):
            found.append(
                _Phrase(
                    onset=utterance.onset, end=utterance.end,
                    position="internal" if utterance.closing == "continuing" else "final",
                    sentence_type="question" if utterance.closing == "question" else "statement",
                )
            )  # fmt: skip
    return sorted(found, key=lambda each: (each.onset, each.end))


def _silences(
    sounds: Sequence[Span], utterances: Sequence[Utterance], phrases: Sequence[_Phrase], events: Sequence[Event]
) -> tuple[Silence, ...]:
    """Gaps of `PAUSE` or more between one sound and the next."""
    breaths = [e for e in events if _breathes(e)]
    found = []
    for one, other in pairwise(sounds):
        length = snap(other.onset - one.end)  # on the grid: where in time a group is placed must not decide
        if length < PAUSE:
            continue
        ended = next(
            (each for each in reversed(phrases) if each.onset < one.end and each.end <= other.onset + NEAR), None
        )
        filled = any(e.onset < other.onset - NEAR and e.end > one.end + NEAR for e in breaths)
        inner = ended is None or ended.position == "internal"
        found.append(
            Silence(
                onset=one.end, end=other.onset, free=not any(u.onset < other.onset < u.end - 1e-9 and u.onset < one.end
                                                             for u in utterances),
                search=inner and not filled and length >= PROLONGED,
            )
        )  # fmt: skip
    return tuple(found)


def _breathes(event: Event) -> bool:
    """Whether a pause with this in it is one to breathe in."""
    if isinstance(event, Expiration):
        return event.kind != "speech"
    return isinstance(event, Inspiration) or (isinstance(event, Hold) and event.kind == "held")


def _questions(
    asking: Sequence[_Phrase], words: Sequence[tuple[Word, Utterance]], sounds: Sequence[Span]
) -> tuple[Question, ...]:
    """Last words of the questions that end in the group."""
    found = []
    spans = [_span(utterance, word, word.text) for word, utterance in words]  # on the grid, as phrases are
    for phrase in asking:
        said = [word for word in spans if phrase.onset <= word.onset < phrase.end]
        if phrase.asked and said:
            last = said[-1]
            until = next((sound.onset for sound in sounds if sound.onset >= last.end - 1e-6), None)
            found.append(Question(onset=last.onset, end=last.end, text=last.text, until=until))
    return tuple(found)
