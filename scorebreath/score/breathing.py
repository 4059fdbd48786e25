"""Events of breathing: air in, air out, air held."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from scorebreath.errors import ScoreError
from scorebreath.score.event import Event, Part, Profile
from scorebreath.score.values import FORWARD, SHARE, Limits, Number, Whole, limits

TOLERANCE = 5e-6
"""s that the parts of a breath may miss its whole by, each being rounded to the grid."""
VOLUME = (0.0, 2.0)
"""Limits of a lung volume, fraction of VC: the papers' capacity goes up to 200 %."""
GAIN = (0.0, 1000.0)
PEAK = (0.05, 0.95)
PUFF_SHARE = 0.6
"""Share of the time between two laugh puffs in which air flows."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trapezoid(Part):
    """Linear attack to 1, hold, linear release to 0 (B46; ramps: physiology 3.3)."""

    limits: ClassVar[Limits] = limits(attack=FORWARD, hold=FORWARD, release=FORWARD)

    attack: Number
    """s"""
    hold: Number
    """s"""
    release: Number
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise(Part):
    """The audible part of a breath; its length is its own, apart from the movement's."""

    limits: ClassVar[Limits] = limits(
        onset=FORWARD,
        duration=FORWARD,
        attack=FORWARD,
        hold=FORWARD,
        release=FORWARD,
        level_db=(-200.0, 40.0),
        seed=(1, 2**24 - 1),
        brightness=(0.25, 4.0),
    )

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
    """dB of a unit gain, relative to the voice's reference: RMS over the hold, or of the envelope `flow` over the part
    that is at least half as loud as its loudest"""
    seed: Whole
    """of the engine's noise, 1..2^24-1"""
    source: str = "synth"
    """`synth`, or the SHA-256 of a recording in the media"""
    source_nose: str = ""
    """the same for what sounds through the nose, where that is something else; empty: as `source`"""
    envelope: Literal["trapezoid", "flow"] = "trapezoid"
    """`trapezoid`: straight ramps (B46); `flow`: amplitude goes with flow^1.66, the flow rising over the attack and
    falling over the release by a quarter of a sine each (physiology 3.3)"""
    brightness: Number = 1.0
    """scales resonances and tilt: faster air sounds brighter (physiology 3.1)"""

    def __post_init__(self) -> None:
        """Check the numbers, and that the ramps fill the noise.

        Raises:
            ScoreError: Attack, hold and release are not as long as the noise.
        """
        super(Noise, self).__post_init__()  # zero-argument super() breaks under dataclass slots
        whole = self.attack + self.hold + self.release
        if abs(whole - self.duration) > TOLERANCE:
            raise ScoreError(f"Noise: attack + hold + release = {whole:g} s, but duration = {self.duration:g} s")


@dataclass(frozen=True, slots=True, kw_only=True)
class Lead(Part):
    """How long the face moves ahead of the flow."""

    limits: ClassVar[Limits] = limits(mouth=(0.0, 0.5), nostril=(0.0, 0.5))

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
    tremor: Number = 0.0
    """share by which `thorax` trembles, 0..1 (physiology 4.2)"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Breath(Event):
    """Air that moves: what inspirations and expirations share."""

    limits: ClassVar[Limits] = limits(
        from_volume=VOLUME,
        to_volume=VOLUME,
        peak=PEAK,
        thorax_share=SHARE,
        sound_nose=GAIN,
        sound_mouth=GAIN,
        nostril_flare=SHARE,
        mouth_open=SHARE,
    )
    from_volume: Number
    """fraction of VC"""
    to_volume: Number
    """fraction of VC"""
    profile: Profile = "linear"
    peak: Number = 0.5
    """where a `sine`'s flow is highest, share of the duration"""
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
    noise: Noise | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Inspiration(Breath):
    """Air in: volume, face, two sounds (B4-B11)."""

    type: ClassVar[str] = "inspiration"
    limits: ClassVar[Limits] = limits(saccades=(1, 20))
    kind: Literal["speech", "tidal", "gasp", "sigh", "sniff"] = "speech"
    saccades: Whole = 1
    """the volume is drawn in so many equal gasps, each with the profile and the noise of a whole breath made shorter"""
    face: Trapezoid
    """of nostrils and mouth from the onset on; a lead lengthens the attack backwards"""
    lead: Lead


@dataclass(frozen=True, slots=True, kw_only=True)
class Expiration(Breath):
    """Air out, during speech or by itself (B12)."""

    type: ClassVar[str] = "expiration"
    kind: Literal["speech", "tidal", "audible", "sigh", "laugh"] = "speech"
    sound_nose: Number = 0.0
    sound_mouth: Number = 1.0
    nostril_flare: Number = 0.0
    mouth_open: Number = 0.0
    face: Trapezoid | None = None
    """of nostrils and mouth, from the onset on; None: they do not move"""
    puffs: tuple[Number, ...] = ()
    """onsets of laugh puffs, s, ascending: an equal share of the volume leaves in each, by `profile`, within
    `PUFF_SHARE` of the time to the next one (or to the end); `noise` sounds in each of them"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Hold(Event):
    """The breath is held: volume stays where it is."""

    type: ClassVar[str] = "hold"
    limits: ClassVar[Limits] = limits(volume=VOLUME, thorax_share=SHARE)
    kind: Literal["rest", "held"] = "rest"
    """`rest`: nothing happens; `held`: the throat is shut on purpose"""
    volume: Number
    """fraction of VC"""
    thorax_share: Number
    motion: Motion
    noise: Noise | None = None
    """the throat's catch as it shuts, of a breath that is held"""
