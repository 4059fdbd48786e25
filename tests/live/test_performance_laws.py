"""What holds of every performance, whatever a performer does and however the voice behaves."""

from __future__ import annotations

import random
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.live.conditions import Timing
from scorebreath.live.console import Console
from scorebreath.score.codec import dumps, loads
from scorebreath.score.cutting import endings
from scorebreath.score.events import Inspiration, Utterance, WarningEvent
from scorebreath.script.reader import read
from tests.live.rehearsals import BREATHS, SPEECH, TEXT, Rehearsal, moody, overlaps, rehearse
from tests.live.stages import Stage

PROSE = (Path(__file__).resolve().parents[2] / "examples" / "prose.txt").read_text("utf-8")
MODELS = ["natural", "natural", "natural", "bernardet-2019"]
FASTEST = 5.0
"""VC/s that the lungs' volume changes at most: a puff of laughter."""


@pytest.fixture(scope="module", params=range(10))
def rehearsal(request: pytest.FixtureRequest) -> Rehearsal:
    seed: int = request.param
    return rehearse(seed, model=MODELS[seed % len(MODELS)], two=seed >= 5)


def test_curves_up_to_now_are_final(rehearsal: Rehearsal) -> None:
    assert len(rehearsal.probes) > 20
    assert rehearsal.differences() == []


def test_nothing_moves_too_fast(rehearsal: Rehearsal) -> None:
    assert rehearsal.too_fast() == []


def test_no_bundle_is_for_the_past(rehearsal: Rehearsal) -> None:
    lookahead = rehearsal.stage.performance.timing.lookahead
    calls = rehearsal.stage.sounder.calls
    assert [call for call in calls if call.kind == "play" and call.time < call.at + lookahead - 1e-9] == []
    assert [call for call in calls if call.kind in ("cut", "move") and call.time < call.at - 1e-9] == []
    assert any(call.kind == "cut" for call in calls)


def test_moves_of_a_body_are_in_order_of_time(rehearsal: Rehearsal) -> None:
    moves = [call for call in rehearsal.stage.sounder.calls if call.kind == "move"]
    for body in rehearsal.stage.ledger.bodies:
        times = [call.time for call in moves if isinstance(call.what, tuple) and call.what[0] == body]
        assert times == sorted(times)


def test_nothing_overlaps(rehearsal: Rehearsal) -> None:
    assert overlaps(rehearsal.score, SPEECH) == []
    assert overlaps(rehearsal.score, BREATHS) == []


def test_lungs_never_jump(rehearsal: Rehearsal) -> None:
    score = rehearsal.score
    times = np.arange(0.0, score.duration, 0.005)
    for body in score.bodies:
        volume = curves(score, body.id).sample(times, ["lung_volume"])[:, 0]
        assert float(np.abs(np.diff(volume)).max()) <= FASTEST * 0.005
        assert float(volume.min()) >= 0.0 and float(volume.max()) <= 1.0


def test_it_can_be_saved(rehearsal: Rehearsal) -> None:
    assert loads(dumps(rehearsal.score)) == rehearsal.score


def test_it_ends(rehearsal: Rehearsal) -> None:
    assert rehearsal.stage.over
    assert rehearsal.score.duration == rehearsal.stage.performance.over


