"""joe, a real Piper voice, against what a voice promises."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from scorebreath.errors import InputError
from scorebreath.signal.level import active_db
from scorebreath.speech.espeak.voice import EspeakVoice
from scorebreath.speech.piper import models
from scorebreath.speech.piper.voice import PiperVoice
from scorebreath.speech.voices import best_voice, open_voice
from tests.speech.neural import needs_joe
from tests.speech.speaking import check, mean_hertz, request

pytestmark = needs_joe

SENTENCE = "The old ferryman rowed slowly over the river, and the children waved to him from the bank."
TEXTS = (
    SENTENCE,
    "It was the end of the day, and of the road.",
    "No -- never: twenty-three! (Or so he said.) Well-known, isn't it?",
    '"Yes," he said. And so it was to be in the end…',
    "[[ə]] is no command; nor is ^$_ or {x}.",
    "Is it you?",
    "a",
)


@pytest.fixture(scope="module")
def joe() -> Iterator[PiperVoice]:
    with open_voice("joe", "en") as voice:
        assert isinstance(voice, PiperVoice)
        yield voice


@pytest.mark.parametrize("text", TEXTS)
def test_words_and_phones_fill_the_sound_exactly(joe: PiperVoice, text: str) -> None:
    speech = joe.speak(request(text))
    check(text, speech)
    assert sum(round(phone.duration * 1e6) for phone in speech.phones) == round(speech.duration * 1e6)


@pytest.mark.parametrize("text", TEXTS[:4])
def test_every_written_word_is_a_word_of_its_own(joe: PiperVoice, text: str) -> None:
    bare = [word.strip("\"'().,:;!?…") for word in text.replace("--", " ").split()]
    assert [word.text.strip("\"'().,:;!?…") for word in joe.speak(request(text)).words] == [one for one in bare if one]


def test_phones_are_those_of_the_table(joe: PiperVoice) -> None:
    ipa = [phone.ipa for phone in joe.speak(request(SENTENCE)).phones]
    assert ipa[:5] == ["ð", "ɪ", "oʊ", "l", "d"]
    assert "tʃ" in ipa
    assert "" in ipa  # the comma is heard
    assert not any(mark in phone for phone in ipa for mark in "ˈˌʲ ")


def test_what_says_nothing_is_a_short_pause(joe: PiperVoice) -> None:
    for text in ("...", " ", "–"):
        speech = joe.speak(request(text))
        assert [phone.ipa for phone in speech.phones] == [""]
        assert not speech.words


def test_equal_requests_give_equal_bytes_in_any_order_and_any_worker(joe: PiperVoice) -> None:
    several = [request(text) for text in TEXTS]
    first = [speech.samples for speech in joe.speak_all(several)]
    again = [joe.speak(one).samples for one in reversed(several)][::-1]
    with PiperVoice(models.find("joe")) as other:
        last = other.speak(several[0]).samples
    assert all(np.array_equal(one, two) for one, two in zip(first, again, strict=True))
    assert np.array_equal(first[0], last)


@pytest.mark.parametrize("rate", [0.5, 0.8, 1.25, 2.0])
def test_a_rate_is_met(joe: PiperVoice, rate: float) -> None:
    own, other = (joe.speak(request(SENTENCE, rate=one)).duration for one in (1.0, rate))
    assert own / other == pytest.approx(rate, rel=0.03)


@pytest.mark.parametrize("factor", [0.8, 1.25])
def test_a_pitch_is_met_and_the_length_stays(joe: PiperVoice, factor: float) -> None:
    own, other = joe.speak(request(SENTENCE)), joe.speak(request(SENTENCE, pitch=factor))
    assert len(own.samples) == len(other.samples)
    assert mean_hertz(other) / mean_hertz(own) == pytest.approx(factor, rel=0.04)


def test_the_sound_begins_and_ends_with_speech(joe: PiperVoice) -> None:
    speech = joe.speak(request(SENTENCE))
    peak = np.abs(speech.samples).max()
    for edge in (speech.samples[: speech.sample_rate // 50], speech.samples[-speech.sample_rate // 50 :]):
        assert np.abs(edge).max() > 0.0008 * peak


def test_groups_keep_their_loudness(joe: PiperVoice) -> None:
    levels = [active_db(speech.samples, speech.sample_rate) for speech in joe.speak_all(map(request, TEXTS[:4]))]
    assert max(levels) - min(levels) < 6.0
    assert joe.reference_db == pytest.approx(np.mean(levels), abs=4.0)


def test_syllables_are_those_of_espeak(joe: PiperVoice, english: EspeakVoice) -> None:
    words = ["ferryman", "idea", "the", "strengths"]
    assert joe.syllables(words) == english.syllables(words)


def test_its_details_tell_where_it_comes_from(joe: PiperVoice) -> None:
    details = joe.details
    assert details.voice == "piper:joe"
    assert details.language == "en"
    assert details.deterministic
    assert "CC0" in details.licence
    assert "lessac" in details.provenance


def test_best_is_joe_for_english_and_espeak_elsewhere() -> None:
    assert best_voice("en-GB") == "piper:joe"
    assert best_voice("de") == "espeak"
    with open_voice("best", "de") as voice:
        assert voice.details.voice == "espeak:de"


def test_a_copy_opens_by_its_path(tmp_path: Path, joe: PiperVoice) -> None:
    model = models.find("joe")
    for path in (model.path, model.config):
        (tmp_path / path.name).symlink_to(path)
    (tmp_path / "MODEL_CARD").write_text(
        "# Card\n* License: CC0\n* URL: https://example.org/x\n\n## Training\n\nFrom scratch.\n"
    )
    with open_voice(f"piper:{tmp_path / model.path.name}", "en") as voice:
        assert np.array_equal(voice.speak(request("Is it you?")).samples, joe.speak(request("Is it you?")).samples)
        assert voice.details.licence == "CC0"
        assert "From scratch" in voice.details.provenance


@pytest.mark.parametrize("broken", ["cut", "rubbish", "another"])
def test_a_broken_model_is_told_in_one_line(tmp_path: Path, broken: str) -> None:
    model = models.find("joe")
    whole = model.path.read_bytes()
    path = tmp_path / "bad.onnx"
    path.write_bytes({"cut": whole[: len(whole) // 2], "rubbish": b"RIFF" * 1000, "another": _other_model()}[broken])
    (tmp_path / "bad.onnx.json").write_bytes(model.config.read_bytes())
    with open_voice(f"piper:{path}", "en") as voice, pytest.raises(InputError, match=r"bad\.onnx") as caught:
        voice.speak(request("Is it you?"))
    assert "\n" not in str(caught.value)


def _other_model() -> bytes:
    import onnx

    node = onnx.helper.make_node("Identity", ["x"], ["y"])
    told = [onnx.helper.make_tensor_value_info(name, onnx.TensorProto.FLOAT, [1]) for name in "xy"]
    return bytes(onnx.helper.make_model(onnx.helper.make_graph([node], "g", told[:1], told[1:])).SerializeToString())
