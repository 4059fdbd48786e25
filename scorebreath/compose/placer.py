"""Places events one after the other in a body's time and lungs: volume never jumps, and nothing overlaps."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Literal

from scorebreath.compose import parts, sounds, timing
from scorebreath.compose.chances import Chances
from scorebreath.compose.feeling import Feeling, Feels
from scorebreath.compose.lungs import TOP, Levels
from scorebreath.compose.sounds import Air
from scorebreath.compose.state import BodyState
from scorebreath.equations.shapes import HIGHEST_FLOW
from scorebreath.parameters.derive import LowLevel
from scorebreath.parameters.modifiers import Modifiers
from scorebreath.parameters.table import Parameters
from scorebreath.score.breathing import PUFF_SHARE
from scorebreath.score.event import Origin, PauseKind, Profile
from scorebreath.score.events import (
    Event,
    Expiration,
    Hold,
    Inspiration,
    Marker,
    Noise,
    Pause,
    State,
    WarningEvent,
)
from scorebreath.script.marks import NamedMark, StateMark
from scorebreath.units import snap

InspirationKind = Literal["speech", "tidal", "gasp", "sigh", "sniff"]
ExpirationKind = Literal["speech", "tidal", "audible", "sigh", "laugh"]


@dataclass(slots=True, kw_only=True)
class Placer:
    """A body as its next events are placed.

    Everything is placed at `time`, from `volume` on, and moves both.
    """

    state: BodyState
    id: str
    """what ids of events begin with"""
    chances: Chances
    feels: Feels
    """the breathing model's"""
    group: str | None = None
    events: list[Event] = field(default_factory=list)
    time: float = 0.0
    """s"""
    volume: float = 0.0
    """fraction of VC"""
    feeling: Feeling = field(init=False)
    """as it is now"""
    _named: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Begin where the body is."""
        self.time, self.volume = self.state.time, self.state.volume
        self.feel()

    @property
    def p(self) -> Parameters:
        """The parameters."""
        return self.state.parameters

    @property
    def modifiers(self) -> Modifiers:
        """What person and states change."""
        return self.feeling.modifiers

    @property
    def levels(self) -> Levels:
        """The volumes it keeps to."""
        return self.feeling.levels

    @property
    def low(self) -> LowLevel:
        """The low-level parameters of the moment."""
        return self.feeling.low

    def feel(self) -> None:
        """Take on the states of the moment."""
        self.feeling = self.feels(self.state, self.time)

    def done(self, **changes: Any) -> tuple[BodyState, list[Event]]:
        """The body afterwards, and what was placed."""
        return replace(self.state, time=self.time, volume=self.volume, **changes), self.events

    def name(self, what: str) -> str:
        """An id that nothing else has: `what`, then `what2`, ..."""
        self._named[what] = self._named.get(what, 0) + 1
        number = self._named[what]
        return f"{self.id}.{what}" if number == 1 else f"{self.id}.{what}{number}"

    def inhale(
        self,
        what: str,
        to: float,
        length: float,
        *,
        rule: str,
        kind: InspirationKind = "speech",
        air: Air | None = None,
        nose: float | None = None,
        mouth: float | None = None,
        opening: float = 1.0,
        peak: float = sounds.PEAK,
        saccades: int = 1,
        origin: Origin = "rule",
    ) -> None:
        """Breathe in to a volume.

        Args:
            what: Beginning of its id.
            to: Fraction of VC, at most 0.95.
            length: s; made longer where the air would be too fast.
            rule: Why.
            kind: What it is.
            air: How it sounds, where not as its flow says: its flow, length and gains are filled in here.
            nose: Gain of the nose's sound; None: as the parameters say.
            mouth: The same of the mouth's.
            opening: x opening of mouth and nostrils.
            peak: Where the flow is highest.
            saccades: Parts it is drawn in.
            origin: Who asked for it.
        """
        to = snap(min(TOP, max(to, self.volume)))
        moved = to - self.volume
        length = snap(timing.unhurried(length, moved, self.state.person.vital_capacity))
        nose = self.low.amplitude_sound_nose if nose is None else nose
        mouth = self.low.amplitude_sound_mouth if mouth is None else mouth
        flow = moved / length * HIGHEST_FLOW["sine"] if length > 0 else 0.0
        air = replace(air or Air(), flow=flow, length=length, nose=nose, mouth=mouth, peak=peak)
        noise = sounds.noise(self.state, self.modifiers, self.chances, air, purpose=f"{what}.noise")
        nostril, lips = self._face(opening, nose, mouth)
        self.events.append(
            Inspiration(
                id=self.name(what), body=self.state.body, group=self.group, onset=self.time, duration=length,
                origin=origin, rule=rule, kind=kind, from_volume=self.volume, to_volume=to, profile="sine",
                peak=snap(peak), saccades=saccades, thorax_share=self.feeling.thorax_share, motion=self.feeling.motion,
                sound_nose=snap(nose), sound_mouth=snap(mouth), nostril_flare=nostril, mouth_open=lips,
                face=parts.ramps(length), lead=self.feeling.lead, noise=noise,
            )
        )  # fmt: skip
        self._move(length, to)

    def exhale(
        self,
        what: str,
        to: float,
        length: float,
        *,
        rule: str,
        kind: ExpirationKind,
        air: Air | None = None,
        nose: float = 0.0,
        mouth: float = 1.0,
        opening: float = 0.0,
        profile: Profile = "sine",
        peak: float = 0.3,
        puffs: tuple[float, ...] = (),
        origin: Origin = "rule",
    ) -> None:
        """Breathe out to a volume, heard where `air` is given."""
        to = snap(min(self.volume, max(self.levels.floor, to)))
        moved = self.volume - to
        steepness = HIGHEST_FLOW[profile] / (PUFF_SHARE if puffs else 1.0)
        length = snap(timing.unhurried(length, moved, self.state.person.vital_capacity, steepness))
        noise = None
        if air is not None:
            sounding = length * PUFF_SHARE / len(puffs) if puffs else length
            flow = moved / length * steepness if length > 0 else 0.0
            air = replace(air, flow=flow, length=sounding, nose=nose, mouth=mouth, peak=peak)
            noise = sounds.noise(self.state, self.modifiers, self.chances, air, purpose=f"{what}.noise")
        nostril, lips = self._face(opening, nose, mouth)
        moving = nostril + lips > 0
        self.events.append(
            Expiration(
                id=self.name(what), body=self.state.body, group=self.group, onset=self.time, duration=length,
                origin=origin, rule=rule, kind=kind, from_volume=self.volume, to_volume=to, profile=profile,
                peak=snap(peak), thorax_share=self.feeling.thorax_share, motion=self.feeling.motion,
                sound_nose=snap(nose),
                sound_mouth=snap(mouth), nostril_flare=nostril, mouth_open=lips,
                face=parts.ramps(length) if moving else None, noise=noise, puffs=tuple(snap(puff) for puff in puffs),
            )
        )  # fmt: skip
        self._move(length, to)

    def spend(self, onset: float, duration: float, to: float, rule: str) -> None:
        """Breathe out while speaking; time is where the speech ends."""
        to = snap(min(to, self.volume))
        self.events.append(
            Expiration(
                id=self.name("out"), body=self.state.body, group=self.group, onset=onset, duration=duration, rule=rule,
                from_volume=self.volume, to_volume=to, thorax_share=self.feeling.thorax_share,
                motion=self.feeling.motion,
            )
        )  # fmt: skip
        self.time, self.volume = snap(onset + duration), to

    def hold(
        self, what: str, length: float, *, rule: str, origin: Origin = "rule", held: bool = False,
        noise: Noise | None = None,
    ) -> None:  # fmt: skip
        """Keep the volume."""
        if length <= 0:
            return
        self.events.append(
            Hold(
                id=self.name(what), body=self.state.body, group=self.group, onset=self.time, duration=snap(length),
                origin=origin, rule=rule, kind="held" if held else "rest", volume=self.volume,
                thorax_share=self.feeling.thorax_share, motion=self.feeling.motion, noise=noise,
            )
        )  # fmt: skip
        self._move(length, self.volume)

    def pause(self, what: str, kind: PauseKind, length: float, *, rule: str, origin: Origin = "rule") -> None:
        """Say that from now on nobody speaks; moves no time."""
        self.events.append(
            Pause(
                id=self.name(what), body=self.state.body, group=self.group, onset=self.time, duration=snap(length),
                origin=origin, rule=rule, kind=kind,
            )
        )  # fmt: skip

    def marker(self, mark: NamedMark, at: float) -> None:
        """A named place."""
        self.events.append(
            Marker(
                id=self.name("mark"), body=self.state.body, group=self.group, onset=at, duration=0.0, origin="markup",
                rule=mark.written, name=mark.name,
            )
        )  # fmt: skip

    def warn(self, code: str, text: str, length: float = 0.0) -> None:
        """Say that something is not as it should be."""
        self.events.append(
            WarningEvent(
                id=self.name("warning"), body=self.state.body, group=self.group, onset=self.time, duration=length,
                rule=code, code=code, text=text,
            )
        )  # fmt: skip

    def change(self, mark: StateMark, at: float) -> None:
        """A state begins to change."""
        if not self.feeling.lives:
            self.warn("no-states", f"{mark.written}: the papers' models have no states; natural has")
            return
        blend, changes = self.state.blend.changed(at, mark.name, mark.intensity, mark.ramp, held=mark.held)
        self.state = replace(self.state, blend=blend)
        for each in changes:
            self.events.append(
                State(
                    id=self.name("state"), body=self.state.body, group=self.group, onset=at, duration=snap(each.ramp),
                    origin="markup", rule=mark.written, name=each.name, start=snap(each.start),
                    target=snap(each.target), ramp=snap(each.ramp), recovery=snap(each.recovery),
                )
            )  # fmt: skip

    def _face(self, opening: float, nose: float, mouth: float) -> tuple[float, float]:
        """Nostrils and mouth open where air goes; both keep still where `opening` is 0."""
        nostril, lips = parts.face(self.p, self.low, flare=self.modifiers.flare * opening, opening=opening)
        silent = nose + mouth == 0.0
        return (nostril if nose > 0 or silent else 0.0), (lips if mouth > 0 or silent else 0.0)

    def _move(self, length: float, to: float) -> None:
        self.time, self.volume = snap(self.time + snap(length)), to
