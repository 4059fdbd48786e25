"""Melody and effort given afterwards: what was asked for is measured, nothing else moves, and off is off."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from statistics import median

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from scorebreath.equations.prosody import pressed_semitones
from scorebreath.media.store import MemoryStore, name_of
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.score.document import Score
from scorebreath.score.events import Utterance
from scorebreath.signal.level import active_db
from scorebreath.signal.pitch import limits_of, pitch_hertz
from scorebreath.signal.shelf import shelf
from scorebreath.speech.model import Speech, SpeechRequest, Voice
from scorebreath.speech.prosody.melody import Contour, Fall
from scorebreath.speech.prosody.shape import Manner, shape
from scorebreath.speech.voices import open_voice
from tests.speech.neural import needs_joe
from tests.speech.speaking import check, contour, mean_hertz, request

TEXTS = (
    "The old ferryman rowed slowly over the river while the children waved to him.",
    "Nobody in the harbour remembered when the lighthouse had last been painted.",
    "In the evening the rain came in from the west, and it stayed until the morning.",
    "She opened the window, listened to the bells, and wrote down what she had heard.",
    "A long line of lanterns moved along the wall towards the gate of the town.",
)
OFF = Parameters(vocal_effort=0.0, emotion_voice=0.0)


@pytest.fixture(scope="module", params=["espeak", pytest.param("joe", marks=needs_joe)])
def said(request: pytest.FixtureRequest) -> Iterator[list[Speech]]:
    from tests.speech.speaking import request as asked

    with open_voice(request.param, "en") as voice:
        yield list(voice.speak_all([asked(text) for text in TEXTS]))


def slope_of(speech: Speech) -> float:
    """st/s of the line through every voiced value, as anybody would measure it."""
    times, hertz = contour(speech)
    return float(np.polyfit(times, 12 * np.log2(hertz), 1)[0])


def mean_of(speech: Speech) -> float:
    """st, without what the tracker got wrong."""
    return Contour.of(speech).mean


def end_of(speech: Speech) -> float:
    """st of the last quarter of a second, without what the tracker got wrong."""
    known = Contour.of(speech)
    return float(known.semitones[known.times > known.times[-1] - 0.25].mean())


def bright(speech: Speech) -> float:
    """dB of what is above 1 kHz, relative to all."""
    power = np.square(np.abs(np.fft.rfft(speech.samples.astype(np.float64))))
    above = np.fft.rfftfreq(len(speech.samples), 1 / speech.sample_rate) > 1000
    return float(10 * np.log10(power[above].sum() / power.sum()))


@pytest.mark.parametrize("asked", [-1.0, -2.0, -0.01, 1.5])
def test_a_declination_is_heard_as_it_is_asked_for(said: list[Speech], asked: float) -> None:
    made = [shape([one], [Manner(slope=asked)])[0].speech for one in said]
    found = [slope_of(one) for one in made]
    assert median(found) == pytest.approx(asked, rel=0.1, abs=0.1)
    assert all(slope == pytest.approx(asked, rel=0.3, abs=0.15) for slope in found)
    assert max(abs(slope_of(one) - asked) for one in said) > 0.3, "they have had it already"


def test_no_time_moves(said: list[Speech]) -> None:
    for text, one in zip(TEXTS, said, strict=True):
        made = shape([one], [Manner(slope=-2.0, ending=-2.0, range=1.3, louder=6.0)])[0].speech
        check(text, made)
        assert len(made.samples) == len(one.samples)
        assert (made.words, made.phones) == (one.words, one.phones)
        levels = [np.maximum(np.array(speech.level.db), -60) for speech in (one, made)]
        assert np.corrcoef(*levels)[0, 1] > 0.95


def test_the_mean_stays_and_the_pitch_is_measured_again(said: list[Speech]) -> None:
    for one in said:
        made = shape([one], [Manner(slope=-2.0)])[0].speech
        assert mean_of(made) == pytest.approx(mean_of(one), abs=0.5)
        assert made.pitch != one.pitch
        low, high = limits_of(np.array(made.pitch.hertz))
        again = pitch_hertz(made.samples, made.sample_rate, made.pitch.step, low, high)
        both = (again > 0) & (np.array(made.pitch.hertz) > 0)
        assert both.sum() > 0.9 * (again > 0).sum()
        assert np.median(np.abs(again[both] / np.array(made.pitch.hertz)[both] - 1)) < 0.005


def test_longer_is_flatter(said: list[Speech]) -> None:
    """'t Hart: -11 / (T + 1.5)."""
    made = [shape([one], [Manner(by_length=0.6)])[0].speech for one in said]
    assert median(slope_of(one) * (one.duration + 1.5) for one in made) == pytest.approx(-0.6 * 11, rel=0.2)


def test_nothing_asked_is_nothing_done(said: list[Speech]) -> None:
    for one in said:
        assert shape([one], [Manner()])[0].speech is one
    several = shape(said[:2], [Manner(), Manner(louder=3.0)])
    assert several[0].speech is said[0]
    assert several[1].speech is not said[1]


