"""Accented syllables and pitch maxima of an utterance, on the Score's clock (A24)."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.expression.intonation import extrema, syllable
from scorebreath.score.events import Phone, Utterance
from scorebreath.units import snap


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """A stretch of time; seconds from the Score's start."""

    onset: float
    end: float
    text: str = ""
    """the word or words"""

    def __contains__(self, time: float) -> bool:
        """Whether a time lies within, its end left out."""
        return self.onset <= time < self.end


@dataclass(frozen=True, slots=True, kw_only=True)
class Peak:
    """A pitch maximum, between the two minima around it."""

    before: float
    time: float
    after: float
    semitones: float
    """above the voice's low tone"""
    syllable: float | None
    """onset of its accented syllable"""
    text: str
    level: bool = False
    """whether the melody does not turn here: an accent on a level tone"""

    @property
    def why(self) -> str:
        """What an event says of it."""
        on = f" on {self.text!r}" if self.text else ""
        return f"{self.semitones:.1f} st{on}{', a level accent' if self.level else ''}"


def accents(utterance: Utterance) -> list[Span]:
    """The accented syllable of each accented word."""
    phones: dict[int, list[Phone]] = {}
    for phone in utterance.phones:
        if phone.word is not None and phone.ipa and utterance.words[phone.word].accent:
            phones.setdefault(phone.word, []).append(phone)
    found = []
    for word, own in phones.items():
        low, high = syllable(own)
        found.append(
            Span(onset=snap(utterance.onset + low), end=snap(utterance.onset + high), text=utterance.words[word].text)
        )
    return sorted(found, key=lambda span: span.onset)


def peaks(utterance: Utterance) -> list[Peak]:
    """Maxima of its melody, each between its minima; ascending."""
    turns = extrema(utterance)
    found = []
    for number, turn in enumerate(turns):
        if turn.kind == "maximum":
            before = next((t.time for t in reversed(turns[:number]) if t.kind == "minimum"), 0.0)
            after = next((t.time for t in turns[number + 1 :] if t.kind == "minimum"), utterance.duration)
            found.append(
                Peak(
                    before=snap(utterance.onset + before), time=snap(utterance.onset + turn.time),
                    after=snap(utterance.onset + after),
                    semitones=turn.semitones, text="" if turn.word is None else utterance.words[turn.word].text,
                    syllable=None if turn.syllable is None else snap(utterance.onset + turn.syllable[0]),
                    level=turn.level,
                )
            )  # fmt: skip
    return found
