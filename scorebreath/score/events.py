"""The events of a Score: what one body does, when, and by which rule.

All times inside an event are seconds relative to its own onset: moving a group changes one number. `source` is a
half-open range of Unicode code points of the Score's text. Volumes are fractions of vital capacity above residual
volume. Degrees: chin and gaze up, the character's own left, and roll towards its right shoulder are positive.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, ClassVar, Literal

from pydantic import ConfigDict

from scorebreath.score.values import Flag, Gridded, Number, Whole

Origin = Literal["rule", "markup", "user", "performer"]
Closing = Literal["final", "continuing", "question"]
SentenceType = Literal["statement", "question", "exclamation"]
Profile = Literal["linear", "sine"]
PauseKind = Literal["breath", "edge", "phrase", "sentence", "paragraph", "hesitation", "start", "end"]
Extension = Mapping[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Part(Gridded):
    """A value inside an event."""

    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid")


@dataclass(frozen=True, slots=True, kw_only=True)
class Event(Gridded):
    """What all events share."""

    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid")
    type: ClassVar[str] = ""

    id: str
    """Unique in the Score."""
    body: str
    """The body that does it."""
    onset: Number
    """Seconds from the Score's start."""
    duration: Number
    """Seconds."""
    group: str | None = None
    """The breath group it belongs to."""
    origin: Origin = "rule"
    """Who asked for it."""
    rule: str = ""
    """The rule's name, and why where it says more."""
    x: Extension = field(default_factory=dict)
    """Unknown `x_` fields, kept as they came."""

    @property
    def end(self) -> float:
        """Onset plus duration, seconds."""
        return self.onset + self.duration


# Parts of breathing


@dataclass(frozen=True, slots=True, kw_only=True)
class Trapezoid(Part):
    """Linear attack to 1, hold, linear release to 0 (B46; ramps: physiology 3.3)."""

    attack: Number
    """s"""
    hold: Number
    """s"""
    release: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise(Part):
    """The audible part of a breath; its length is its own, apart from the movement's."""

    onset: Number
    """s from the event's onset"""
    duration: Number
    """s; attack + hold + release"""
    attack: Number
    """s"""
    hold: Number
    """s"""
    release: Number
    """s"""
    level_db: Number
    """dB of a unit gain over the hold, relative to the voice's reference"""
    seed: Whole
    """of the engine's noise, 1..2^24-1"""
    source: str = "synth"
    """`synth`, or the SHA-256 of a recording in the media"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lead(Part):
    """How long the face moves ahead of the flow."""

    mouth: Number = 0.0
    """s, at most the reach of an inspiration"""
    nostril: Number = 0.0
    """s, at most the reach of an inspiration"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion(Part):
    """What one unit of volume above the resting level moves (B6-B8, B25): the driver times these."""

    thorax: Number
    """shape weight"""
    abdomen: Number
    """shape weight"""
    shoulder: Number
    """shape weight"""
    neck_pitch: Number
    """degrees, chin up positive"""


# Breathing


@dataclass(frozen=True, slots=True, kw_only=True)
class Inspiration(Event):
    """Air in: volume, face, two sounds (B4-B11)."""

    type: ClassVar[str] = "inspiration"
    kind: Literal["speech", "tidal", "gasp", "sigh", "sniff"] = "speech"
    from_volume: Number
    """fraction of VC"""
    to_volume: Number
    """fraction of VC"""
    profile: Profile = "linear"
    """`linear`: constant flow (the papers' LF); `sine`: half-sine flow"""
    thorax_share: Number
    """share of the volume that the thorax takes, 0..1"""
    motion: Motion
    sound_nose: Number
    """gain 0.. of the nose's sound"""
    sound_mouth: Number
    """gain 0.. of the mouth's sound"""
    nostril_flare: Number
    """maximum, 0..1"""
    mouth_open: Number
    """maximum, 0..1"""
    face: Trapezoid
    """of nostrils and mouth from the onset on; a lead lengthens the attack backwards"""
    lead: Lead
    noise: Noise | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Expiration(Event):
    """Air out, during speech or by itself (B12)."""

    type: ClassVar[str] = "expiration"
    kind: Literal["speech", "tidal", "audible", "sigh", "laugh"] = "speech"
    from_volume: Number
    """fraction of VC"""
    to_volume: Number
    """fraction of VC"""
    profile: Profile = "linear"
    thorax_share: Number
    motion: Motion
    noise: Noise | None = None
    puffs: tuple[Number, ...] = ()
    """onsets of laugh puffs, s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Hold(Event):
    """The breath is held: volume stays where it is."""

    type: ClassVar[str] = "hold"
    volume: Number
    """fraction of VC"""
    thorax_share: Number
    motion: Motion


# Speech


@dataclass(frozen=True, slots=True, kw_only=True)
class Word(Part):
    """A word as it is spoken."""

    text: str
    onset: Number
    """s"""
    duration: Number
    """s"""
    source: tuple[Whole, Whole] | None = None
    """code points of the Score's text"""
    accent: Flag = False
    merged: Flag = False
    """spoken as one with its neighbours ("was the")"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Phone(Part):
    """A phone; phones are contiguous over the utterance, pauses among them."""

    ipa: str
    """International Phonetic Alphabet; empty for a pause"""
    onset: Number
    """s"""
    duration: Number
    """s"""
    stress: Whole = 0
    """0 none, 1 primary, 2 secondary"""
    word: Whole | None = None
    """index among the utterance's words"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pitch(Part):
    """Fundamental frequency, one value a step, the first at half a step."""

    step: Number
    """s"""
    hertz: tuple[Number, ...]
    """0 where unvoiced"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Level(Part):
    """Level of the sound, one value a step, the first at half a step."""

    step: Number
    """s"""
    db: tuple[Number, ...]
    """dB re full scale, of the media as stored"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Utterance(Event):
    """The speech of one breath group."""

    type: ClassVar[str] = "utterance"
    media: str
    """SHA-256 of the samples"""
    gain_db: Number
    """dB"""
    closing: Closing
    words: tuple[Word, ...]
    phones: tuple[Phone, ...]
    pitch: Pitch
    level: Level


