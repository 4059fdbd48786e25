"""One step, two callers: a text that nobody touches becomes live what it becomes offline."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from scorebreath.live.console import Console
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.score.codec import dumps, loads
from scorebreath.score.document import Score
from scorebreath.score.events import Event, Utterance
from tests.live.stages import QuickTone, Stage

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
FORECAST = (EXAMPLES / "forecast.txt").read_text("utf-8")


def in_order(score: Score) -> list[Event]:
    return sorted(score.events, key=lambda event: (event.onset, event.id))


def offline(text: str, **settings: object) -> Score:
    return compile_text(text, voice=QuickTone(), media=MemoryStore(), **settings)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("forecast.txt", {}),
        ("forecast.txt", {"model": "bernardet-2017"}),
        ("forecast.txt", {"model": "bernardet-2019"}),
        ("forecast.txt", {"states": {"anxious": 0.8}, "seed": 7}),
        ("forecast.txt", {"parameters": Parameters(style="spontaneous", face="albrecht-2002"), "seed": 3}),
        ("tags.txt", {}),
        ("radio_chat.txt", {}),
        ("radio_chat.txt", {"parameters": Parameters(declination=-2.0, question_rise=4.0, speaking_loudness=150.0)}),
        ("parallelen_emoticons.txt", {"language": "de"}),
    ],
)
def test_untouched_it_is_what_the_text_compiles_to(name: str, settings: dict[str, object]) -> None:
    text = (EXAMPLES / name).read_text("utf-8")
    stage = Stage(**settings)  # type: ignore[arg-type]
    stage.say(text)
    stage.end()
    stage.go(10_000)
    made, wanted = stage.score(), offline(text, **settings)
    assert in_order(made) == in_order(wanted)
    assert (made.groups, made.text, made.duration) == (wanted.groups, wanted.text, wanted.duration)
    assert made.media == wanted.media
    assert loads(dumps(made)) == made
    assert stage.performance.decisions.counts.late == 0


@pytest.mark.parametrize("seed", range(3))
def test_pieces_that_come_in_time_become_the_same(seed: int) -> None:
    """A stream whose pieces end anywhere, quick enough never to be waited for."""
    chance = random.Random(seed)
    stage = Stage()
    desk = Console(stage.performance)
    at = 0
    while at < len(FORECAST):
        size = chance.choice([1, 2, 3, 7, 40])
        desk.stream(FORECAST[at : at + size])
        at += size
    desk.end_stream()
    desk.command("end")
    stage.go(10_000)
    made, wanted = stage.score(), offline(FORECAST, poem=False)
    commands = {event.id for event in made.events if event.type == "command"}
    assert [event for event in in_order(made) if event.id not in commands] == in_order(wanted)


def test_what_was_performed_stays_when_the_rest_of_the_text_changes() -> None:
    """Groups that have been said before the texts part are the same ones."""
    first, second = Stage(), Stage()
    for stage, more in ((first, "Then we left. It was late."), (second, "Nobody came! We waited for an hour.")):
        stage.say(FORECAST + more)
        stage.go(40.0)
    made = [[e for e in in_order(s.score()) if isinstance(e, Utterance) and e.onset < 30.0] for s in (first, second)]
    assert made[0] == made[1]
    assert len(made[0]) > 4
