"""Listening: words, pauses and breaths of recordings about which the truth is known."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from scorebreath.errors import InputError
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.score.document import Score
from scorebreath.score.events import Inspiration
from scorebreath.speech.recording import ears, warping
from scorebreath.speech.recording.listen import Listened, listen
from scorebreath.speech.recording.model import Take
from scorebreath.speech.recording.pronounce import Pronouncer
from scorebreath.speech.recording.sound import load_take
from scorebreath.speech.voices import open_voice
from tests.speech.neural import needs_joe
from tests.speech.takes import PASSAGE, errors, needs_sphinx, rendered, speech_of, take_of, truth, written

ROOT = Path(__file__).resolve().parents[2]
GERMAN = (ROOT / "examples" / "parallelen.txt").read_text(encoding="utf-8")


class Known(NamedTuple):
    """A recording, and the Score it was made from."""

    score: Score
    breathing: Take
    """with its breaths"""
    bare: Take
    """without"""


def known(folder: Path, name: str, language: str, text: str, p: Parameters) -> Known:
    media = MemoryStore()
    with open_voice(name, language) as voice:
        score = compile_text(text, voice=voice, media=media, language=language, parameters=p)
    rendered(score, media, folder / "take.wav")
    return Known(score, load_take(folder / "take.wav"), take_of(*speech_of(score, media)))


@pytest.fixture(scope="module")
def joe(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return known(tmp_path_factory.mktemp("joe"), "joe", "en", PASSAGE, Parameters())


@pytest.fixture(scope="module")
def german(tmp_path_factory: pytest.TempPathFactory) -> Known:
    p = Parameters(prosody_rate=1.15)
    return known(tmp_path_factory.mktemp("german"), "espeak:de+f3", "de", GERMAN, p)


@pytest.fixture(scope="module")
def heard(joe: Known) -> Listened:
    return listen(joe.breathing, written(PASSAGE), "en")


@needs_joe
@needs_sphinx
def test_english_words_are_found(joe: Known, heard: Listened) -> None:
    """Within 25 ms of the truth, by the median; no word is lost, and none doubted without cause."""
    told = written(PASSAGE)
    off = errors(list(heard.words), told, truth(joe.score))
    assert len(off) == len(told)
    assert np.median(np.abs(off[:, 0])) < 0.02
    assert np.quantile(np.abs(off[:, 0]), 0.9) < 0.06
    assert np.median(np.abs(off[:, 1])) < 0.03
    assert len(heard.mismatches) <= 1


@needs_joe
@needs_sphinx
def test_phones_fill_their_words(heard: Listened) -> None:
    for word in heard.words:
        assert word.phones[0].start == word.start
        assert word.phones[-1].end == word.end
        assert all(one.end == two.start for one, two in pairwise(word.phones))
        assert all(phone.end > phone.start for phone in word.phones)
    assert all(one.end <= two.start for one, two in pairwise(heard.words))
    ferryman = next(word for word in heard.words if word.text == "ferryman")
    assert "".join(phone.ipa for phone in ferryman.phones) in ("fɛɹɪmən", "fɛɹimən")
    assert [phone.stress for phone in ferryman.phones] == [0, 1, 0, 0, 0, 0, 0]


@needs_joe
@needs_sphinx
def test_breaths_are_found_where_they_are_and_nowhere_else(joe: Known, heard: Listened) -> None:
    drawn = [event for event in joe.score.of(Inspiration) if event.noise]
    found = [gap.breath for gap in heard.gaps if gap.breath]
    assert len(drawn) - 1 <= len(found) <= len(drawn)
    for breath in found:
        own = min(drawn, key=lambda event: abs(event.onset - breath.start))
        assert own.onset - 0.02 < breath.start < own.onset + 0.15
        assert own.end - 0.15 < breath.end < own.end + 0.02
    bare = listen(joe.bare, written(PASSAGE), "en")
    assert not [gap for gap in bare.gaps if gap.breath]


@needs_joe
@needs_sphinx
@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("wrote down", "wrote carefully down"), "carefully"),
        (("the lighthouse", "the"), "house"),
        (("children", "soldiers"), "soldiers"),
        (("rowed slowly", "rowed exceedingly slowly"), "exceedingly"),
    ],
)
def test_a_transcript_that_says_something_else_is_told(joe: Known, change: tuple[str, str], words: str) -> None:
    text = PASSAGE.replace(*change)
    found = listen(joe.bare, written(text), "en")
    ours = [one for one in found.mismatches if words in f"{one.written} {one.heard}"]
    assert ours, [str(one) for one in found.mismatches]
    written_and_heard = [word for word in found.words if word.word is not None]
    assert len(written_and_heard) > len(written(text)) - 5


@needs_joe
@needs_sphinx
def test_what_nobody_wrote_is_told_and_heard(joe: Known) -> None:
    """The transcript stops after the first sentence; the recording does not."""
    text = PASSAGE.partition(". ")[0] + "."
    found = listen(joe.bare, written(text), "en")
    (extra,) = [one for one in found.mismatches if one.kind == "extra" and len(one.heard.split()) > 20]
    assert "morning" in extra.heard
    unwritten = [word for word in found.words if word.word is None]
    assert len(unwritten) > 40
    assert unwritten[-1].end > joe.bare.duration - 3


@needs_joe
@needs_sphinx
@pytest.mark.parametrize("text", ["X.", "No, never."])
def test_a_word_or_two_are_no_transcript_of_a_speech(joe: Known, text: str) -> None:
    with pytest.raises(InputError, match="of the transcript"):
        listen(joe.bare, written(text), "en")


@needs_joe
@needs_sphinx
def test_a_transcript_of_something_else_is_refused(joe: Known) -> None:
    with pytest.raises(InputError, match="of the transcript"):
        listen(joe.bare, written("Curious green ideas sleep furiously. Buy two, and get one free! " * 5), "en")


@needs_joe
def test_english_words_are_found_without_a_recogniser(joe: Known) -> None:
    """Less exactly: another voice's formants are bent until they fit."""
    with Pronouncer("en") as say:
        found = warping.align(joe.bare, written(PASSAGE), say)
    off = errors(list(found.words), written(PASSAGE), truth(joe.score))
    assert np.median(np.abs(off[:, 0])) < 0.06