def test_a_part_that_goes_on_begins_lower_and_a_paragraph_higher(said: list[Speech]) -> None:
    def means(manner: Manner) -> list[float]:
        made = shape([said[0], said[0]], [manner, manner])
        return [12 * np.log2(mean_hertz(one.speech) / mean_hertz(said[0])) for one in made]

    first, second = means(Manner(slope=-1.0, reset=0.5))
    assert first - second == pytest.approx(0.5 * said[0].duration, rel=0.3)
    assert first + second == pytest.approx(0, abs=0.4)
    whole = means(Manner(slope=-1.0, reset=1.0))
    assert whole[0] == pytest.approx(whole[1], abs=0.3)
    lifted = means(Manner(slope=-1.0, reset=1.0, lift=0.2))
    assert lifted[0] - whole[0] == pytest.approx(0.2 * said[0].duration, rel=0.4)


def test_endings_fall_and_rise(english: Voice) -> None:
    """Of espeak: joe's last syllables creak, so that there is little pitch left to measure."""
    said = [english.speak(request(text)) for text in TEXTS]
    for semitones in (-2.0, 4.0):
        moved = [end_of(shape([one], [Manner(ending=semitones)])[0].speech) - end_of(one) for one in said]
        assert 0.2 < median(moved) / semitones < 1


def test_a_range_is_wider_or_narrower(said: list[Speech]) -> None:
    for factor in (0.6, 1.4):
        spread = [np.std(12 * np.log2(contour(one)[1])) for one in said]
        made = [np.std(12 * np.log2(contour(shape([one], [Manner(range=factor)])[0].speech)[1])) for one in said]
        ratios = [after / before for after, before in zip(made, spread, strict=True)]
        assert (median(ratios) - 1) * (factor - 1) > 0.04


@pytest.mark.parametrize("louder", [-8.0, 8.0])
def test_effort_colours_and_presses_but_does_not_amplify(said: list[Speech], louder: float) -> None:
    for one in said:
        found = shape([one], [Manner(louder=louder)])[0]
        assert active_db(found.speech.samples, one.sample_rate) + found.gain_db == pytest.approx(
            active_db(one.samples, one.sample_rate), abs=0.2
        )
        assert (bright(found.speech) - bright(one)) * np.sign(louder) > 1
        wanted = pressed_semitones(louder, "male", mean_hertz(one), 4.0)
        heard = 12 * np.log2(mean_hertz(found.speech) / mean_hertz(one))
        assert heard == pytest.approx(max(-6, min(6, wanted)), abs=0.7)
    unpressed = shape([said[0]], [Manner(louder=louder, per_pressure=0.0)])[0].speech
    assert mean_hertz(unpressed) == pytest.approx(mean_hertz(said[0]), rel=0.001)


def test_what_cannot_be_sung_stays() -> None:
    with open_voice("espeak", "en") as voice:
        for text in ("...", "Psst.", "a"):
            speech = voice.speak(request(text))
            check(text, shape([speech], [Manner(slope=-2.0, range=1.5, ending=-3.0, louder=4.0)])[0].speech)


@example(pauses=[0.65625, 1.81640625, 1.0], reset=1.0, eased=False)
@given(
    pauses=st.lists(st.floats(0.3, 2.0), min_size=1, max_size=4),
    reset=st.floats(0, 1.5),
    eased=st.booleans(),
)
def test_a_fall_falls_between_edges_and_comes_back_at_them(pauses: list[float], reset: float, eased: bool) -> None:
    with_pauses = _with_pauses(pauses)
    fall = Fall.of(with_pauses, reset, eased=eased)
    steps = np.diff(fall.values)
    at = np.diff(fall.corners) > 0
    assert np.all(steps[at] <= 1e-12)
    for place in np.flatnonzero(~at):
        assert fall.values[place + 1] == pytest.approx(fall.values[place] * (1 - reset), abs=1e-9)
    assert fall.corners[0] == fall.values[0] == 0
    if reset == 0:
        assert fall.end == pytest.approx(-with_pauses.duration)


def _with_pauses(lengths: Sequence[float]) -> Speech:
    from scorebreath.speech.assemble import FramedPhone, SpokenWord, speech

    rate, phones, at = 1000, [], 0
    for index, length in enumerate(lengths):
        phones.append(FramedPhone(ipa="a", start=at, word=index))
        at += round(length * rate)
        if index < len(lengths) - 1:
            phones.append(FramedPhone(ipa="", start=at))
            at += 200
    words = [SpokenWord(text="a", source=None) for _ in lengths]
    return speech(samples=np.zeros(at, np.float32), sample_rate=rate, phones=phones, words=words, hertz=())


