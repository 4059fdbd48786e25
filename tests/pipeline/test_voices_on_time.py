"""The same script by every kind of voice: words where the Score says, as somebody hears who knows nothing of it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.recorded import compile_recording
from scorebreath.score.document import Score
from scorebreath.score.events import Utterance
from scorebreath.speech.recording import ears
from scorebreath.speech.recording.pronounce import Pronouncer
from scorebreath.speech.voices import open_voice
from tests.speech.neural import needs_joe
from tests.speech.takes import PASSAGE, needs_sphinx, speech_of, take_of, truth, written

MEDIAN = 0.025
"""s"""
ROOM = 0.2
"""s of silence around what is judged"""


def judged(score: Score, media: MemoryStore) -> float:
    """Median of how far words are from where PocketSphinx hears them, s: each utterance by itself."""
    told, off = {word.source.start: word for word in written(PASSAGE)}, []
    with Pronouncer("en") as say:
        for event in score.of(Utterance):
            sound = media.get(event.media)
            room = np.zeros(round(ROOM * sound.sample_rate), dtype=np.float32)
            samples = np.concatenate((room, sound.samples, room))
            listener = ears.Listener(take_of(samples, sound.sample_rate), say)
            first, last = event.words[0].source, event.words[-1].source
            assert first is not None and last is not None
            own = [word for start, word in told.items() if first[0] <= start < last[1]]
            said = [ears.Said(text=text, word=word.source.start) for word in own for text in listener.known(word)]
            heard = {
                one.said.word: one.start - ROOM
                for one in reversed(listener.lay(said, 0.0, len(samples) / sound.sample_rate))
            }
            off += [word.onset - heard[word.source[0]] for word in event.words if word.source]
    assert len(off) > 0.9 * len(told)
    return float(np.median(np.abs(off)))


def check_phones(score: Score, media: MemoryStore) -> None:
    """Phones fill each sound to the sample."""
    for event in score.of(Utterance):
        sound = media.get(event.media)
        frames, rate = len(sound.samples), sound.sample_rate
        assert event.phones[0].onset == 0
        assert all(round((a.onset + a.duration - b.onset) * 1e6) == 0 for a, b in pairwise(event.phones))
        last = event.phones[-1]
        assert round((last.onset + last.duration) * rate) == frames
        assert sum(round(phone.duration * 1e6) for phone in event.phones) == round(frames / rate * 1e6)


@needs_sphinx
@pytest.mark.parametrize("name", ["espeak", "espeak:en-us+f3", pytest.param("joe", marks=needs_joe)])
@pytest.mark.parametrize("p", [Parameters(), Parameters(declination=-2.0, prosody_rate=1.1)], ids=["plain", "shaped"])
def test_words_are_heard_where_the_score_has_them(name: str, p: Parameters) -> None:
    media = MemoryStore()
    with open_voice(name, "en") as voice:
        score = compile_text(PASSAGE, voice=voice, media=media, parameters=p)
    check_phones(score, media)
    assert judged(score, media) < MEDIAN


@needs_joe
@needs_sphinx
def test_a_recording_of_joe_has_joe_s_own_times() -> None:
    """Judged twice: by who was there, and by PocketSphinx hearing the Score's own sound."""
    spoken, media = MemoryStore(), MemoryStore()
    with open_voice("joe", "en") as voice:
        known = compile_text(PASSAGE, voice=voice, media=spoken)
    made = compile_recording(take_of(*speech_of(known, spoken)), PASSAGE, media=media)
    check_phones(made.score, media)
    assert judged(made.score, media) < MEDIAN
    was, now = truth(known), truth(made.score)
    assert len(was.keys() & now.keys()) > 0.9 * len(was)
    off = [now[place][0] - made.offset - was[place][0] for place in was.keys() & now.keys()]
    assert np.median(np.abs(off)) < MEDIAN
