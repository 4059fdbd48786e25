"""Commands and moves, one by one: what each does, and what it leaves alone."""

from __future__ import annotations

import re
from typing import TypeVar

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.errors import InputError, ParameterError
from scorebreath.live.console import Console
from scorebreath.live.desk import COMMANDS, OverError, Setting
from scorebreath.live.orders import ACTS, ORDERS
from scorebreath.parameters.table import Parameters
from scorebreath.score.cutting import end_of, endings
from scorebreath.score.events import Command, Cut, Event, Expiration, Hold, Inspiration, Parameter, Utterance
from scorebreath.score.performing import GIVES_WAY
from scorebreath.speech.model import Voice
from tests.live.rehearsals import BREATHS, SPEECH, overlaps
from tests.live.stages import QuickTone, Stage

SAYING = (
    "It was late. The road went on and on through the hills, and nobody had said a word for an hour. Then it rained, "
    "and we stood under a tree until the morning came, cold and grey and very quiet."
)


E = TypeVar("E", bound=Event)


def begun(stage: Stage, kind: type[E], since: float = 0.0) -> list[E]:
    """Events that really begin, from a time on."""
    score = stage.score()
    ends = endings(score.events)
    found = [e for e in score.events if isinstance(e, kind) and not (e.id in ends and ends[e.id].prevents(e))]
    return sorted((event for event in found if event.onset >= since), key=lambda event: event.onset)


def words(stage: Stage) -> list[str]:
    """All words that were said, as far as they were."""
    score = stage.score()
    ends = endings(score.events)
    return [
        word.text
        for said in begun(stage, Utterance)
        if isinstance(said, Utterance)
        for word in said.words
        if said.onset + word.onset < end_of(said, ends) - 1e-6
    ]


def midway(stage: Stage) -> float:
    """Let it come to the midst of the second utterance; when that is."""
    while len(begun(stage, Utterance)) < 2:
        stage.go(stage.now + 0.1)
    said = begun(stage, Utterance)[1]
    stage.go(said.onset + 0.4 * said.duration)
    return stage.now


@pytest.fixture
def stage() -> Stage:
    return Stage(step=0.02)


@pytest.fixture
def desk(stage: Stage) -> Console:
    desk = Console(stage.performance)
    desk.say(SAYING)
    return desk


def finish(stage: Stage, desk: Console) -> None:
    desk.command("end")
    stage.go(1000.0)
    assert stage.over
    assert overlaps(stage.score(), SPEECH) == [] and overlaps(stage.score(), BREATHS) == []


def test_every_command_is_carried_out() -> None:
    assert set(ACTS) | set(ORDERS) == set(COMMANDS)
    assert set(ACTS) == {name for name, row in COMMANDS.items() if row.does == "acts"}


@pytest.mark.parametrize("name", sorted(ACTS))
def test_an_act_in_the_midst_of_speech_comes_between_two_words(name: str, stage: Stage, desk: Console) -> None:
    now = midway(stage)
    desk.command(name)
    finish(stage, desk)
    (cut,) = [event for event in begun(stage, Cut, now) if any("speech" in target for target in event.targets)]
    assert now < cut.onset < now + 1.5
    asked = [e for e in begun(stage, Event, cut.onset) if e.origin == "performer" and isinstance(e, BREATHS)]
    assert asked and asked[0].onset == cut.onset
    assert words(stage) == [word.strip(".,") for word in SAYING.split()], "every word is said, once"
    broken = [e for e in begun(stage, Utterance) if isinstance(e, Utterance) and e.onset < cut.onset < e.end]
    assert all(min(abs(e.onset + w.onset - cut.onset) for w in e.words) < 1e-6 for e in broken)


@pytest.mark.parametrize("name", sorted(ACTS))
def test_an_act_of_somebody_at_rest_comes_at_once(name: str) -> None:
    stage = Stage(step=0.02)
    desk = Console(stage.performance)
    stage.go(6.0)
    desk.command(name)
    stage.go(7.0)
    asked = [e for e in begun(stage, Event, 6.0) if e.origin == "performer" and isinstance(e, BREATHS)]
    assert asked
    assert asked[0].onset - 6.0 <= stage.performance.timing.reaction + 0.04
    finish(stage, desk)