@given(gain=st.floats(-12, 12), corner=st.sampled_from([500.0, 1000.0]))
def test_a_shelf_has_half_its_gain_at_the_corner_and_no_delay(gain: float, corner: float) -> None:
    rate, count = 22050, 8192
    pulse = np.zeros(count, dtype=np.float32)
    pulse[count // 2] = 0.5
    made = shelf(pulse, rate, gain, corner)
    assert len(made) == count
    assert int(np.argmax(np.abs(made))) == count // 2
    found = 20 * np.log10(np.abs(np.fft.rfft(made.astype(np.float64))) / 0.5)
    at = np.fft.rfftfreq(count, 1 / rate)
    for place, wanted in ((corner, gain / 2), (30.0, 0.0), (10_500.0, gain)):
        assert np.interp(place, at, found) == pytest.approx(wanted, abs=0.25)


# From a text


def compiled(voice: Voice, text: str, p: Parameters, model: str = "natural") -> tuple[Score, MemoryStore]:
    media = MemoryStore()
    return compile_text(text, voice=voice, media=media, parameters=p, model=model, tail=0.1), media


def speeches(voice: Voice, text: str, p: Parameters, model: str = "natural") -> list[Utterance]:
    return list(compiled(voice, text, p, model)[0].of(Utterance))


MOVED = "This is so wonderful! :-) I can not believe that they came back to us today! :-)"


@pytest.mark.parametrize(
    ("text", "p"),
    [
        (MOVED, OFF),
        (MOVED, OFF.with_values({"speaking_loudness": 200.0})),
        (MOVED.replace(" :-)", ""), Parameters()),
        ("Did they come back? They did.", Parameters()),
    ],
)
def test_off_is_what_the_voice_says_bit_for_bit(
    english: Voice, text: str, p: Parameters, monkeypatch: pytest.MonkeyPatch
) -> None:
    said: list[str] = []
    speak_all = english.speak_all

    def overheard(requests: Iterable[SpeechRequest]) -> Iterator[Speech]:
        for speech in speak_all(requests):
            said.append(name_of(speech.samples))
            yield speech

    monkeypatch.setattr(english, "speak_all", overheard)
    assert [event.media for event in speeches(english, text, p)] == said


def test_emotions_move_pitch_rate_and_effort(english: Voice) -> None:
    def told(sign: str) -> tuple[float, float, float]:
        found = speeches(english, f"They came back to us today {sign}.", Parameters(emotion_voice=1.0))
        (one,) = found
        hertz = np.array([value for value in one.pitch.hertz if value])
        return float(12 * np.log2(hertz).mean()), one.duration, one.gain_db

    plain, happy, sad, afraid = (told(sign) for sign in ("", ":-)", ":-(", "[emotion afraid]"))
    assert happy[0] - plain[0] == pytest.approx(2.5, abs=1.5)
    assert sad[0] < plain[0] - 0.8
    assert sad[1] > 1.1 * plain[1]
    assert afraid[1] < 0.92 * plain[1]
    assert plain[2] == 0
    assert happy[2] == pytest.approx(2, abs=0.1)
    assert sad[2] == pytest.approx(-4, abs=0.1)


def test_the_papers_models_leave_the_voice_alone(english: Voice) -> None:
    for model in ("bernardet-2017", "bernardet-2019"):
        loud = Parameters(speaking_loudness=200.0, norm_syllables=30.0)
        off = loud.with_values({"vocal_effort": 0.0, "emotion_voice": 0.0})
        one, two = (speeches(english, MOVED, p, model) for p in (loud, off))
        assert [event.media for event in one] == [event.media for event in two]
        assert speeches(english, MOVED, loud.with_values({"declination": -2.0}), model)[0].media != one[0].media


def test_only_questions_for_yes_or_no_rise(english: Voice) -> None:
    p = OFF.with_values({"question_rise": 4.0})
    for text, rises in (
        ("Did they come back to us?", True),
        ("Why did they come back to us?", False),
        ("They did.", False),
    ):
        one, two = (speeches(english, text, which)[0] for which in (OFF, p))
        assert (one.media != two.media) == rises, text
    lowered = OFF.with_values({"final_lowering": 2.0})
    for text, falls in (
        ("Did they come back to us?", False),
        ("Why did they come back to us?", True),
        ("They did.", True),
    ):
        one, two = (speeches(english, text, which)[0] for which in (OFF, lowered))
        assert (one.media != two.media) == falls, text


def test_louder_is_brighter_and_higher_unless_it_is_not_wanted(english: Voice) -> None:
    text = "They came back to us today."
    plain, loud, gain = (
        speeches(english, text, p)[0]
        for p in (
            Parameters(),
            Parameters(speaking_loudness=200.0),
            Parameters(speaking_loudness=200.0, vocal_effort=0.0),
        )
    )
    assert plain.media == gain.media
    assert gain.gain_db == pytest.approx(6.02, abs=0.01)
    assert loud.media != plain.media
    means = [np.log2([value for value in one.pitch.hertz if value]).mean() for one in (plain, loud)]
    assert 12 * (means[1] - means[0]) == pytest.approx(2.2, abs=0.8)
    marked = speeches(
        english, '<speak>They came back <prosody volume="+6dB">to us today</prosody>.</speak>', Parameters()
    )
    assert [round(one.gain_db) for one in marked] == [0, 6]