def test_german_words_are_found(german: Known) -> None:
    for take in (german.bare, german.breathing):
        found = listen(take, written(GERMAN, "de"), "de")
        off = errors(list(found.words), written(GERMAN, "de"), truth(german.score))
        assert len(off) == len(written(GERMAN, "de"))
        assert np.median(np.abs(off[:, 0])) < 0.025
        assert np.quantile(np.abs(off[:, 0]), 0.9) < 0.1


def test_a_recording_that_cannot_be_of_the_text_is_refused(german: Known) -> None:
    with Pronouncer("de") as say, pytest.raises(InputError, match="the transcript takes about"):
        warping.align(german.bare, written("Nein.", "de"), say)


def test_without_the_recogniser_that_is_said(german: Known, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pocketsphinx", None)
    text = "The old ferryman rowed slowly over the river."
    with open_voice("espeak:en+f2", "en") as voice:
        media = MemoryStore()
        score = compile_text(text, voice=voice, media=media)
    found = listen(take_of(*speech_of(score, media)), written(text), "en")
    assert "scorebreath[align]" in found.notes[0]
    assert found.by == warping.NAME
    assert np.median(np.abs(errors(list(found.words), written(text), truth(score))[:, 0])) < 0.03


@needs_joe
@needs_sphinx
def test_a_word_that_no_dictionary_has_is_said_by_rule(joe: Known) -> None:
    with Pronouncer("en") as say:
        listener = ears.Listener(joe.bare, say)
        (word,) = written("Zorblaxian")
        assert listener.known(word) == ["zorblaxian"]
        assert listener.sounds("zorblaxian")[0] == "Z"
