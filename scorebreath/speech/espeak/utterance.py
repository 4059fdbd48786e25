"""From a worker's answer to `Speech`: whose phones are whose."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scorebreath.spans import SpokenText
from scorebreath.speech.assemble import FramedPhone, SpokenWord, silence, speech
from scorebreath.speech.espeak.library import SAMPLE_RATE, WORD, Event
from scorebreath.speech.espeak.phones import pieces
from scorebreath.speech.espeak.text import ENDINGS, OPENINGS, Said
from scorebreath.speech.espeak.words import words
from scorebreath.speech.model import Speech
from scorebreath.speech.worker import Answer

FULL_SCALE = 32768
HUNDREDTHS = 100
"""Pitch comes in hundredths of a Hz."""


def samples_of(answer: Answer) -> NDArray[np.float32]:
    """The sound in an answer, full scale 1."""
    sound = np.frombuffer(answer.payload, dtype=np.int16, count=answer.fields["frames"])
    return np.asarray(sound / np.float32(FULL_SCALE), dtype=np.float32)


def utterance(text: SpokenText, said: Said, answer: Answer) -> Speech:
    """The speech in an answer; a short silence when there is none.

    Args:
        text: As asked for.
        said: As given to the library.
        answer: The worker's: `frames`, `events`, and the samples and pitch as payload.
    """
    samples = samples_of(answer)
    events = [Event(*event) for event in answer.fields["events"]]
    found = pieces(events, samples, SAMPLE_RATE) if samples.size else ()
    if not found:
        return silence(SAMPLE_RATE)
    announced = [event for event in events if event.type == WORD]
    heard = sorted({piece.event for piece in found if piece.event is not None and piece.event < len(announced)})
    spoken = words(said.text, [announced[index] for index in heard])
    owner = {heard[event]: index for index, word in enumerate(spoken) for event in word.events}
    return speech(
        samples=samples,
        sample_rate=SAMPLE_RATE,
        phones=[
            FramedPhone(ipa=ipa, start=start, stress=stress, word=None if event is None else owner.get(event))
            for ipa, start, stress, event, _ in found
        ],
        words=[written(text, said, word.start, word.end, merged=word.merged) for word in spoken],
        hertz=(np.frombuffer(answer.payload, dtype=np.int32, offset=2 * samples.size) / HUNDREDTHS).tolist(),
    )


def written(text: SpokenText, said: Said, start: int, end: int, *, merged: bool) -> SpokenWord:
    """A word with its place in the source, without the marks around it.

    Args:
        text: As asked for.
        said: As given to the voice.
        start: Of the word, in that.
        end: Of the word.
        merged: Whether it holds more than one written word.
    """
    start, end = said.span(start, end)
    while end - start > 1 and text.text[end - 1] in ENDINGS:
        end -= 1
    while end - start > 1 and text.text[start] in OPENINGS:
        start += 1
    source = text.source(start, end)
    return SpokenWord(
        text=text.text[start:end], source=None if source is None else (source.start, source.end), merged=merged
    )
