"""The show: a performance on the wall clock, with its voices, its engine, its take and its desk."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Protocol, Self

from scorebreath.compose.models import breathing_model
from scorebreath.curves.curve_set import CurveSet
from scorebreath.ensemble import Ensemble
from scorebreath.errors import InputError
from scorebreath.live.backstage import Thread
from scorebreath.live.company import Company
from scorebreath.live.conditions import Counts, Timing
from scorebreath.live.conditions import Sounder as Plays
from scorebreath.live.console import Console
from scorebreath.live.keeping import RecentStore
from scorebreath.live.ledger import Ledger
from scorebreath.live.performance import Performance
from scorebreath.live.preparing import Preparer
from scorebreath.live.prompter import Plan, Prompter
from scorebreath.media.recordings import Recordings, load_recordings
from scorebreath.media.store import FolderStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import begin_states, made_by
from scorebreath.score.document import Score
from scorebreath.score.take import TakeWriter
from scorebreath.script.language import primary
from scorebreath.script.marks import Mark
from scorebreath.script.markup.marked import Markup
from scorebreath.speech.model import Voice
from scorebreath.speech.voices import open_voice

SETTLING = 0.3
"""s from the beginning until the first thing can be decided."""
PATIENCE = 10.0
"""s that threads get to end."""


class Sounder(Plays, Protocol):
    """What sounds, and when its second 0 is."""

    def begin(self, start_unix: float) -> None:
        """Say when second 0 is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Setting:
    """What a show begins with."""

    voice: str = "espeak"
    model: str = "natural"
    language: str = "en"
    parameters: Parameters = field(default_factory=Parameters)
    states: Mapping[str, float] = field(default_factory=dict)
    """the first body's, with their intensities"""
    cast: Mapping[str, Parameters] = field(default_factory=dict)
    """others who are there from the beginning, by the names of their voices"""
    seed: int = 0
    markup: Markup = "auto"
    breaths: Path | None = None
    """folder of recorded breaths"""
    take: Path | None = None
    """folder that everything is written to; None: nothing is"""
    lead: float = 0.5
    """s before the first breath"""
    tail: float = 1.0
    """s after the last body has come to rest"""


