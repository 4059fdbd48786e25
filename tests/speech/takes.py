"""Recordings for tests: made from a Score, so that the truth about them is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scorebreath.engine.offline import render
from scorebreath.media.store import MediaStore
from scorebreath.recorded import transcript
from scorebreath.score.document import Score
from scorebreath.score.events import Utterance, Word
from scorebreath.script.reader import read
from scorebreath.speech.recording.model import HeardWord, Take, Written

try:
    import pocketsphinx
except ImportError:
    pocketsphinx = None

needs_sphinx = pytest.mark.skipif(
    pocketsphinx is None, reason="the extra align is not installed: pip install 'scorebreath[align]'"
)

PASSAGE = (
    "The old ferryman rowed slowly over the river, while the children waved to him from the bank. "
    "Nobody in the harbour remembered when the lighthouse had last been painted. In the evening the rain came in from "
    "the west, and it stayed until the morning. She opened the window, listened to the bells, and wrote down what she "
    "had heard. A long line of lanterns moved along the wall, towards the gate of the town."
)


def speech_of(score: Score, media: MediaStore, silence: float = 0.0) -> tuple[NDArray[np.float32], int]:
    """What is said in a Score, where it is said, nothing else."""
    rate = score.bodies[0].voice.sample_rate
    out = np.zeros(round((score.duration + silence) * rate), dtype=np.float32)
    for event in score.of(Utterance):
        samples = media.get(event.media).samples
        first = round(event.onset * rate)
        out[first : first + len(samples)] += samples
    return out, rate


def rendered(score: Score, media: MediaStore, path: Path) -> None:
    """The whole sound of a Score."""
    with path.open("wb") as stream:
        render(score, media, stream)


def take_of(samples: NDArray[np.float32], rate: int, path: Path = Path("take.wav")) -> Take:
    """A take that nobody has to read."""
    return Take(path=path, samples=samples, sample_rate=rate, notes=())


def written(text: str, language: str = "en") -> list[Written]:
    """The words of a text."""
    return transcript(read(text, language=language))


def truth(score: Score) -> dict[int, tuple[float, float]]:
    """Onset and end of each word, s, by where it stands in the text."""
    words: list[tuple[Utterance, Word]] = [(event, word) for event in score.of(Utterance) for word in event.words]
    return {
        word.source[0]: (event.onset + word.onset, event.onset + word.onset + word.duration)
        for event, word in words
        if word.source is not None
    }


def errors(heard: list[HeardWord], told: list[Written], known: dict[int, tuple[float, float]]) -> NDArray[np.float64]:
    """(n, 2) s by which onsets and ends are late."""
    found = [
        (word.start - known[start][0], word.end - known[start][1])
        for word in heard
        if word.word is not None and (start := told[word.word].source.start) in known
    ]
    return np.array(found)


def save(path: Path, samples: NDArray[np.float32], rate: int, subtype: str = "PCM_16") -> Path:
    """A sound file."""
    soundfile.write(path, samples, rate, subtype=subtype)
    return path
