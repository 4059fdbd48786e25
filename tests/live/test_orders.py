"""Commands and moves, one by one: what each does, and what it leaves alone."""

from __future__ import annotations

import pytest

from scorebreath.live.console import Console
from scorebreath.live.desk import COMMANDS, Setting
from scorebreath.live.orders import ACTS, ORDERS
from scorebreath.parameters.table import Parameters
from scorebreath.score.events import Command, Cut, Event, Expiration, Inspiration, Parameter, Utterance
from scorebreath.speech.model import Voice
from tests.live.acting import SAYING, begun, finish, midway, words
from tests.live.rehearsals import BREATHS
from tests.live.stages import QuickTone, Stage


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


@pytest.mark.parametrize("streamed", [False, True])
def test_what_somebody_says_who_has_taken_the_floor_comes_first(streamed: bool) -> None:
    """The breath first, then the words."""
    stage = Stage(step=0.02, voices=lambda _: QuickTone(), cast={"two": Parameters()})
    desk = Console(stage.performance)
    desk.say(SAYING)
    desk.say("And so on.")
    midway(stage)
    desk.command("take", body="body2")
    stage.go(stage.now + 0.5)
    if streamed:
        for piece in ("Let ", "me sp", "eak now."):
            desk.stream(piece, body="body2")
        desk.end_stream(body="body2")
    else:
        desk.say("Let me speak now.", body="body2")
    stage.go(stage.now + 0.5)
    desk.say("Thank you.", body="body2")  # the floor was taken once
    finish(stage, desk)
    spoke = [(group.body, " ".join(group.text.split())) for group in stage.score().groups]
    first = spoke.index(("body2", "Let me speak now."))
    assert 0 < first <= 3 and ("body", "And so on.") in spoke[first:]
    assert spoke[-1] == ("body2", "Thank you.")


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