@dataclass(frozen=True, slots=True, kw_only=True)
class Phrase(Event):
    """An intonational phrase, or what stands for one (a line of verse)."""

    type: ClassVar[str] = "phrase"
    source: tuple[Whole, Whole]
    break_index: Whole
    tone: str = ""
    position: Literal["internal", "final"]
    sentence_type: SentenceType
    line: Whole | None = None
    stanza: Whole | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Pause(Event):
    """Silence between groups or inside one."""

    type: ClassVar[str] = "pause"
    kind: PauseKind


# Face and state


@dataclass(frozen=True, slots=True, kw_only=True)
class Emotion(Event):
    """An emotion that rises to its apex and falls."""

    type: ClassVar[str] = "emotion"
    name: str
    apex: Number
    """s"""
    intensity: Number
    """0..1"""
    phrases: tuple[str, ...] = ()
    """ids of the phrases it spans"""


@dataclass(frozen=True, slots=True, kw_only=True)
class State(Event):
    """A breathing state (anxious, exertion, ...) that moves from one intensity to another."""

    type: ClassVar[str] = "state"
    name: str
    start: Number
    """intensity at the onset, 0..1"""
    target: Number
    """intensity after the ramp, 0..1"""
    ramp: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Blink(Event):
    """Lids close, stay, open."""

    type: ClassVar[str] = "blink"
    left: Number
    """amplitude, 0..1"""
    right: Number
    close: Number
    """s"""
    hold: Number
    """s"""
    open: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Brow(Event):
    """Brows rise or frown and come back."""

    type: ClassVar[str] = "brow"
    left: Number
    right: Number
    frown: Number
    apex: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Head(Event):
    """The head turns and comes back."""

    type: ClassVar[str] = "head"
    pitch: Number
    """degrees"""
    yaw: Number
    roll: Number
    apex: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Gaze(Event):
    """The eyes go to a target, in the chest's frame."""

    type: ClassVar[str] = "gaze"
    target: str
    yaw: Number
    """degrees"""
    pitch: Number
    """degrees"""


# Performance


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter(Event):
    """A parameter was moved."""

    type: ClassVar[str] = "parameter"
    name: str
    value: Number
    glide: Number = 0.0
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Command(Event):
    """A performer's command."""

    type: ClassVar[str] = "command"
    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Cut(Event):
    """An interruption: the targets end here, whatever they said."""

    type: ClassVar[str] = "cut"
    targets: tuple[str, ...]
    """event ids"""
    fade: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class WarningEvent(Event):
    """Something the reader of the Score should know."""

    type: ClassVar[str] = "warning"
    code: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Marker(Event):
    """A named place in time."""

    type: ClassVar[str] = "marker"
    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Unknown(Event):
    """An event of a type that begins with `x_`: kept whole, understood by nobody here."""

    kind: str
    """its type"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reach:
    """How far outside its own time an event changes anything."""

    lead: float
    """s before its onset"""
    lag: float
    """s after its end"""


EVENTS: Mapping[str, tuple[type[Event], Reach]] = MappingProxyType(
    {
        kind.type: (kind, Reach(lead=lead, lag=lag))
        for kind, lead, lag in (
            (Inspiration, 0.5, 0.0),
            (Expiration, 0.0, 0.0),
            (Hold, 0.0, 0.0),
            (Utterance, 0.5, 0.5),
            (Phrase, 0.0, 0.0),
            (Pause, 0.0, 0.0),
            (Emotion, 0.0, 0.0),
            (State, 0.0, 0.0),
            (Blink, 0.0, 0.0),
            (Brow, 0.0, 0.0),
            (Head, 0.0, 0.0),
            (Gaze, 0.0, 0.0),
            (Parameter, 0.0, 0.0),
            (Command, 0.0, 0.0),
            (Cut, 0.0, 0.0),
            (WarningEvent, 0.0, 0.0),
            (Marker, 0.0, 0.0),
        )
    }
)
"""Every type of event with its reach: it changes nothing outside `[onset - lead, end + lag]`."""
