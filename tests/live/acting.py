"""A text that is being said, for tests: what began, which words were said, and how it ends."""

from __future__ import annotations

from typing import TypeVar

from scorebreath.live.console import Console
from scorebreath.score.cutting import end_of, endings
from scorebreath.score.events import Event, Utterance
from tests.live.rehearsals import BREATHS, SPEECH, overlaps
from tests.live.stages import Stage

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


def finish(stage: Stage, desk: Console) -> None:
    desk.command("end")
    stage.go(1000.0)
    assert stage.over
    assert overlaps(stage.score(), SPEECH) == [] and overlaps(stage.score(), BREATHS) == []
