"""Requests, and what must hold for every `Speech`."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.score.events import Closing
from scorebreath.signal.level import step_edges
from scorebreath.spans import Span, join
from scorebreath.speech.model import Speech, SpeechRequest


def request(text: str, closing: Closing = "final", **more: Any) -> SpeechRequest:
    """A request in which source and spoken text are the same."""
    return SpeechRequest(text=join([(text, Span(0, len(text)))]), closing=closing, **more)


def steps(seconds: float) -> int:
    """On the grid of the Score."""
    return round(seconds * 1_000_000)


def check(text: str, speech: Speech) -> None:
    """What the contract promises."""
    frames, rate = len(speech.samples), speech.sample_rate
    assert speech.samples.dtype == np.float32
    assert np.abs(speech.samples).max() <= 1
    assert speech.phones[0].onset == 0
    for before, after in pairwise(speech.phones):
        assert steps(before.onset) + steps(before.duration) == steps(after.onset)
        assert before.ipa or after.ipa, "two pauses in a row"
    assert steps(speech.phones[-1].onset) + steps(speech.phones[-1].duration) == steps(frames / rate)
    assert all(phone.duration > 0 for phone in speech.phones)
    assert all((phone.word is not None) == bool(phone.ipa) for phone in speech.phones)
    owners = [phone.word for phone in speech.phones if phone.word is not None]
    assert owners == sorted(owners)
    assert set(owners) == set(range(len(speech.words)))
    at = 0
    for index, word in enumerate(speech.words):
        own = [phone for phone in speech.phones if phone.word == index]
        assert own[0].onset == word.onset
        assert steps(own[-1].onset) + steps(own[-1].duration) == steps(word.onset) + steps(word.duration)
        if word.source is not None:
            assert at <= word.source[0] < word.source[1]
            assert text[slice(*word.source)] == word.text
            at = word.source[1]
    assert len(speech.pitch.hertz) == len(step_edges(frames, rate, speech.pitch.step)) - 1
    assert len(speech.level.db) == len(step_edges(frames, rate, speech.level.step)) - 1


def contour(speech: Speech) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times and pitches of the voiced steps."""
    hertz: NDArray[np.float64] = np.array(speech.pitch.hertz, dtype=np.float64)
    times = np.asarray((np.arange(len(hertz)) + 0.5) * speech.pitch.step, dtype=np.float64)
    return times[hertz > 0], hertz[hertz > 0]


def mean_hertz(speech: Speech) -> float:
    """Geometric mean of the pitch."""
    return float(np.exp(np.log(contour(speech)[1]).mean()))


def ending(speech: Speech, seconds: float = 0.25) -> float:
    """Semitones by which the last part lies above the mean."""
    times, hertz = contour(speech)
    last = hertz[times > speech.duration - seconds]
    return float(12 * (np.log2(last).mean() - np.log2(hertz).mean()))
