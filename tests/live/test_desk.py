"""The desk: what it refuses, what it takes in pieces, and what it takes when the end is decided."""

from __future__ import annotations

import re

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.errors import InputError, ParameterError
from scorebreath.live.console import Console
from scorebreath.live.desk import COMMANDS, OverError, Setting
from scorebreath.parameters.table import Parameters
from scorebreath.score.cutting import end_of, endings
from scorebreath.score.events import Cut, Emotion, Hold, Inspiration, Parameter, Utterance
from scorebreath.score.performing import GIVES_WAY
from scorebreath.speech.model import Speech, SpeechRequest
from tests.live.acting import SAYING, begun, finish, midway, words
from tests.live.stages import QuickTone, Stage


@pytest.mark.parametrize(
    "wrong",
    [
        lambda desk: desk.command("sing"),
        lambda desk: desk.command("sigh", body="body9"),
        lambda desk: desk.say("  "),
        lambda desk: desk.say("[sigh 3 9 nonsense]"),
        lambda desk: desk.say("a" * 2_000_000),
        lambda desk: desk.stream("half \ud800"),
        lambda desk: desk.set("nose_shaer", 0.2),
        lambda desk: desk.set("nose_share", 7.0),
        lambda desk: desk.set("nose_share", "much"),
        lambda desk: desk.set("nose_share", 0.2, glide=-1.0),
        lambda desk: desk.set("nose_share", 0.2, body="nobody"),
        lambda desk: desk.set("nose_share", 0.2, glide="long"),
        lambda desk: desk.say(5),
        lambda desk: desk.say(None),
        lambda desk: desk.stream(b"bytes"),
        lambda desk: desk.command(None),
        lambda desk: desk.command("sigh", body=5),
        lambda desk: desk.values("nobody"),
    ],
)
def test_what_is_wrong_is_refused_at_once_in_one_line(wrong: object, stage: Stage) -> None:
    desk = Console(stage.performance)
    with pytest.raises((InputError, ParameterError)) as caught:
        wrong(desk)  # type: ignore[operator]
    assert str(caught.value)
    assert not stage.performance.inbox


CHILD: dict[str, Setting] = {"capacity_equation": "ecsc-1993", "age": 10.0}
"""An equation for adults, and a child."""


def test_a_value_that_the_others_exclude_is_refused_at_once(stage: Stage, desk: Console) -> None:
    stage.go(1.0)
    desk.set("capacity_equation", "ecsc-1993")
    stage.go(2.0)
    with pytest.raises(ParameterError, match="is for adults"):
        desk.set("age", 10.0)
    assert not stage.performance.inbox


def test_of_two_moves_that_exclude_each_other_the_first_is_done_and_speech_goes_on(stage: Stage, desk: Console) -> None:
    stage.go(1.0)
    for name, value in CHILD.items():  # neither is done when the other is told
        desk.set(name, value)
    finish(stage, desk)
    assert any("refused" in line and "is for adults" in line for line in stage.told)
    assert (desk.values()["capacity_equation"], desk.values()["age"]) == ("ecsc-1993", Parameters().age)
    assert words(stage) == re.findall(r"\w+", SAYING)


class Moody(QuickTone):
    """A voice with a bug."""

    def speak(self, request: SpeechRequest) -> Speech:
        if "road" in request.text.text:
            raise ZeroDivisionError("of the voice's own")
        return super().speak(request)


def test_whatever_a_voice_does_the_others_go_on() -> None:
    stage = Stage(step=0.02, voices=lambda _: Moody())
    desk = Console(stage.performance)
    desk.say("Well then. [voice moody] The road is long. [pause 0.3] [/voice] And wide. [voice moody] Yes.")
    finish(stage, desk)
    assert words(stage) == ["Well", "then", "And", "wide", "Yes"]
    assert any("unspoken" in line and "ZeroDivisionError: of the voice's own" in line for line in stage.told)


