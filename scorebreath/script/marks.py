"""Marks: what markup asks for at a place in the text, apart from the words themselves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

ActName = Literal["breath", "sigh", "gasp", "sniff", "laugh", "exhale", "hold", "pause"]
LONG_PAUSE = 4.0
"""s; a pause from here on is too long to hold the breath: the body breathes at rest in it, and a new group begins."""
DIVIDING: frozenset[ActName] = frozenset({"breath", "sigh", "gasp", "laugh", "exhale"})
"""Acts behind which a new breath is taken, or that are one: a breath group ends before them. `sniff`, `hold`, `pause`
only part what is said on one breath."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """Stands between two words, or before the first, or after the last."""

    at: int
    """code points of the Script's text before it"""
    written: str
    """the tag as written, such as `[sigh]`"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Act(Mark):
    """The body does something besides speaking."""

    name: ActName
    seconds: float | None = None
    """how long; None: as the body does it by itself"""
    level_db: float = 0.0
    """louder or softer than by itself"""
    length: float = 1.0
    """longer or shorter than by itself; of no meaning beside `seconds`"""


@dataclass(frozen=True, slots=True, kw_only=True)
class NoBreath(Mark):
    """No breath here, whatever the planner thinks."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StateMark(Mark):
    """From here on the body is in a state (`parameters.states`)."""

    name: str
    """`neutral` ends all others"""
    intensity: float
    """0..1"""
    ramp: float
    """s until it is reached"""
    held: bool = False
    """stays where it would recover by itself (exertion)"""


@dataclass(frozen=True, slots=True, kw_only=True)
class ProsodyMark(Mark):
    """From here on, until the next one, the voice is to speak otherwise. Relative to what the parameters say."""

    rate: float = 1.0
    pitch: float = 1.0
    volume_db: float = 0.0
    emphasis: bool = False
    """whether the words count as accented"""


@dataclass(frozen=True, slots=True, kw_only=True)
class VoiceMark(Mark):
    """From here on another body speaks."""

    voice: str
    """name of a voice; empty: the one the text began with"""


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedMark(Mark):
    """A named place: becomes a `marker` event at the onset of what follows."""

    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class BreathingMark(Mark):
    """From here on, until the next one, breaths by themselves are louder, longer, more frequent than otherwise."""

    level_db: float = 0.0
    length: float = 1.0
    """of inspirations"""
    frequency: float = 1.0
    """of breaths: 2 halves the length of groups"""
    silent: bool = False
    """breaths by themselves are not heard"""


@dataclass(frozen=True, slots=True, kw_only=True)
class EmotionMark(Mark):
    """The face shows an emotion, most of all here (A11, A40): an emoticon, an emoji, `[emotion happy]`, or XML."""

    name: str
    """one of `score.acting.EMOTIONS`"""
    intensity: float = 1.0
    """0..1"""