def test_pause_waits_at_the_next_breath_and_go_goes_on(stage: Stage, desk: Console) -> None:
    now = midway(stage)
    group = begun(stage, Utterance)[1].group
    desk.command("pause")
    stage.go(now + 12.0)
    assert begun(stage, Utterance)[-1].group == group
    assert [e for e in begun(stage, Inspiration, now + 4.0) if e.kind == "tidal"], "it breathes"
    desk.command("go")
    finish(stage, desk)
    assert words(stage) == [word.strip(".,") for word in SAYING.split()]


def test_stop_breaks_off_and_breathes_out(stage: Stage, desk: Console) -> None:
    now = midway(stage)
    desk.command("stop")
    finish(stage, desk)
    said = words(stage)
    assert 0 < len(said) < len(SAYING.split())
    (cut,) = [event for event in begun(stage, Cut, now) if any("speech" in target for target in event.targets)]
    assert cut.onset - now <= stage.performance.timing.reaction + 0.03
    assert not begun(stage, Utterance, cut.onset)
    after = [event for event in begun(stage, Expiration, cut.onset) if event.duration > 0]
    assert after[0].onset == cut.onset
    assert after[0].to_volume < after[0].from_volume


def test_cut_in_says_something_else_at_once(stage: Stage, desk: Console) -> None:
    now = midway(stage)
    desk.say("No, listen!", cut_in=True)
    finish(stage, desk)
    said = words(stage)
    assert said[-2:] == ["No", "listen"]
    assert begun(stage, Utterance, now)[-1].onset - now < 1.5
    assert [event.name for event in begun(stage, Command) if isinstance(event, Command)][:1] == ["cut_in"]


def test_repeat_says_the_last_group_again(stage: Stage, desk: Console) -> None:
    midway(stage)
    group = begun(stage, Utterance)[1].group
    desk.command("repeat")
    finish(stage, desk)
    texts = [group.text for group in stage.score().groups]
    again = next(g.text for g in stage.score().groups if g.id == group)
    assert texts.count(again) == 2
    assert texts.index(again) + 1 == len(texts) - 1 - texts[::-1].index(again)


def test_clear_finishes_the_group(stage: Stage, desk: Console) -> None:
    midway(stage)
    count = len({event.group for event in begun(stage, Utterance)})
    desk.command("clear")
    finish(stage, desk)
    assert len(stage.score().groups) == count
    assert not [event for event in begun(stage, Cut) if any("speech" in target for target in event.targets)]


def test_panic_is_silence_at_once(stage: Stage, desk: Console) -> None:
    now = midway(stage)
    desk.command("panic")
    stage.go(now + 0.05)
    assert any(call.kind == "panic" for call in stage.sounder.calls)
    desk.say("And now?")
    finish(stage, desk)
    cut = next(event for event in begun(stage, Cut, now) if any("speech" in target for target in event.targets))
    assert cut.onset - now < 0.04
    assert words(stage)[-2:] == ["And", "now"]


def test_whoever_speaks_after_a_panic_begins_at_once(stage: Stage, desk: Console) -> None:
    now = midway(stage)
    desk.command("panic")
    stage.go(now + 0.2)
    desk.say("Again.")
    finish(stage, desk)
    assert begun(stage, Utterance, now)[0].onset < now + 2.0


def test_reset_brings_back_what_it_began_with() -> None:
    stage = Stage(parameters=Parameters(nose_share=0.6))
    desk = Console(stage.performance)
    desk.set("nose_share", 0.1)
    desk.set("breath_level", -30.0)
    stage.go(1.0)
    assert desk.values()["nose_share"] == 0.1
    desk.command("reset")
    stage.go(2.0)
    assert (desk.values()["nose_share"], desk.values()["breath_level"]) == (0.6, -24.0)


