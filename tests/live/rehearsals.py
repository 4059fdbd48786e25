"""Performances by chance: texts, commands and moves at any time, with a voice that is slow, late or failing."""

from __future__ import annotations

import random
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from scorebreath.curves.curve_set import curves
from scorebreath.live.console import Console
from scorebreath.live.desk import COMMANDS, OverError, Setting
from scorebreath.parameters.table import Parameters
from scorebreath.score.cutting import end_of, endings
from scorebreath.score.document import Score
from scorebreath.score.events import Expiration, Hold, Inspiration, Utterance
from tests.live.stages import Latency, QuickTone, Stage

TEXT = (Path(__file__).resolve().parents[2] / "examples" / "radio_chat.txt").read_text("utf-8")
FEELING = (
    "Well :-) that was nice! [emotion surprised] Oh no :-( [sigh] We lost it. ;-) [pause 0.5] Really? "
    "[state anxious 0.8] Yes, and then (she said so) it was over :-O.\n\n"
    "[laugh] Ha! [voice two]Who are you?[/voice] Me. [voice two]I see :-).[/voice] "
)
MOVES: tuple[tuple[str, Setting | None], ...] = (
    ("nose_share", 0.9), ("nose_share", None), ("breath_level", -35.0), ("breath_level", -14.0), ("prosody_rate", 1.6),
    ("capacity_lung", 60.0), ("speaking_loudness", 180.0), ("breath_sound", False), ("breath_sound", True),
    ("style", "spontaneous"), ("breath_brightness", 1.7), ("emotion_breath", 0.0), ("face", "albrecht-2002"),
)  # fmt: skip


@dataclass
class Probe:
    """What the curves were, at a moment at which they should have been final."""

    body: str
    times: NDArray[np.float64]
    values: NDArray[np.float64]


@dataclass
class Rehearsal:
    """A performance and what was seen of it while it went on."""

    stage: Stage
    probes: list[Probe] = field(default_factory=list)
    log: list[tuple[float, str]] = field(default_factory=list)

    @property
    def score(self) -> Score:
        return self.stage.score()

    def differences(self) -> list[str]:
        """Where curves that should have been final are others in the end."""
        score = self.score
        finals = {body.id: curves(score, body.id) for body in score.bodies}
        wrong = []
        for probe in self.probes:
            final = finals[probe.body]
            then = final.sample(probe.times)
            for place, column in np.argwhere(then != probe.values).tolist():
                wrong.append(f"{probe.body}: {final.channels[column]} at {probe.times[place]:.3f} s")
        return wrong

    def too_fast(self) -> list[str]:
        """Channels that are faster than they may be."""
        score, wrong = self.score, []
        times = np.arange(0.0, score.duration, 1.0 / 120.0)
        for body in score.bodies:
            final = curves(score, body.id)
            for channel in final.table:
                if channel.speed is not None:
                    moved = np.abs(np.diff(final.sample(times, [channel.name])[:, 0])) * 120.0
                    if float(moved.max()) > channel.speed * 1.03:
                        wrong.append(f"{body.id}: {channel.name} {moved.max():.1f} at {times[moved.argmax()]:.2f} s")
        return wrong


def moody(chance: random.Random) -> Latency:
    """A voice that is mostly quick."""
    return lambda _: None if chance.random() < 0.03 else chance.choice([0.0, 0.0, 0.05, 0.3, 2.0, 6.0])


def rehearse(
    seed: int, *, orders: int = 50, length: float = 120.0, model: str = "natural", two: bool = False
) -> Rehearsal:
    """A performance by chance; by two bodies, which feel something, too."""
    chance = random.Random(seed)
    stage = Stage(
        latency=moody(chance), model=model, step=chance.choice([0.01, 0.05, 0.25]), seed=seed,
        voices=(lambda _: QuickTone()) if two else None,
        cast={"two": Parameters(sex="female")} if seed % 2 and two else None,
        parameters=Parameters(face=chance.choice(["restrained", "albrecht-2002"])),
    )  # fmt: skip
    desk = Console(stage.performance)
    found = Rehearsal(stage)
    times = sorted(chance.uniform(0.0, length) for _ in range(orders))
    desk.say(FEELING if two else TEXT[:600])
    late = list(range(8))

    def each() -> None:
        while times and stage.now >= times[0]:
            times.pop(0)
            found.log.append((stage.now, order(desk, chance, feeling=two)))
        if not times and not stage.performance.ending:
            desk.end_stream()
            desk.command("end")
        if late and stage.performance.over is not None and chance.random() < 0.2:
            late.pop()
            with suppress(OverError):
                found.log.append((stage.now, afterwards(desk, chance)))
        if chance.random() < 0.2:
            look = stage.now + np.array([-1.0, -0.3, 0.0])
            look = look[look >= -0.3]
            for body in stage.ledger.bodies if look.size else ():
                found.probes.append(Probe(body, look, stage.ledger.curves(body).sample(look)))

    stage.go(5_000.0, each)
    return found


def afterwards(desk: Console, chance: random.Random) -> str:
    """Something that is told when the end is decided."""
    body = chance.choice(["", *desk.bodies])
    name = chance.choice(["say", "cut", "nose_share", "sigh", "stop", "panic", "take", "repeat", "breathe", "reset"])
    if name in ("say", "cut"):
        desk.say(chance.choice(["One thing more.", FEELING[:120]]), body=body, cut_in=name == "cut")
    elif name == "nose_share":
        desk.set(name, 0.4, body=body)
    else:
        desk.command(name, body=body)
    return f"{name} afterwards"


def order(desk: Console, chance: random.Random, *, feeling: bool) -> str:
    """Something that a performer may do, or have somebody do."""
    draw, body = chance.random(), chance.choice(["", "", *desk.bodies])
    if feeling and chance.random() < 0.15:
        desk.say(FEELING, body=body)
        return "feel"
    if feeling and draw < 0.05:
        desk.say(chance.choice(["[sigh] :-)", "😢", "[laugh]"]), body=body)
        return "wordless"
    if draw < 0.5:
        name = chance.choice([name for name in COMMANDS if name not in ("end", "panic")] + ["go"] * 3)
        name = "panic" if chance.random() < 0.05 else name
        desk.command(name, body=body)
        return name
    if draw < 0.7:
        at, cut_in = chance.randrange(len(TEXT) - 300), chance.random() < 0.3
        desk.say(TEXT[at : at + chance.choice([30, 200])], body=body, cut_in=cut_in)
        return "cut in" if cut_in else "say"
    if draw < 0.8:
        desk.stream(TEXT[100:150], body=body)
        return "stream"
    if draw < 0.83:
        desk.end_stream(body=body)
        return "end of stream"
    name, value = chance.choice(MOVES)
    desk.set(name, value, body=body, glide=chance.choice([None, 0.0, 1.0]))
    return f"{name}={value}"


def overlaps(score: Score, kinds: tuple[type, ...]) -> list[str]:
    """Events of these kinds that happen at the same time, as they come to be with the cuts."""
    ends = endings(score.events)
    happened = [e for e in score.events if isinstance(e, kinds) and not (e.id in ends and ends[e.id].prevents(e))]
    happened.sort(key=lambda event: (event.body, event.onset, end_of(event, ends)))
    return [
        f"{one.id} and {two.id}"
        for one, two in pairwise(happened)
        if one.body == two.body and end_of(one, ends) > two.onset + 2e-6
    ]


BREATHS: tuple[type, ...] = (Inspiration, Expiration, Hold)
SPEECH: tuple[type, ...] = (Utterance,)