@pytest.mark.parametrize("streamed", [False, True])
def test_a_text_without_a_word_is_done(streamed: bool) -> None:
    stage = Stage(step=0.02)
    desk = Console(stage.performance)
    for text in ("[sigh]", ":-)", "[gasp] 😢"):
        stage.go(stage.now + 4.0)
        if streamed:
            desk.stream(text)
            desk.end_stream()
        else:
            desk.say(text)
    finish(stage, desk)
    kinds = [event.kind for event in begun(stage, Inspiration)]
    assert (kinds.count("sigh"), kinds.count("gasp")) == (1, 1)
    assert [event.name for event in begun(stage, Emotion)] == ["happy", "sad"]
    assert stage.score().groups == () and not stage.told
    assert stage.performance.decisions.counts.stalls == 0


def test_a_sigh_alone_comes_between_two_words(stage: Stage, desk: Console) -> None:
    now = midway(stage)
    desk.say("[sigh]")
    finish(stage, desk)
    sighs = [event for event in begun(stage, Inspiration) if event.kind == "sigh"]
    assert len(sighs) == 1 and sighs[0].onset > now
    assert words(stage) == re.findall(r"\w+", SAYING)


def test_half_an_emoticon_waits_for_its_other_half(stage: Stage) -> None:
    desk = Console(stage.performance)
    for piece in ("Good :", "-", ") done."):
        desk.stream(piece)
        stage.go(stage.now + 1.0)
    desk.end_stream()
    finish(stage, desk)
    assert [word.lower() for word in words(stage)] == ["good", "done"]
    assert [event.name for event in begun(stage, Emotion)][:1] == ["happy"]
    assert " ".join(stage.score().text.split()) == "Good :-) done."


def test_only_interruptions_are_counted_as_cuts(stage: Stage) -> None:
    """The silent breath that gives way to speech is nobody's interruption."""
    desk = Console(stage.performance)
    for number in range(3):
        stage.go(stage.now + 6.0)
        desk.say(f"Line {number}.")
    stage.go(stage.now + 10.0)
    assert any(event.rule == GIVES_WAY for event in begun(stage, Cut))
    assert stage.performance.decisions.counts.cuts == 0
    desk.command("sigh")
    stage.go(stage.now + 1.0)
    assert stage.performance.decisions.counts.cuts == 1
    finish(stage, desk)
    made = [event.id for event in stage.score().of(Cut)]
    assert len(set(made)) == len(made)


def test_a_broken_tag_in_a_stream_is_left_out_and_said(stage: Stage) -> None:
    desk = Console(stage.performance)
    desk.stream("One two [sihg] three. [sigh] Four.")
    desk.end_stream()
    finish(stage, desk)
    assert words(stage) == ["One", "two", "three", "Four"]
    assert any("sihg" in line for line in stage.told)
    assert any(event.kind == "sigh" for event in begun(stage, Inspiration) if isinstance(event, Inspiration))


def test_a_stream_that_stalls_is_said_as_far_as_it_came(stage: Stage) -> None:
    desk = Console(stage.performance)
    desk.stream("This is one sentence. And this one has no")
    stage.go(14.0)
    said = [word.lower() for word in words(stage)]
    assert said == ["this", "is", "one", "sentence", "and", "this", "one", "has", "no"]
    desk.stream(" end yet. Now it has.")
    stage.go(28.0)
    assert [word.lower() for word in words(stage)[9:]] == ["end", "yet", "now", "it", "has"]
    finish(stage, desk)


def test_tags_and_words_that_a_stall_tears_wait_for_their_other_half(stage: Stage) -> None:
    desk = Console(stage.performance)
    desk.stream("Hello there, my old frien")
    stage.go(1.5)
    desk.stream("d [gas")
    stage.go(8.0)
    desk.stream("p] well.")
    finish(stage, desk)
    assert [word.lower() for word in words(stage)] == ["hello", "there", "my", "old", "friend", "well"]
    assert [event.kind for event in begun(stage, Inspiration)].count("gasp") == 1


def test_a_sentence_that_is_over_is_said_before_the_next_one_is_whole() -> None:
    """Nobody waits for the rest of a paragraph in silence."""
    stage = Stage(step=0.02)
    desk = Console(stage.performance)
    stage.go(3.0)
    desk.stream("Good morning to you all. And ")
    for piece in ("welcome ", "to ", "this ", "very ", "long ", "and ", "slow ", "talk ", "about ", "trees."):
        stage.go(stage.now + 0.3)
        desk.stream(piece)
    first = begun(stage, Utterance)[0]
    assert first.onset < 4.6
    desk.end_stream()
    finish(stage, desk)


