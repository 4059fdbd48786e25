"""What all events of a Score share.

All times inside an event are seconds relative to its own onset: moving a group changes one number. `source` is a
half-open range of Unicode code points of the Score's text. Volumes are fractions of vital capacity above residual
volume. Degrees: chin and gaze up, the character's own left, and roll towards its right shoulder are positive.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

from pydantic import ConfigDict

from scorebreath.score.values import FORWARD, Gridded, Limits, Number, limits

Origin = Literal["rule", "markup", "user", "performer"]
Closing = Literal["final", "continuing", "question"]
SentenceType = Literal["statement", "question", "exclamation"]
Profile = Literal["linear", "sine", "exponential"]
"""How volume goes from one level to another: `linear` at constant flow (the papers' LF); `sine` with a flow that rises
to its highest at `peak` and falls to 0, a quarter of a sine each; `exponential` by the chest's own recoil."""
PauseKind = Literal["breath", "edge", "phrase", "sentence", "paragraph", "hesitation", "start", "end", "asked"]
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
    limits: ClassVar[Limits] = limits(onset=FORWARD, duration=FORWARD)

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
