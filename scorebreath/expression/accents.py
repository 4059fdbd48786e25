"""Accented syllables and pitch maxima of an utterance, on the Score's clock (A24)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from scorebreath.expression.intonation import LOW, extrema, syllable
from scorebreath.score.events import Phone, Utterance

LONELY = 0.5
"""s between an accented syllable and the maxima around it from which on it is one of its own."""


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
    turn: bool = True
    """whether the melody turns here; else an accented syllable far from any turn. S3's speech synthesis sets a target
    at every accent; other voices speak some of them on a level tone"""


def accents(utterance: Utterance) -> list[Span]:
    """The accented syllable of each accented word."""
    phones: dict[int, list[Phone]] = {}
    for phone in utterance.phones:
        if phone.word is not None and phone.ipa and utterance.words[phone.word].accent:
            phones.setdefault(phone.word, []).append(phone)
    found = []
    for word, own in phones.items():
        low, high = syllable(own)
        found.append(Span(onset=utterance.onset + low, end=utterance.onset + high, text=utterance.words[word].text))
    return sorted(found, key=lambda span: span.onset)


def peaks(utterance: Utterance) -> list[Peak]:
    """Maxima of its melody, and accented syllables that are far from any; ascending."""
    found = _turns(utterance)
    for accent in accents(utterance):
        if all(max(accent.onset - peak.time, peak.time - accent.end) > LONELY for peak in found):
            found.append(_level(utterance, accent))
    found.sort(key=lambda peak: peak.time)
    for number, (one, other) in enumerate(pairwise(found)):
        if not (one.turn and other.turn):
            middle = 0.5 * (one.time + other.time)
            found[number] = replace(found[number], after=min(one.after, middle))
            found[number + 1] = replace(other, before=max(other.before, middle))
    return found


def _level(utterance: Utterance, accent: Span) -> Peak:
    """An accented syllable that stands for a maximum."""
    hertz, step = np.asarray(utterance.pitch.hertz), utterance.pitch.step
    first, last = (int((time - utterance.onset) / step) for time in (accent.onset, accent.end))
    here, voiced = hertz[first : last + 1], hertz[hertz > 0]
    height = 0.0
    if (here > 0).any():
        height = max(0.0, 12.0 * float(np.log2(np.median(here[here > 0]) / np.percentile(voiced, LOW))))
    return Peak(
        before=utterance.onset, time=0.5 * (accent.onset + accent.end), after=utterance.end, semitones=height,
        syllable=accent.onset, text=accent.text, turn=False,
    )  # fmt: skip


def _turns(utterance: Utterance) -> list[Peak]:
    turns = extrema(utterance)
    found = []
    for number, turn in enumerate(turns):
        if turn.kind == "maximum":
            before = next((t.time for t in reversed(turns[:number]) if t.kind == "minimum"), 0.0)
            after = next((t.time for t in turns[number + 1 :] if t.kind == "minimum"), utterance.duration)
            found.append(
                Peak(
                    before=utterance.onset + before, time=utterance.onset + turn.time, after=utterance.onset + after,
                    semitones=turn.semitones, text="" if turn.word is None else utterance.words[turn.word].text,
                    syllable=None if turn.syllable is None else utterance.onset + turn.syllable[0],
                )
            )  # fmt: skip
    return found
