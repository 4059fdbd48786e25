"""Several voices in one text, recordings of one's own, states from the beginning: what only a whole text shows."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scorebreath.curves import curves
from scorebreath.curves.channels import CHANNELS
from scorebreath.errors import InputError
from scorebreath.media.recordings import load_recordings
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.score.codec import dumps, loads
from scorebreath.score.events import Expiration, Hold, Inspiration, Marker, Pause, State, Utterance
from scorebreath.speech.model import Voice
from scorebreath.speech.voices import open_voice

TALK = (
    "Did you hear that? [voice other] I heard it well enough, and I would rather not hear it again. "
    "[sigh] It is late. [/voice] Then let us go, [mark going] before it comes any closer to the house."
)


@pytest.fixture(name="voice")
def tone() -> Iterator[Voice]:
    with open_voice("tone", "en") as voice:
        yield voice


def test_another_voice_is_another_body_on_the_same_clock(voice: Voice) -> None:
    asked: list[str] = []

    def opened(name: str) -> Voice:
        asked.append(name)
        return voice

    woman = Parameters(sex="female", height=165.0)
    score = compile_text(TALK, voice=voice, media=MemoryStore(), voices=opened, cast={"other": woman})
    assert asked == ["other"]
    assert [body.id for body in score.bodies] == ["body", "body2"]
    assert score.bodies[1].person.vital_capacity < score.bodies[0].person.vital_capacity
    assert [group.body for group in score.groups] == sorted(group.body for group in score.groups[:1]) + [
        "body2" for group in score.groups if group.body == "body2"
    ] + ["body" for group in score.groups[1:] if group.body == "body"]
    speeches = sorted(score.of(Utterance), key=lambda e: e.onset)
    assert all(a.end <= b.onset + 1e-5 for a, b in pairwise(speeches))
    for body in score.bodies:
        own = sorted(
            (e for e in score.events if isinstance(e, Inspiration | Expiration | Hold) and e.body == body.id),
            key=lambda e: (e.onset, e.end),
        )
        time = 0.0
        for event in own:
            assert event.onset == pytest.approx(time, abs=1e-5)
            time = event.end
        assert time == pytest.approx(score.duration, abs=1e-5)
        assert curves(score, body.id).sample([0.0, 1.0]).shape == (2, len(CHANNELS))
    sigh = next(e for e in score.of(Inspiration) if e.kind == "sigh")
    assert sigh.body == "body2"
    assert loads(dumps(score)) == score


def test_a_body_that_does_not_speak_breathes_at_rest(voice: Voice) -> None:
    long = "And so on and on it went, " * 20 + "until it ended."
    score = compile_text(
        f"One. [voice b] {long} [/voice] Two.", voice=voice, media=MemoryStore(), voices=lambda _: voice
    )
    idle = [e for e in score.of(Inspiration, "body") if e.kind == "tidal"]
    assert len(idle) >= 8
    first, last = (next(score.of(Inspiration, "body")), [*score.of(Inspiration, "body")][-1])
    assert first.onset < idle[0].onset < last.onset


def test_nobody_opens_voices_where_none_can(voice: Voice) -> None:
    with pytest.raises(InputError, match="other"):
        compile_text(TALK, voice=voice, media=MemoryStore())


def test_a_name_stands_at_the_word_it_was_put_before(voice: Voice) -> None:
    score = compile_text(TALK, voice=voice, media=MemoryStore(), voices=lambda _: voice)
    marker = next(score.of(Marker))
    words = [(u.onset + w.onset, w.text) for u in score.of(Utterance) for w in u.words]
    at = min(words, key=lambda word: abs(word[0] - marker.onset))
    assert at[1].startswith("before")
    assert at[0] == pytest.approx(marker.onset, abs=2e-5)


def test_a_text_of_acts_alone_is_a_score(voice: Voice) -> None:
    score = compile_text("[sigh] [pause 1]", voice=voice, media=MemoryStore())
    assert score.groups == ()
    assert next(score.of(Inspiration)).kind == "sigh"
    assert any(e.kind == "asked" for e in score.of(Pause))
    assert score.duration > 3.0


def test_states_hold_from_the_beginning(voice: Voice) -> None:
    score = compile_text("Hello there. How are you?", voice=voice, media=MemoryStore(), states={"anxious": 0.5})
    state = next(score.of(State))
    assert (state.onset, state.target, state.ramp) == (0.0, 0.5, 0.0)
    neutral = compile_text("Hello there. How are you?", voice=voice, media=MemoryStore())
    assert next(score.of(Inspiration)).motion.thorax > next(neutral.of(Inspiration)).motion.thorax


@pytest.mark.parametrize("model", ["natural", "bernardet-2019"])
def test_recordings_take_the_place_of_the_synthesiser(tmp_path: Path, voice: Voice, model: str) -> None:
    for number, kind in enumerate(("mouth", "nose", "sigh")):
        noise = np.random.default_rng(number).normal(0, 0.1, 24000)
        soundfile.write(tmp_path / f"{kind}.wav", noise * np.hanning(24000), 48000)
    media = MemoryStore()
    recordings = load_recordings(tmp_path, media, seed=0)
    score = compile_text(
        "Hello there, my friend. [sigh] How are you today?",
        voice=voice,
        media=media,
        model=model,
        recordings=recordings,
    )
    kinds = {info.kind for info in score.media.values()}
    assert kinds == {"speech", "breath"}
    for breath in score.of(Inspiration):
        if breath.noise and breath.kind == "speech":
            assert score.media[breath.noise.source].kind == "breath"
            assert score.media[breath.noise.source_nose].kind == "breath"
    sighs = [e for e in score.of(Expiration) if e.kind == "sigh" and e.noise]
    assert len(sighs) == 1
    assert all(e.noise and e.noise.source in score.media for e in sighs)
    assert all(sha in media for sha in score.media)


def test_a_child_says_less_on_a_breath_than_the_man_before(voice: Voice) -> None:
    sentence = "And then the boat went down the river, and the men on board sang the old songs until the night came. "
    text = sentence * 8 + "[voice child] " + sentence * 8
    child = Parameters(age=8.0, height=128.0)
    score = compile_text(text, voice=voice, media=MemoryStore(), voices=lambda _: voice, cast={"child": child})

    def mean(body: str) -> float:
        own = [group.syllables for group in score.groups if group.body == body]
        return sum(own) / len(own)

    assert mean("body2") < 0.9 * mean("body")


def test_the_whole_name_of_the_first_voice_means_who_began() -> None:
    text = "[voice espeak:en-us] One. [voice espeak:en-us+f3] Two. [voice espeak:en-us] Three. [/voice] Four."
    with open_voice("espeak", "en") as first, open_voice("espeak:en-us+f3", "en") as second:
        score = compile_text(text, voice=first, media=MemoryStore(), voices=lambda name: second)
        mine = {"espeak:en-us": Parameters(vital_capacity=3.0)}
        cast = compile_text(text, voice=first, media=MemoryStore(), voices=lambda name: second, cast=mine)
    assert [said.body for said in sorted(score.of(Utterance), key=lambda said: said.onset)] == [
        "body", "body2", "body", "body",
    ]  # fmt: skip
    assert [body.id for body in score.bodies] == ["body", "body2"]
    assert len(cast.bodies) == 3  # somebody else, with lungs of their own