def test_eyes_and_head_keep_their_speed_through_interruptions() -> None:
    stage = Stage(step=0.02)
    desk = Console(stage.performance)
    desk.say(SAYING)
    for time, name in ((3.0, "sigh"), (6.0, "stop"), (7.0, "laugh")):
        stage.go(time)
        desk.command(name)
        desk.say("What was that? Was it you, or was it me?")
    finish(stage, desk)
    final = curves(stage.score())
    times = np.arange(0.0, stage.score().duration, 1.0 / 240.0)
    for channel in final.table:
        if channel.speed is not None:
            moved = np.abs(np.diff(final.sample(times, [channel.name])[:, 0])) * 240.0
            assert float(moved.max()) <= channel.speed * 1.02, channel.name


def test_a_held_breath_holds_the_volume(stage: Stage) -> None:
    desk = Console(stage.performance)
    stage.go(5.0)
    desk.command("hold")
    stage.go(6.0)
    (held,) = [e for e in begun(stage, Hold, 5.0) if isinstance(e, Hold) and e.kind == "held"]
    volume = curves(stage.score()).sample([held.onset, held.end - 1e-3], ["lung_volume"])[:, 0]
    assert float(volume[0]) == pytest.approx(float(volume[1]), abs=1e-6) == pytest.approx(held.volume, abs=1e-6)


def decided(stage: Stage, desk: Console) -> float:
    """Let it come to where the end is decided while the last words are still to be heard; when it would be."""
    desk.command("end")
    while stage.performance.over is None:
        stage.go(stage.now + 0.1)
    assert stage.now < stage.performance.over - 2.0
    return stage.performance.over


def test_what_comes_when_the_end_is_decided_is_said_all_the_same(stage: Stage, desk: Console) -> None:
    over = decided(stage, desk)
    desk.say("One more thing.")
    finish(stage, desk)
    assert words(stage) == [*re.findall(r"\w+", SAYING), "One", "more", "thing"]
    assert stage.performance.over is not None and stage.performance.over > over
    assert stage.score().duration == stage.performance.over
    assert stage.performance.decisions.counts.late == 0


@pytest.mark.parametrize("name", ["panic", "stop"])
def test_speech_can_be_stopped_when_the_end_is_decided(name: str, stage: Stage, desk: Console) -> None:
    over = decided(stage, desk)
    said = begun(stage, Utterance)[-1]
    stage.go(said.onset + 0.5)
    desk.command(name)
    stage.go(1000.0)
    assert stage.over and stage.performance.over is not None and stage.performance.over < over
    assert end_of(said, endings(stage.score().events)) < said.onset + 1.0


def test_a_move_when_the_end_is_decided_is_heard_and_leaves_the_end(stage: Stage, desk: Console) -> None:
    over = decided(stage, desk)
    desk.set("nose_share", 0.3)
    stage.go(1000.0)
    assert any(event.name == "nose_share" for event in stage.score().of(Parameter))
    assert stage.performance.over == over


def test_what_comes_when_all_is_over_is_refused(stage: Stage, desk: Console) -> None:
    decided(stage, desk)
    stage.go(1000.0)
    before = stage.score()
    for name in COMMANDS:
        with pytest.raises(OverError):
            desk.command(name)
    with pytest.raises(OverError, match="nothing more is taken"):
        desk.say("One more thing.")
    with pytest.raises(OverError):
        desk.stream("One more thing.")
    with pytest.raises(OverError):
        desk.set("nose_share", 0.3)
    stage.go(1010.0)
    assert stage.over and stage.score() == before


def test_what_is_told_just_before_the_end_and_comes_too_late_is_told(stage: Stage, desk: Console) -> None:
    over = decided(stage, desk)
    stage.go(over - stage.performance.timing.reaction - 0.01)
    desk.say("One more thing.")
    stage.go(over + 1.0)  # it is looked at when the time to do it is over
    assert stage.over
    said = words(stage)[-3:] == ["One", "more", "thing"]
    assert said != any("nothing more is taken" in line for line in stage.told)
