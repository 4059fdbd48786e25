"""A stage for tests: a performance on a simulated clock, with voices that take as long as they are told."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field

from scorebreath.compose.models import breathing_model
from scorebreath.engine.onsets import Onset
from scorebreath.ensemble import Ensemble
from scorebreath.errors import VoiceError
from scorebreath.live.company import Company
from scorebreath.live.conditions import Timing
from scorebreath.live.console import Console
from scorebreath.live.ledger import Ledger
from scorebreath.live.performance import Performance
from scorebreath.live.preparing import Prepared, Preparer
from scorebreath.live.prompter import NOTHING, Plan, Prompter
from scorebreath.live.text import Text
from scorebreath.media.store import MediaStore, MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import begin_states, made_by
from scorebreath.score.document import Score
from scorebreath.score.performing import Heard
from scorebreath.script.markup.marked import marked
from scorebreath.speech.model import Speech, SpeechRequest, Voice
from scorebreath.speech.tone.voice import ToneVoice

Latency = Callable[[int], float | None]
"""Seconds that the n-th group takes; None: the voice fails at it."""


@dataclass
class Call:
    """Something that a sounder was told."""

    at: float
    kind: str
    time: float
    what: object


class Listener:
    """A sounder that only listens."""

    def __init__(self) -> None:
        self.calls: list[Call] = []
        self.now = float("-inf")

    def play(self, sounds: Sequence[Onset], media: MediaStore) -> None:
        for sound in sounds:
            if sound.media is not None:
                media.get(sound.media)
            self.calls.append(Call(self.now, "play", sound.time, sound))

    def cut(self, time: float, targets: Collection[str], fade: float) -> None:
        self.calls.append(Call(self.now, "cut", time, (tuple(targets), fade)))

    def move(self, time: float, body: str, heard: Heard, glide: float) -> None:
        self.calls.append(Call(self.now, "move", time, (body, heard, glide)))

    def panic(self) -> None:
        self.calls.append(Call(self.now, "panic", self.now, None))


@dataclass
class Simulated:
    """A backstage on the stage's own clock: what it prepares is ready when its latency has passed."""

    preparer: Preparer
    latency: Latency = lambda _: 0.0
    now: float = float("-inf")
    busy_until: float = float("-inf")
    count: int = 0
    wanted: int = 0
    flush: int = NOTHING
    starved: bool = True
    making: deque[tuple[float, Prepared]] = field(default_factory=deque)
    failed: list[Prepared] = field(default_factory=list)

    def tell(self, message: Callable[[Preparer], None]) -> None:
        message(self.preparer)
        self.starved = False

    def want(self, count: int, flush: int) -> None:
        self.wanted, self.flush = count, flush
        self._work()

    def _work(self) -> None:
        while len(self.making) < self.wanted and self.busy_until <= self.now:
            takes = self.latency(self.count)
            made = self.preparer.work(self.flush)
            self.starved = made is None
            if made is None:
                return
            self.count += 1
            if takes is None:
                made = Prepared(
                    group=made.group, parts=(), media={}, generation=made.generation, problem="the voice is hoarse"
                )
                self.failed.append(made)
                takes = 0.0
            self.busy_until = max(self.now, self.busy_until) + takes
            self.making.append((self.busy_until, made))

    def collect(self) -> list[Prepared]:
        found = []
        while self.making and self.making[0][0] <= self.now:
            found.append(self.making.popleft()[1])
        return found

    @property
    def speaking(self) -> bool:
        return bool(self.making)

    @property
    def idle(self) -> bool:
        return not self.making and self.preparer.prompter.idle


class QuickTone(ToneVoice):
    """The tone voice, which remembers what it has said."""

    known: dict[tuple[object, ...], Speech] = {}  # noqa: RUF012

    def speak(self, request: SpeechRequest) -> Speech:
        key = (request.text, request.closing, request.rate, request.pitch)
        if key not in self.known:
            self.known[key] = super().speak(request)
        return self.known[key]


class Stage:
    """A performance that can be stepped through."""

    def __init__(
        self,
        *,
        parameters: Parameters | None = None,
        model: str = "natural",
        language: str = "en",
        seed: int = 0,
        latency: Latency = lambda _: 0.0,
        timing: Timing | None = None,
        lead: float = 0.5,
        tail: float = 1.0,
        states: Mapping[str, float] | None = None,
        step: float = 0.25,
        voices: Callable[[str], Voice] | None = None,
        cast: Mapping[str, Parameters] | None = None,
    ) -> None:
        p = parameters or Parameters()
        self.media = MemoryStore()
        voice = QuickTone()
        begun = begin_states(states or {})
        ensemble = Ensemble(
            breathing=breathing_model(model), voice=voice, voices=voices, parameters=p, cast=cast or {},
            language=language, seed=seed, recordings=None,
        )  # fmt: skip
        bodies = tuple(ensemble.performer(name).body() for name in ("", *(cast or {})))
        self.ledger = Ledger(
            Score(made_by=made_by(), seed=seed, language=language, model=model, text="", duration=0.0, bodies=bodies)
        )
        self.told: list[str] = []
        plan = Plan(
            model=model, language=language, parameters=p, count=voice.syllables, seed=seed, cast=cast or {},
            begun=begun,
        )  # fmt: skip
        prompter = Prompter(
            plan, said=self.ledger.text, problem=self.told.append,
            wordless=lambda voice, marks: Console(self.performance).act(voice, marks),
        )  # fmt: skip
        self.ensemble = ensemble
        preparer = Preparer(
            prompter, voices=lambda name: ensemble.performers[name].voice if name in ensemble.performers else
            (voices(name) if name and voices else voice),
            parameters=self._parameters, media=self.media,
        )  # fmt: skip
        self.backstage = Simulated(preparer, latency)
        self.sounder = Listener()
        self.performance = Performance(
            Company(ensemble), self.backstage, self.ledger, self.sounder, self.media,
            timing=timing or Timing(), lead=lead, tail=tail, begun=begun, tell=self.told.append,
        )  # fmt: skip
        self.now = self.performance.now
        self.step, self.wake = step, self.now

    def _parameters(self, voice: str) -> Parameters:
        return self.performance.parameters(voice)

    def say(self, text: str, voice: str = "") -> None:
        """A whole text."""
        whole = Text(voice=voice, waiting=deque([marked(text)]), complete=True)
        self.backstage.tell(lambda preparer: preparer.prompter.texts.append(whole))
        self.performance.supply.fed = self.now

    def stream(self) -> Text:
        """A text that comes in pieces."""
        text = Text()
        self.backstage.tell(lambda preparer: preparer.prompter.texts.append(text))
        return text

    def piece(self, text: Text, piece: str) -> None:
        self.backstage.tell(lambda _: text.waiting.append(piece))
        self.performance.supply.fed = self.now

    def end(self) -> None:
        self.performance.ending = True

    def go(self, until: float, each: Callable[[], None] = lambda: None) -> None:
        """Let time pass."""
        while self.now < until and not self.over:
            self.now = max(self.now + 0.001, min(self.wake, self.now + self.step))
            self.backstage.now = self.sounder.now = self.now
            self.wake = self.performance.advance(self.now)
            each()

    @property
    def over(self) -> bool:
        return self.performance.over is not None and self.now > self.performance.over

    def score(self) -> Score:
        return self.ledger.score()


__all__ = ["Listener", "QuickTone", "Simulated", "Stage", "VoiceError"]
