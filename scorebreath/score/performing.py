"""Events of performance: what was moved, commanded, cut, warned of and marked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from scorebreath.score.event import Event, Part
from scorebreath.score.values import FORWARD, Limits, Number, limits

GIVES_WAY = "gives way"
"""Rule of a cut that interrupts nobody: a breath at rest ends, for there is something to say."""
MOST_HEARD = 16.0
"""Times that a move may make what sounds louder or brighter."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Heard(Part):
    """What a move does to what sounds already: ratios to what its events say, each a control bus of the body."""

    limits: ClassVar[Limits] = limits(
        speech=(0.0, MOST_HEARD), mouth=(0.0, MOST_HEARD), nose=(0.0, MOST_HEARD), brightness=(0.25, 4.0)
    )

    speech: Number = 1.0
    """gain of speech"""
    mouth: Number = 1.0
    """gain of breaths through the mouth, and of recorded ones"""
    nose: Number = 1.0
    """gain of breaths through the nose"""
    brightness: Number = 1.0
    """x resonances and tilt of breaths"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter(Event):
    """A parameter was moved: the plan follows from the next breath group on, what sounds as `heard` says."""

    type: ClassVar[str] = "parameter"
    limits: ClassVar[Limits] = limits(glide=FORWARD)

    name: str
    value: Number | None = None
    """of one that is a number"""
    text: str = ""
    """of one that is a word, or `true` or `false`; empty without a value: back to what the others make of it"""
    glide: Number = 0.0
    """s in which the sound follows"""
    heard: Heard | None = None
    """what the sound comes to, from the event's onset in `glide` seconds, until another one says otherwise; None: as
    before"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Command(Event):
    """A performer's command."""

    type: ClassVar[str] = "command"
    name: str
    text: str = ""
    """what it says besides its name"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Cut(Event):
    """An interruption: the targets end here, whatever they said.

    Those that would begin later never happen. Breaths end at once: what its body does next begins at the onset, from
    the volume that there is. Sounds fade out in `fade` seconds. The duration is the fade. Until its onset a cut changes
    nothing: what stands before it in the Score is seen coming, what stands behind it and begins with it is not.
    """

    type: ClassVar[str] = "cut"
    limits: ClassVar[Limits] = limits(fade=FORWARD)

    targets: tuple[str, ...]
    """event ids, of the same body"""
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
