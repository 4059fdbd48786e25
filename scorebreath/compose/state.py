"""What a body carries from group to group, and what one step is given."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from scorebreath.media.recordings import Recordings
from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, Part
from scorebreath.score.document import Person, Site
from scorebreath.script.marks import BreathingMark
from scorebreath.speech.model import Speech


@dataclass(frozen=True, slots=True, kw_only=True)
class BodyState:
    """All that is carried: where a body is in time, breath and mood."""

    body: str
    seed: int
    parameters: Parameters
    person: Person
    time: float
    """s; the next group begins here"""
    volume: float
    """fraction of VC above residual volume"""
    site: Site = "text end"
    """the boundary behind; `text end` before anything was said"""
    blend: Blend = field(default_factory=Blend)
    """the states it is in"""
    breathing: BreathingMark | None = None
    """how the markup wants its breaths"""
    recordings: Recordings | None = None
    """the user's own breaths"""
    sighed: float = 0.0
    """s; when it last sighed, or began"""
    language: str = ""
    """BCP 47, of what it says; empty: nobody knows"""
    opening: tuple[str, ...] = ()
    """the first words of the sentence it is in the midst of"""
    waits: int = 0
    """how often it has breathed at rest: a key of chance"""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SpokenPart:
    """A part of a group, spoken and measured."""

    part: Part
    speech: Speech
    media: str
    """SHA-256 of its samples"""
    gain_db: float = 0.0
    """louder than the voice by itself, for effort"""


@dataclass(frozen=True, slots=True, kw_only=True)
class KeptBreath:
    """A breath that is heard in a recording, and stays as it is."""

    onset: float
    """s of the Score"""
    duration: float
    """s"""
    media: str
    """SHA-256 of its samples, made ready as any recording of a breath"""
    level_db: float
    """at which it sounds as recorded, relative to the voice's reference"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Room:
    """The time that a recording leaves: its speech stays where it is, and the breath has to fit before it."""

    onset: float
    """s of the Score: the speech begins here"""
    silence: float | None
    """s between its end and the next group's speech; None: it is the last"""
    breath: KeptBreath | None = None
    """the breath before it that is kept"""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Spoken:
    """A breath group that has been spoken and measured."""

    group: BreathGroup
    id: str
    """of the group in the Score"""
    place: str
    """key of its chance: its words and which occurrence of them it is"""
    parts: tuple[SpokenPart, ...]
    """one for each of the group's"""
    room: Room | None = None
    """where it must stand in time; None: as soon as the body has breathed for it"""


class Places:
    """Keys that name a group by its place in the text rather than by its number.

    The key is the group's own words and which occurrence of them it is, so inserting a sentence elsewhere leaves it.
    """

    def __init__(self) -> None:
        """Nothing has been said."""
        self._said: Counter[str] = Counter()

    def key(self, text: str) -> str:
        """The key of the next group that says `text`.

        >>> places = Places()
        >>> places.key("again"), places.key("and"), places.key("again")
        ('again#0', 'and#0', 'again#1')
        """
        words = " ".join(text.split())
        self._said[words] += 1
        return f"{words}#{self._said[words] - 1}"

    def take_back(self, text: str) -> None:
        """The last group that said `text` was not said after all."""
        self._said[" ".join(text.split())] -= 1