def test_thousands_of_groups_and_no_word_is_lost() -> None:
    """With a voice that is sometimes slow, late or failing: every group is said or said to be missing, once."""
    chance = random.Random(1)
    text = "\n\n".join([PROSE] * 7)
    stage = Stage(latency=lambda _: None if chance.random() < 0.03 else chance.choice([0.0, 0.3, 2.0, 5.0, 12.0]))
    stage.say(text)
    stage.end()
    stage.go(100_000.0)
    score, counts = stage.score(), stage.performance.decisions.counts
    assert counts.groups + counts.unspoken > 1000
    spoken = [group.source for group in score.groups]
    missing = [made.group.source for made in stage.backstage.failed]
    assert len(spoken) == counts.groups and len(missing) == counts.unspoken > 10
    covered = sorted((*source,) for source in (*spoken, *missing))
    assert all(one[1] <= two[0] for one, two in pairwise(covered))
    words = [word.source for sentence in read(text, poem=False).sentences for word in sentence.words]
    edges = np.array(covered)
    starts = np.array([word.start for word in words])
    place = np.searchsorted(edges[:, 0], starts, side="right") - 1
    assert np.all((place >= 0) & (starts < edges[np.maximum(place, 0), 1]))
    warned = [event.code for event in score.of(WarningEvent)]
    assert warned.count("unspoken") == counts.unspoken
    assert warned.count("late") == counts.late > 10
    lookahead = stage.performance.timing.lookahead
    assert all(call.time >= call.at + lookahead - 1e-9 for call in stage.sounder.calls if call.kind == "play")
    assert overlaps(score, SPEECH) == [] and overlaps(score, BREATHS) == []


def test_lateness_is_what_is_said() -> None:
    """A group that takes three seconds more than there are begins as soon as it is there, and the body breathes on."""
    stage = Stage(latency=lambda number: 0.0 if number < 2 else 9.0 if number == 2 else 0.0)
    stage.say("One two three four. " * 8 + TEXT[:300])
    stage.go(60.0)
    score = stage.score()
    (late,) = [event for event in score.of(WarningEvent) if event.code == "late"]
    seconds = float(late.text.split()[0])
    assert seconds == pytest.approx(stage.performance.decisions.counts.latest, abs=1e-3)
    ends = endings(score.events)
    tidal = [
        event for event in score.of(Inspiration)
        if event.kind == "tidal" and late.onset - seconds - 1e-6 <= event.onset < late.onset
        and not (event.id in ends and ends[event.id].prevents(event))
    ]  # fmt: skip
    assert tidal, "the body breathes while it waits"
    after = min(event.onset for event in score.of(Utterance) if event.onset > late.onset)
    assert after - late.onset < 1.5


@pytest.mark.parametrize("timing", [Timing(lookahead=0.05), Timing(lookahead=0.4), Timing(curve_lead=0.5)])
def test_they_hold_for_every_timing(timing: Timing) -> None:
    chance = random.Random(5)
    stage = Stage(latency=moody(chance), timing=timing)
    desk = Console(stage.performance)
    desk.say(TEXT[:500])
    probes = []

    def each() -> None:
        if chance.random() < 0.05:
            desk.command(chance.choice(["sigh", "pause", "go", "stop", "repeat"]))
            desk.say(TEXT[:80])
        times = stage.now + np.array([timing.curve_lead, 0.0])
        if times.min() > 0 and chance.random() < 0.2:
            probes.append((times, stage.ledger.curves("body").sample(times)))

    stage.go(40.0, each)
    final = curves(stage.score())
    assert len(probes) > 10
    assert all(np.array_equal(values, final.sample(times)) for times, values in probes)


def test_a_performer_that_is_held_up_says_so_and_goes_on() -> None:
    """The process sleeps for some seconds in the midst of a text: what should have been decided then begins later."""
    stage = Stage()
    stage.say(TEXT)
    stage.end()
    stage.go(10.0)
    stage.now += 7.0
    stage.go(10_000.0)
    counts, score = stage.performance.decisions.counts, stage.score()
    assert counts.stalls == 1
    assert overlaps(score, SPEECH) == [] and overlaps(score, BREATHS) == []
    assert all(call.time >= call.at for call in stage.sounder.calls if call.kind == "play")
    assert (
        "".join(group.text for group in score.groups).split()
        == "".join(score.groups[i].text for i in range(len(score.groups))).split()
    )
    times = np.arange(0.0, score.duration, 0.01)
    assert float(np.abs(np.diff(curves(score).sample(times, ["lung_volume"])[:, 0])).max()) < 0.02
