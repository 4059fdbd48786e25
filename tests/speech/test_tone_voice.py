"""The tone voice: everything about it can be worked out by hand."""

from __future__ import annotations

import hashlib
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.score.events import Closing
from scorebreath.signal.pitch import pitch_hertz
from scorebreath.speech.tone.letters import CONSONANTS, VOWELS, read
from scorebreath.speech.tone.sound import SAMPLE_RATE
from scorebreath.speech.tone.voice import ToneVoice
from tests.conftest import CheckGolden
from tests.speech.speaking import check, contour, ending, request

VOICE = ToneVoice()
CLOSINGS: tuple[Closing, ...] = ("final", "continuing", "question")


def test_phones_by_hand() -> None:
    """H 60, e 100, l 70, o 110 ms; a comma 150; m 70, y 90."""
    speech = VOICE.speak(request("Hello, my."))
    shown = [(phone.ipa, phone.onset, phone.duration, phone.stress, phone.word) for phone in speech.phones]
    assert shown == [
        ("h", 0.0, 0.06, 0, 0), ("e", 0.06, 0.1, 1, 0), ("l", 0.16, 0.07, 0, 0), ("o", 0.23, 0.11, 0, 0),
        ("", 0.34, 0.15, 0, None), ("m", 0.49, 0.07, 0, 1), ("y", 0.56, 0.09, 1, 1),
    ]  # fmt: skip
    assert [(word.text, word.source, word.onset) for word in speech.words] == [
        ("Hello", (0, 5), 0.0),
        ("my", (7, 9), 0.49),
    ]
    assert speech.duration == 0.65


def test_pitch_by_hand() -> None:
    """From 130 Hz on the first of 22 steps to 90 Hz on the last; r is voiced, t is not: its 16 steps have none."""
    hertz = VOICE.speak(request("at")).pitch.hertz
    line = [(13000 + -4000 * step // 37) / 100 for step in range(38)]
    assert list(hertz) == line[:22] + [0.0] * 16


def test_closures_are_silent() -> None:
    speech = VOICE.speak(request("atta"))
    stop = speech.phones[1]
    assert stop.ipa == "t"
    part = speech.samples[round(stop.onset * SAMPLE_RATE) : round((stop.onset + stop.duration) * SAMPLE_RATE)]
    assert np.flatnonzero(part)[0] == 10 * 80


def test_the_sound_has_the_pitch_it_says() -> None:
    speech = VOICE.speak(request("Anna"))
    found = pitch_hertz(speech.samples, SAMPLE_RATE)
    said = np.array(speech.pitch.hertz)
    inner = slice(8, -8)
    assert found[inner] == pytest.approx(said[inner], rel=0.02)


def test_closings_differ_in_their_ends() -> None:
    falls = {closing: ending(VOICE.speak(request("All the rain is gone", closing))) for closing in CLOSINGS}
    assert falls["final"] < -2
    assert -1.5 < falls["continuing"] < 0
    assert falls["question"] > 1


def test_rate_and_pitch() -> None:
    own = VOICE.speak(request("Moonlight"))
    assert VOICE.speak(request("Moonlight", rate=2.0)).duration == pytest.approx(own.duration / 2, rel=0.02)
    assert contour(VOICE.speak(request("Moonlight", pitch=1.5)))[1] == pytest.approx(1.5 * contour(own)[1], abs=0.01)


@pytest.mark.parametrize("text", ["", "...", "—!", "\x00 \n"])
def test_nothing_is_a_short_pause(text: str) -> None:
    speech = VOICE.speak(request(text))
    assert (len(speech.samples), speech.words, [phone.ipa for phone in speech.phones]) == (800, (), [""])


@given(
    st.text(st.characters(exclude_categories=()), max_size=30),
    st.sampled_from(CLOSINGS),
    st.floats(0.5, 2),
    st.floats(0.5, 2),
)
def test_any_text_keeps_the_contract(text: str, closing: Closing, rate: float, pitch: float) -> None:
    made = request(text, closing, rate=rate, pitch=pitch)
    speech = VOICE.speak(made)
    check(text, speech)
    assert speech.samples.tobytes() == VOICE.speak(made).samples.tobytes()
    if speech.words:
        assert len(speech.samples) - np.flatnonzero(speech.samples)[-1] < 160, "it ends within a turn of the tone"
        assert np.abs(speech.samples).max() < 0.5


@given(st.text(max_size=20))
def test_syllables_are_the_vowels_spoken(word: str) -> None:
    said = read(word)
    vowels = sum(sound.kind == "vowel" for one in said for sound in one.sounds)
    (count,) = VOICE.syllables([word])
    assert count >= (1 if any(character.isalpha() for character in word) else 0)
    if vowels and len(said) == 1:
        assert count == vowels


def test_every_letter_has_a_sound() -> None:
    assert set(VOWELS) | set(CONSONANTS) == set("abcdefghijklmnopqrstuvwxyz")
    for sound in (*VOWELS.values(), *CONSONANTS.values()):
        assert sound.steps > sound.closure
        assert (sound.closure > 0) == (sound.kind == "stop")
        assert (sound.colour > 0) == (sound.kind == "vowel")


def test_bytes_are_as_ever(golden: CheckGolden) -> None:
    texts = ("The quick brown fox jumps over the lazy dog: 1984, isn't it?", "Größe, 世界, привет.")
    made = {}
    for text in texts:
        for closing in CLOSINGS:
            speech = VOICE.speak(request(text, closing, rate=1.1, pitch=0.9))
            digest = hashlib.sha256((speech.samples * 32768).astype("<i2").tobytes()).hexdigest()
            phones = "".join(phone.ipa or "_" for phone in speech.phones)
            made[f"{closing}: {text}"] = [phones, len(speech.samples), digest]
    golden("speech/tone.json", json.dumps(made, ensure_ascii=False, indent=1, sort_keys=True).encode() + b"\n")


def test_reference_is_the_active_level() -> None:
    assert ToneVoice().reference_db == VOICE.reference_db
    assert -25 < VOICE.reference_db < -10