class Show:
    """A performance that runs by itself, until it is over or closed; use it as a context manager.

    `show.desk.say("Good evening.")`, `show.desk.command("end")`, `show.wait()`.

    Args:
        setting: What it begins with.
        sounder: What sounds; it is told when second 0 is, and stays the caller's to close.
        timing: How far ahead things are decided.
        tell: Told, by any thread, what somebody should know.
        open_voice: Opens voices; it closes them.
        now: The Unix time.

    Raises:
        InputError: A setting is wrong.
        VoiceError: A voice is not installed, or does not work.
        EnvironmentFailure: The take cannot be written.
    """

    def __init__(
        self,
        setting: Setting,
        *,
        sounder: Sounder,
        timing: Timing | None = None,
        tell: Callable[[str], None] = lambda _: None,
        open_voice: Callable[[str, str], Voice] = open_voice,
        now: Callable[[], float] = time.time,
    ) -> None:
        """Open voices and take; then time begins."""
        self.setting, self.timing = setting, timing or Timing()
        self._sounder, self._tell, self._now = sounder, tell, now
        self._open, self._voices = open_voice, dict[str, Voice]()
        self._lock = threading.Lock()
        self._woken = threading.Condition()
        self._poked = self._closed = False
        self._failure: BaseException | None = None
        self.take: TakeWriter | None = None
        try:
            self._set_up()
        except BaseException:
            self._close_all()
            raise
        self._thread = threading.Thread(target=self._run, name="performance", daemon=True)
        self._thread.start()

    def _set_up(self) -> None:
        setting = self.setting
        language, breathing = primary(setting.language), breathing_model(setting.model)
        voice = self._voice("")
        self.media = RecentStore(FolderStore(setting.take) if setting.take else None)
        recordings = self._recordings()
        ensemble = Ensemble(
            breathing=breathing, voice=voice, voices=self._voice, parameters=setting.parameters, cast=setting.cast,
            language=language, seed=setting.seed, recordings=recordings,
        )  # fmt: skip
        bodies = tuple(ensemble.performer(name).body() for name in ("", *setting.cast))
        empty = Score(
            made_by=made_by(), seed=setting.seed, language=language, model=setting.model, text="", duration=0.0,
            bodies=bodies,
        )  # fmt: skip
        self.take = TakeWriter(setting.take, empty) if setting.take else None
        self.ledger = Ledger(empty, self.take)
        begun = begin_states(setting.states)
        plan = Plan(
            model=setting.model, language=language, parameters=setting.parameters, count=voice.syllables,
            seed=setting.seed, cast=setting.cast, begun=begun,
        )  # fmt: skip
        preparer = Preparer(
            Prompter(plan, said=self.ledger.text, problem=self._tell, wordless=self._act),
            voices=self._voice, parameters=self._parameters, media=self.media,
        )  # fmt: skip
        self._backstage = Thread(preparer, self._wake)
        self.performance = Performance(
            Company(ensemble), self._backstage, self.ledger, self._sounder, self.media, timing=self.timing,
            lead=setting.lead, tail=setting.tail, begun=begun, tell=self._tell,
        )  # fmt: skip
        self.desk = Console(self.performance, wake=self._wake, markup=setting.markup)
        self.start_unix = self._now() + self.timing.ahead + SETTLING
        self._sounder.begin(self.start_unix)

    def _parameters(self, voice: str) -> Parameters:
        return self.performance.parameters(voice)

    def _act(self, voice: str, marks: tuple[Mark, ...]) -> None:
        self.desk.act(voice, marks)

    def _recordings(self) -> Recordings | None:
        folder = self.setting.breaths
        return load_recordings(folder, self.media, seed=self.setting.seed) if folder else None

    @property
    def now(self) -> float:
        """Second of the performance; below 0 before it has begun."""
        return self._now() - self.start_unix

    @property
    def counts(self) -> Counts:
        """What happened so far, in numbers."""
        return self.performance.decisions.counts

    @property
    def running(self) -> bool:
        """Whether anything is still to come."""
        return self._thread.is_alive()

    def curves(self) -> dict[str, CurveSet]:
        """The curves of everybody around now."""
        return self.ledger.all_curves()

    def score(self) -> Score:
        """The performance so far."""
        return self.ledger.score()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until all is over.

        Args:
            timeout: s; None: as long as it takes.

        Returns:
            Whether it is.

        Raises:
            ScorebreathError: It could not go on.
        """
        self._thread.join(timeout)
        if self._failure is not None:
            raise self._failure
        return not self._thread.is_alive()

    def close(self) -> None:
        """End now, wherever it is."""
        self.desk.close()
        with self._woken:
            self._closed = True
            self._woken.notify()
        self._thread.join(PATIENCE)
        self._close_all()

    def __enter__(self) -> Self:
        """The show."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """End it."""
        self.close()

    def _run(self) -> None:
        latest = self.now
        try:
            while not self._closed:
                latest = max(latest, self.now)  # a clock that is set back must not undo what was decided
                wake = self.performance.advance(latest)
                if self.performance.over is not None and latest >= self.performance.over:
                    return
                with self._woken:
                    if not self._poked and not self._closed:
                        self._woken.wait(max(0.001, wake - self.now))
                    self._poked = False
        except BaseException as error:  # raised again by whoever waits
            self._failure = error
            self._tell(f"the performance cannot go on: {error}")

    def _wake(self) -> None:
        with self._woken:
            self._poked = True
            self._woken.notify()

    def _voice(self, name: str) -> Voice:
        """A voice, opened when first asked for."""
        with self._lock:
            if self._closed:
                raise InputError("the show is over")
            if name not in self._voices:
                self._voices[name] = self._open(name or self.setting.voice, self.setting.language)
            return self._voices[name]

    def _close_all(self) -> None:
        backstage: Thread | None = getattr(self, "_backstage", None)
        voices = list(self._voices.values())
        for voice in voices:
            voice.close()
        if backstage is not None:
            backstage.close()
        if self.take is not None:
            self.take.close()
