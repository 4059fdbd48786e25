"""Decisions: events are written down, and what sounds is told to the engine. Nothing is ever taken back."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace

from scorebreath.engine.onsets import Onset, onsets
from scorebreath.ensemble import BODY, Ensemble
from scorebreath.expression.interrupted import FACE
from scorebreath.live.conditions import Counts, Sounder, Told
from scorebreath.live.heard import AS_MADE, heard
from scorebreath.live.ledger import Ledger
from scorebreath.media.store import MediaStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import breath_media
from scorebreath.score.events import Cut, Event, Expiration, Hold, Inspiration, Parameter, WarningEvent
from scorebreath.score.performing import GIVES_WAY
from scorebreath.units import snap

BREATHS = (Inspiration, Expiration, Hold)
GENERATORS = 64.0
"""Random generators of an engine."""


class Decisions:
    """What has been decided, by whom it is heard and where it is written.

    Args:
        ensemble: Who performs.
        ledger: Where everything is written.
        sounder: What sounds.
        media: Samples of what is said.
        clock: The time, s.
        tell: Told of what somebody should know.
    """

    def __init__(
        self,
        ensemble: Ensemble,
        ledger: Ledger,
        sounder: Sounder,
        media: MediaStore,
        *,
        clock: Callable[[], float],
        tell: Told,
    ) -> None:
        """Nothing is decided."""
        self.ledger, self.sounder, self.tell = ledger, sounder, tell
        self.counts = Counts()
        self.cuts = 0
        """that were made, those by which silence gives way to speech too"""
        self.heard = dict.fromkeys(ledger.bodies, AS_MADE)
        """by body: what is done to its sound"""
        self.moved: dict[str, float] = {}
        """by body: s; when that was"""
        self.made: dict[str, Parameters] = {}
        """by body: what that was made with which is under way"""
        self._coming: dict[str, deque[tuple[float, Parameters]]] = {}
        self._ensemble, self._media, self._clock = ensemble, media, clock
        self._breaths = 0

    def decide(self, events: Sequence[Event]) -> None:
        """These happen: they are written, and sound."""
        if not events:
            return
        self.ledger.media_used(breath_media(events, self._ensemble.recordings))
        written = self.ledger.events(events, self._clock())
        for body in dict.fromkeys(event.body for event in written):
            own = [event for event in written if event.body == body]
            self._sound(body, [event for event in own if not isinstance(event, (*FACE, Cut, Parameter))])
            for event in own:
                if isinstance(event, Cut):
                    self.cuts += 1
                    self.counts.cuts += event.rule != GIVES_WAY
                    self.sounder.cut(event.onset, event.targets, event.fade)
                elif isinstance(event, Parameter) and event.heard is not None:
                    self.sounder.move(event.onset, body, event.heard, event.glide)
                    self.heard[body], self.moved[body] = event.heard, event.onset
            if begun := [event.onset for event in own if isinstance(event, BREATHS)]:
                coming = self._coming.setdefault(body, deque())
                parameters = self._parameters(body)
                if not coming or coming[-1][1] is not parameters:
                    coming.append((min(begun), parameters))

    def keep_up(self, until: float) -> float:
        """What begins until a time may be made with what was moved meanwhile: its sound is as its events say again.

        Returns:
            When to look again, s.
        """
        following = float("inf")
        for body, coming in self._coming.items():
            while coming and coming[0][0] <= until:
                onset, made = coming.popleft()
                self.made[body] = made
                sounds = heard(made, self._parameters(body))
                if self.heard.setdefault(body, AS_MADE) != sounds:
                    begins = snap(max(onset, self._clock(), self.moved.get(body, 0.0)))
                    self.decide(
                        [
                            Parameter(
                                id=f"{body}.as_made", body=body, onset=begins, duration=0.0,
                                rule="what begins is made otherwise", name="", heard=sounds,
                            )
                        ]
                    )  # fmt: skip
            if coming:
                following = min(following, coming[0][0])
        return following

    def never_happens(self, body: str, since: float) -> None:
        """What would have begun from a time on does not."""
        coming = self._coming.get(body)
        while coming and coming[-1][0] >= since:
            coming.pop()

    def _parameters(self, body: str) -> Parameters:
        return next(who.state.parameters for who in self._ensemble.performers.values() if who.state.body == body)

    def cut(self, body: str, at: float, targets: Sequence[str], fade: float, rule: str) -> None:
        """Events end; for a reason."""
        self.decide(
            [
                Cut(
                    id=f"{body}.cut{self.cuts + 1}", body=body, onset=at, duration=snap(fade),
                    origin="rule" if rule == GIVES_WAY else "performer", rule=rule, targets=tuple(targets),
                    fade=snap(fade),
                )
            ]
        )  # fmt: skip

    def warn(self, code: str, text: str, at: float | None = None) -> None:
        """Say it now, and write it down."""
        self.tell(f"{code}: {text}")
        onset = snap(max(0.0, self._clock() if at is None else at))
        self.decide(
            [WarningEvent(id=f"{BODY}.{code}", body=BODY, onset=onset, duration=0.0, rule=code, code=code, text=text)]
        )

    def _sound(self, body: str, events: Sequence[Event]) -> None:
        sounds: list[Onset] = []
        for sound in onsets(self.ledger.part(body, events)):
            if "rand_id" not in sound.controls:
                sounds.append(sound)
                continue
            own = {"rand_id": float(self._breaths % GENERATORS)}  # breaths that overlap must not share one
            sounds.append(replace(sound, controls={**sound.controls, **own}))
            self._breaths += 1
        if sounds:
            self.sounder.play(sounds, self._media)