def test_who_takes_the_floor_speaks_next() -> None:
    voices = {"two": QuickTone()}

    def opened(name: str) -> Voice:
        return voices[name]

    stage = Stage(voices=opened, cast={"two": Parameters()}, step=0.02)
    desk = Console(stage.performance)
    desk.say(SAYING)
    midway(stage)
    desk.say("Wait a moment, please.", body="body2")
    desk.command("take", body="body2")
    finish(stage, desk)
    groups = stage.score().groups
    spoke = [group.body for group in groups]
    first = spoke.index("body2")
    assert 0 < first < len(spoke) - 1, "it came between"
    assert spoke[first + 1] == "body", "and the other one went on"
    mine = " ".join(g.text for g in groups if g.body == "body")
    assert " ".join(mine.split()) == SAYING
    cue = [e for e in begun(stage, Inspiration) if e.body == "body2" and e.origin == "performer"]
    assert cue, "it breathes in, to be heard"
    assert cue[0].onset < next(e.onset for e in begun(stage, Utterance) if e.body == "body2")


@pytest.mark.parametrize(
    ("name", "value", "heard"),
    [
        ("breath_level", -18.0, {"mouth": 1.995, "nose": 1.995, "speech": 1.0}),
        ("nose_share", 0.7, {"nose": 2.0, "mouth": 0.4615}),
        ("breath_brightness", 1.5, {"brightness": 1.5}),
        ("speaking_loudness", 200.0, {"speech": 2.0}),
        ("breath_sound", False, {"mouth": 0.0, "nose": 0.0}),
    ],
)
def test_a_move_is_heard_at_once_and_planned_from_the_next_group_on(
    name: str, value: Setting, heard: dict[str, float], stage: Stage, desk: Console
) -> None:
    now = midway(stage)
    group = begun(stage, Utterance)[1].group
    desk.set(name, value, glide=0.2)
    finish(stage, desk)
    moves = [event for event in begun(stage, Parameter) if isinstance(event, Parameter)]
    assert moves[0].name == name
    assert now < moves[0].onset < now + 0.15
    assert moves[0].heard is not None and moves[0].glide == 0.2
    for route, ratio in heard.items():
        assert getattr(moves[0].heard, route) == pytest.approx(ratio, rel=0.01)
    made = [event for event in moves[1:] if event.heard is not None]
    following = next(e for e in begun(stage, Inspiration) if e.group not in (None, group) and e.onset > now)
    assert made[0].heard is not None and made[0].heard.mouth == made[0].heard.speech == 1.0
    assert made[0].onset <= following.onset


def test_what_was_decided_keeps_its_shape(stage: Stage, desk: Console) -> None:
    """A slower voice from the next group on: what is being said stays as it was."""
    other = Stage(step=0.02)
    Console(other.performance).say(SAYING)
    now = midway(stage)
    other.go(now)
    desk.set("prosody_rate", 0.6)
    stage.go(40.0)
    other.go(40.0)
    mine, theirs = begun(stage, Utterance), begun(other, Utterance)
    group = mine[1].group
    assert [e for e in mine if e.group == group] == [e for e in theirs if e.group == group]
    rate = [sum(len(w.text) for w in e.words) / e.duration for e in (mine[-1], theirs[-1]) if isinstance(e, Utterance)]
    assert rate[0] < 0.75 * rate[1]


def test_a_value_set_by_hand_stays_until_it_is_reset(stage: Stage, desk: Console) -> None:
    desk.set("amplitude_sound_nose", 0.05)
    desk.set("nose_share", 1.0)
    stage.go(1.0)
    assert desk.values()["amplitude_sound_nose"] == 0.05
    desk.set("amplitude_sound_nose", None)
    stage.go(2.0)
    assert desk.values()["amplitude_sound_nose"] == 1.0


def test_moves_are_told_to_those_who_listen(stage: Stage, desk: Console) -> None:
    told: list[tuple[str, str, Setting]] = []
    stop = desk.listen(lambda body, name, value: told.append((body, name, value)))
    desk.set("nose_share", 0.2)
    stage.go(1.0)
    stop()
    desk.set("nose_share", 0.3)
    stage.go(2.0)
    assert told == [("body", "nose_share", 0.2)]


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
