"""From frames to a `Speech`: the time grid, words around their phones, level; and the sound of nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scorebreath.score.events import Level, Phone, Pitch, Word
from scorebreath.signal.level import STEP as LEVEL_STEP
from scorebreath.signal.level import level_db
from scorebreath.signal.pitch import STEP as PITCH_STEP
from scorebreath.speech.model import Speech
from scorebreath.units import GRID

SILENCE = 0.05
"""s; what is given for a text that says nothing: one pause, so that whoever places it need not ask"""


@dataclass(frozen=True, slots=True, kw_only=True)
class FramedPhone:
    """A phone that lasts until the next one starts."""

    ipa: str
    """empty for a pause"""
    start: int
    """frame"""
    stress: int = 0
    word: int | None = None
    """index among the words; None for a pause"""


@dataclass(frozen=True, slots=True, kw_only=True)
class SpokenWord:
    """A word without its times: those are its phones'."""

    text: str
    source: tuple[int, int] | None
    merged: bool = False


def speech(
    *,
    samples: NDArray[np.float32],
    sample_rate: int,
    phones: Sequence[FramedPhone],
    words: Sequence[SpokenWord],
    hertz: Sequence[float],
) -> Speech:
    """Put a `Speech` together.

    Args:
        samples: (n,) within -1..1, n > 0.
        sample_rate: Hz.
        phones: Ascending starts, the first 0; the last one lasts until n. Each word has at least one phone.
        words: In the order of their phones.
        hertz: One value each `PITCH_STEP`, the first at half a step; 0 where unvoiced.

    Returns:
        Times on the 1e-6 grid: phones contiguous from 0 to the duration; a word from its first phone's onset to the
        end of its last.
    """
    edges = [grid_steps(phone.start, sample_rate) for phone in phones] + [grid_steps(len(samples), sample_rate)]
    spans: list[tuple[int, int] | None] = [None] * len(words)
    for index, phone in enumerate(phones):
        if phone.word is not None:
            known = spans[phone.word]
            spans[phone.word] = (known[0] if known else edges[index], edges[index + 1])
    return Speech(
        samples=samples,
        sample_rate=sample_rate,
        words=tuple(_word(word, span) for word, span in zip(words, spans, strict=True) if span is not None),
        phones=tuple(
            Phone(
                ipa=phone.ipa,
                onset=edges[index] / GRID,
                duration=(edges[index + 1] - edges[index]) / GRID,
                stress=phone.stress,
                word=phone.word,
            )
            for index, phone in enumerate(phones)
        ),
        pitch=Pitch(step=PITCH_STEP, hertz=tuple(hertz)),
        level=Level(step=LEVEL_STEP, db=tuple(level_db(samples, sample_rate).tolist())),
    )


def silence(sample_rate: int) -> Speech:
    """What a voice gives for a text in which there is nothing to say."""
    samples: NDArray[np.float32] = np.zeros(round(SILENCE * sample_rate), dtype=np.float32)
    pitch = (0.0,) * round(SILENCE / PITCH_STEP)
    phones = (FramedPhone(ipa="", start=0),)
    return speech(samples=samples, sample_rate=sample_rate, phones=phones, words=(), hertz=pitch)


def grid_steps(frame: int, sample_rate: int) -> int:
    """Microseconds at a frame, rounded to the nearest, in whole numbers.

    >>> grid_steps(1, 22050)
    45
    """
    return (2 * frame * GRID + sample_rate) // (2 * sample_rate)


def _word(word: SpokenWord, span: tuple[int, int]) -> Word:
    return Word(
        text=word.text,
        onset=span[0] / GRID,
        duration=(span[1] - span[0]) / GRID,
        source=word.source,
        merged=word.merged,
    )
