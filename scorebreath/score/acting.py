"""Events of face and state: emotion, breathing states, blinks, brows, head, gaze.

What rises and falls does so without a step and with its speed limited where it is planned: brows and head by
`equations.shapes.rise_and_fall`, blinks likewise, the eyes by `equations.shapes.smooth_step`, emotions by straight
ramps (A41). Outside its own time an event changes nothing; gaze events touch one another.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from scorebreath.errors import ScoreError
from scorebreath.score.event import Event
from scorebreath.score.values import FORWARD, SHARE, Limits, Number, limits

TURN = (-90.0, 90.0)
"""Limits of an angle of head or gaze, degrees."""
TOLERANCE = 5e-6
"""s that the parts of a movement may miss its whole by, each being rounded to the grid."""
EMOTIONS = ("happy", "kidding", "sad", "angry", "surprised", "disgusted", "afraid")
"""The emotions a face knows: those of the emoticons (A11), and fear. Each is a channel of the curves."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Emotion(Event):
    """An emotion that rises to its apex and falls, both in a straight line (A40, A41)."""

    type: ClassVar[str] = "emotion"
    limits: ClassVar[Limits] = limits(apex=FORWARD, intensity=SHARE)
    name: str
    """one of `EMOTIONS`; a name that is none of them moves nothing"""
    apex: Number
    """s, within the duration"""
    intensity: Number
    """0..1 at the apex"""
    phrases: tuple[str, ...] = ()
    """ids of the phrases it spans (A42)"""

    def __post_init__(self) -> None:
        """Check the numbers, and that the apex is inside.

        Raises:
            ScoreError: It is not.
        """
        super(Emotion, self).__post_init__()  # zero-argument super() breaks under dataclass slots
        _inside(self, "apex", self.apex)


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
    recovery: Number = 0.0
    """time constant with which it fades by itself after the ramp, s; 0: it stays"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Blink(Event):
    """Lids close, stay, open; as long as the three together. A wink closes one side alone."""

    type: ClassVar[str] = "blink"
    limits: ClassVar[Limits] = limits(left=SHARE, right=SHARE, close=FORWARD, hold=FORWARD, open=FORWARD)
    left: Number
    """how far it closes, 0..1 of the way from where the lid is"""
    right: Number
    close: Number
    """s"""
    hold: Number
    """s"""
    open: Number
    """s"""

    def __post_init__(self) -> None:
        """Check the numbers, and that the phases fill the blink.

        Raises:
            ScoreError: They do not.
        """
        super(Blink, self).__post_init__()  # zero-argument super() breaks under dataclass slots
        _fills(self, "close + hold + open", self.close + self.hold + self.open)


@dataclass(frozen=True, slots=True, kw_only=True)
class Brow(Event):
    """Brows rise or frown, stay, and come back."""

    type: ClassVar[str] = "brow"
    limits: ClassVar[Limits] = limits(left=SHARE, right=SHARE, frown=SHARE, apex=FORWARD, hold=FORWARD)
    left: Number
    """how far it is raised, 0..1"""
    right: Number
    frown: Number
    """how far the brows are drawn together, 0..1"""
    apex: Number
    """s from the onset until it is there"""
    hold: Number = 0.0
    """s that it stays; the rest of the duration brings it back"""

    def __post_init__(self) -> None:
        """Check the numbers, and that the movement fits.

        Raises:
            ScoreError: It does not.
        """
        super(Brow, self).__post_init__()  # zero-argument super() breaks under dataclass slots
        _inside(self, "apex + hold", self.apex + self.hold)


@dataclass(frozen=True, slots=True, kw_only=True)
class Head(Event):
    """The head turns, stays, and comes back; added to what else moves it."""

    type: ClassVar[str] = "head"
    limits: ClassVar[Limits] = limits(pitch=TURN, yaw=TURN, roll=TURN, apex=FORWARD, hold=FORWARD)
    pitch: Number
    """degrees, chin up +"""
    yaw: Number
    """degrees, to the character's left +"""
    roll: Number
    """degrees, towards the character's right shoulder +"""
    apex: Number
    """s from the onset until it is there"""
    hold: Number = 0.0
    """s that it stays; the rest of the duration brings it back"""

    def __post_init__(self) -> None:
        """Check the numbers, and that the movement fits.

        Raises:
            ScoreError: It does not.
        """
        super(Head, self).__post_init__()  # zero-argument super() breaks under dataclass slots
        _inside(self, "apex + hold", self.apex + self.hold)


@dataclass(frozen=True, slots=True, kw_only=True)
class Gaze(Event):
    """The eyes go to a target and stay there until the next gaze event.

    Angles are in the chest's frame: whatever the head does meanwhile, the eyes make up for it. Outside any gaze event
    the eyes look straight ahead, at (0, 0).
    """

    type: ClassVar[str] = "gaze"
    limits: ClassVar[Limits] = limits(yaw=TURN, pitch=TURN, from_yaw=TURN, from_pitch=TURN, move=FORWARD)
    target: str
    """what is looked at: `listener`, `away`, `up`, `down`, ..."""
    yaw: Number
    """degrees, to the character's left +"""
    pitch: Number
    """degrees, up +"""
    from_yaw: Number = 0.0
    """where the eyes come from, degrees: the target of the gaze event before, if that ends here"""
    from_pitch: Number = 0.0
    move: Number
    """s that the eyes need (the saccade)"""

    def __post_init__(self) -> None:
        """Check the numbers, and that the eyes arrive.

        Raises:
            ScoreError: They do not.
        """
        super(Gaze, self).__post_init__()  # zero-argument super() breaks under dataclass slots
        _inside(self, "move", self.move)


def _inside(event: Event, what: str, seconds: float) -> None:
    if seconds > event.duration + TOLERANCE:
        raise ScoreError(
            f"{type(event).__name__} {event.id!r}: {what} = {seconds:g} s must be at most its duration, "
            f"{event.duration:g} s"
        )


def _fills(event: Event, what: str, seconds: float) -> None:
    if abs(seconds - event.duration) > TOLERANCE:
        raise ScoreError(
            f"{type(event).__name__} {event.id!r}: {what} = {seconds:g} s, but duration = {event.duration:g} s"
        )
