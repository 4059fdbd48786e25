"""A recording made into a Score: its speech stays where it was said, and the body breathes where it is silent."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.errors import InputError
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.recorded import Recorded, compile_recording
from scorebreath.score import codec
from scorebreath.score.document import Score
from scorebreath.score.events import Hold, Inspiration, Pause, Utterance
from scorebreath.speech.recording.model import Take
from scorebreath.speech.recording.sound import load_take
from scorebreath.speech.voices import open_voice
from tests.speech.takes import rendered, speech_of, take_of

ROOT = Path(__file__).resolve().parents[2]
GERMAN = (ROOT / "examples" / "parallelen.txt").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def original() -> tuple[Score, MemoryStore]:
    media = MemoryStore()
    with open_voice("espeak:de+f3", "de") as voice:
        return compile_text(GERMAN, voice=voice, media=media, language="de"), media


@pytest.fixture(scope="module")
def bare(original: tuple[Score, MemoryStore]) -> Take:
    return take_of(*speech_of(*original, silence=0.5))


@pytest.fixture(scope="module")
def breathing(original: tuple[Score, MemoryStore], tmp_path_factory: pytest.TempPathFactory) -> Take:
    path = tmp_path_factory.mktemp("take") / "take.wav"
    rendered(*original, path)
    return load_take(path)


def recorded(take: Take, media: MemoryStore | None = None, **options: object) -> Recorded:
    return compile_recording(take, GERMAN, media=media or MemoryStore(), language="de", **options)  # type: ignore[arg-type]


def onsets(score: Score) -> dict[int, float]:
    return {
        word.source[0]: event.onset + word.onset for event in score.of(Utterance) for word in event.words if word.source
    }


def check(made: Recorded, take: Take, media: MemoryStore) -> None:
    """What holds for every recording."""
    speeches = sorted(made.score.of(Utterance), key=lambda event: event.onset)
    for event in speeches:
        info = made.score.media[event.media]
        assert sum(round(phone.duration * 1e6) for phone in event.phones) == round(info.frames / info.sample_rate * 1e6)
        first = round((event.onset - made.offset) * take.sample_rate)
        own = media.get(event.media).samples
        there = take.samples[first : first + len(own)]
        middle = slice(200, len(own) - 200)
        assert np.allclose(own[middle], there[middle], atol=1e-6), "moved by more than nothing"
    for before, behind in pairwise(speeches):
        assert before.end <= behind.onset + 1e-6
    for breath in made.score.of(Inspiration):
        for event in speeches:
            assert breath.end <= event.onset + 1e-6 or breath.onset >= event.end - 1e-6, breath.rule
    assert codec.loads(codec.dumps(made.score), "") == made.score
    shown = curves(made.score).sample(np.arange(0, made.score.duration, 1 / 60))
    assert np.isfinite(np.asarray(shown)).all()


@pytest.mark.parametrize("model", ["natural", "bernardet-2017", "bernardet-2019"])
def test_speech_stays_and_breaths_fit(bare: Take, original: tuple[Score, MemoryStore], model: str) -> None:
    media = MemoryStore()
    made = recorded(bare, media, model=model)
    check(made, bare, media)
    was, now = onsets(original[0]), onsets(made.score)
    assert was.keys() == now.keys()
    assert np.median([abs(now[place] - made.offset - was[place]) for place in was]) < 0.025
    assert len(list(made.score.of(Inspiration))) >= len(made.score.groups) - 1
    voice = made.score.bodies[0].voice
    assert (voice.engine, voice.voice) == ("recording", "recording:take.wav")


def test_a_breath_of_its_own_stays_with_its_sound(breathing: Take, original: tuple[Score, MemoryStore]) -> None:
    media = MemoryStore()
    made = recorded(breathing, media)
    check(made, breathing, media)
    kept = [event for event in made.score.of(Inspiration) if event.rule == "heard in the recording"]
    drawn = [event for event in original[0].of(Inspiration) if event.noise]
    assert len(kept) >= len(drawn) - 2
    for event in kept:
        own = min(drawn, key=lambda one: abs(one.onset + made.offset - event.onset))
        assert event.noise is not None
        assert event.noise.source in made.score.media
        assert abs(event.onset - made.offset - own.onset) < 0.15
        assert event.duration <= own.duration + 0.05
        sound = media.get(event.noise.source)
        assert len(sound.samples) == pytest.approx(event.duration * sound.sample_rate, abs=2)
    others = recorded(breathing, own_breaths="replace").score
    assert not [event for event in others.of(Inspiration) if event.noise and event.noise.source in others.media]


def test_kept_breaths_sound_as_loud_as_they_were(breathing: Take, tmp_path: Path) -> None:
    """Rendered again, a breath has the level it had."""
    media = MemoryStore()
    made = recorded(breathing, media)
    rendered(made.score, media, tmp_path / "again.wav")
    again = load_take(tmp_path / "again.wav")
    levels = []
    for event in made.score.of(Inspiration):
        if event.rule != "heard in the recording":
            continue
        one = _rms(breathing, event.onset - made.offset, event.duration)
        levels.append(_rms(again, event.onset, event.duration) - one)
    assert abs(float(np.median(levels))) < 1.5


def _rms(take: Take, start: float, length: float) -> float:
    rate = take.sample_rate
    part = take.samples[round((start + 0.2 * length) * rate) : round((start + 0.8 * length) * rate)]
    return float(10 * np.log10(np.square(part, dtype=np.float64).mean() + 1e-12))


def test_times_are_the_recording_s_own_where_it_leaves_time_for_a_breath(bare: Take) -> None:
    assert recorded(bare).offset == 0
    quick = take_of(bare.samples[round(0.9 * bare.sample_rate) :], bare.sample_rate)
    made = recorded(quick, lead=0.25)
    first = min(made.score.of(Utterance), key=lambda event: event.onset)
    assert made.offset > 0
    assert first.onset == pytest.approx(1.25, abs=1e-4)


def test_equal_takes_give_equal_scores(bare: Take) -> None:
    assert codec.dumps(recorded(bare).score) == codec.dumps(recorded(bare).score)


def test_other_breathing_moves_no_word(bare: Take) -> None:
    one, two = (recorded(bare, parameters=p) for p in (Parameters(), Parameters(nose_share=0.9, capacity_lung=70.0)))
    assert onsets(one.score) == onsets(two.score)
    assert one.score.media.keys() == two.score.media.keys()
    assert [e.onset for e in one.score.of(Inspiration)] != [] != [e.noise for e in two.score.of(Inspiration)]


def test_words_stand_where_speaking_voices_have_them(bare: Take) -> None:
    """Without their punctuation."""
    for event in recorded(bare).score.of(Utterance):
        for word in event.words:
            assert word.source is not None
            assert GERMAN[slice(*word.source)] == word.text


def test_silences_are_as_recorded(bare: Take) -> None:
    made = recorded(bare)
    speeches = sorted(made.score.of(Utterance), key=lambda event: event.onset)
    told = {round(pause.onset, 5): pause for pause in made.score.of(Pause) if pause.rule == "as recorded"}
    for before, behind in pairwise(speeches):
        pause = told[round(before.end, 5)]
        assert pause.duration == pytest.approx(behind.onset - before.end, abs=2e-6)
    assert all(hold.duration >= 0 for hold in made.score.of(Hold))


def test_what_only_a_speaking_voice_can_do_is_left_out_and_said(bare: Take) -> None:
    text = GERMAN.replace("Es gingen", "[sigh] Es gingen").replace("\n", " [pause 2]\n", 1)
    said: list[str] = []
    made = compile_recording(bare, text, media=MemoryStore(), language="de", tell=said.append)
    assert said[0].startswith("left out, since the recording is what it is: [sigh], [pause 2]")
    assert onsets(made.score).keys()
    emotional = compile_recording(bare, GERMAN.replace("\n", " :-)\n", 1), media=MemoryStore(), language="de")
    assert any(event.type == "emotion" for event in emotional.score.events)
    assert emotional.score.media.keys() == recorded(bare).score.media.keys(), "an emotion has moved a recorded voice"


def test_declination_can_be_given_to_a_recording(bare: Take) -> None:
    made = recorded(bare, parameters=Parameters(declination=-2.0))
    plain = recorded(bare)
    assert onsets(made.score) == onsets(plain.score)
    assert made.score.media.keys() != plain.score.media.keys()
    slopes = []
    for event in made.score.of(Utterance):
        hertz = np.array(event.pitch.hertz)
        voiced = np.flatnonzero(hertz)
        if event.duration > 1.5:
            slopes.append(np.polyfit((voiced + 0.5) * event.pitch.step, 12 * np.log2(hertz[voiced]), 1)[0])
    assert np.median(slopes) == pytest.approx(-2.0, rel=0.3)


def test_a_transcript_without_words_is_refused(bare: Take) -> None:
    with pytest.raises(InputError, match=r"says nothing|nothing to speak|no words"):
        compile_recording(bare, "...", media=MemoryStore(), language="de", file="a.txt")
