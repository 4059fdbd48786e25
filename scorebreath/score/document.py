"""The Score: one text, the bodies that speak it, and everything they do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal, TypeVar

from pydantic import ConfigDict

from scorebreath.errors import ScoreError, shortened
from scorebreath.score.cutting import check_targets
from scorebreath.score.events import Event, Extension, Part, Phrase, SentenceType, Utterance
from scorebreath.score.values import FORWARD, SHARE, Gridded, Limits, Number, Whole, limits
from scorebreath.units import snap

SCHEMA = "scorebreath.score/1"
E = TypeVar("E", bound=Event)
RATE = (1.0, 1e6)
"""Limits of a sample rate, Hz."""
Site = Literal[
    "text end", "paragraph", "tag", "sentence", "semicolon", "comma", "line", "marker", "clause", "phrase", "word"
]
"""Kinds of boundary, strongest first; `tag`: the markup asks for a breath there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class VoiceInfo(Part):
    """The voice a body speaks with."""

    limits: ClassVar[Limits] = limits(sample_rate=RATE)

    engine: str
    voice: str
    version: str
    licence: str
    sample_rate: Whole
    """Hz"""
    reference_db: Number
    """active RMS of the calibration sentence, dB re full scale"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Person(Part):
    """The body's lungs."""

    limits: ClassVar[Limits] = limits(vital_capacity=(0.1, 20.0), resting_volume=SHARE, vocal_tract=(5.0, 30.0))

    vital_capacity: Number
    """L"""
    resting_volume: Number
    """fraction of VC above residual volume at rest"""
    vocal_tract: Number | None = None
    """its length, cm: scales the sounds of breath; None: as the lungs suggest"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Body(Part):
    """Someone who breathes and speaks."""

    id: str
    voice: VoiceInfo
    person: Person
    parameters: Mapping[str, Any] = field(default_factory=dict)
    """what the user set: provenance, read by nothing"""
    x: Extension = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class MediaInfo(Part):
    """Where samples lie, relative to the Score's file."""

    limits: ClassVar[Limits] = limits(frames=(0, 2**48), sample_rate=RATE)

    path: str
    frames: Whole
    sample_rate: Whole
    """Hz"""
    kind: Literal["speech", "breath"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidate(Part):
    """A place where the group might have ended."""

    site: Site
    position: Whole
    """code points of the text: the group would end before it"""
    cost: Number
    """what the planner minimises: a distance in characters (the papers), a cost (`natural`)"""


@dataclass(frozen=True, slots=True, kw_only=True)
class CutReason(Part):
    """Where a group was cut, and why there."""

    site: Site
    rule: str
    candidates: tuple[Candidate, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Group(Part):
    """A breath group: what is said on one breath."""

    limits: ClassVar[Limits] = limits(syllables=(0, 2**31))

    id: str
    body: str
    source: tuple[Whole, Whole]
    """code points of the text"""
    text: str
    """as written"""
    syllables: Whole
    sentence_type: SentenceType
    cut: CutReason
    x: Extension = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Score(Gridded):
    """Text become timed events: everything anyone hears or sees comes from this.

    Raises:
        ScoreError: An id is used twice, or an event names a body, group or media that is not there, or cuts what it
            cannot cut.
    """

    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid")
    limits: ClassVar[Limits] = limits(duration=FORWARD)

    made_by: str
    seed: Whole
    language: str
    model: str
    text: str
    duration: Number
    """s"""
    bodies: tuple[Body, ...]
    media: Mapping[str, MediaInfo] = field(default_factory=dict)
    """by the SHA-256 of the float32 samples"""
    groups: tuple[Group, ...] = ()
    events: tuple[Event, ...] = ()
    x: Extension = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check that everything named exists."""
        super(Score, self).__post_init__()  # zero-argument super() breaks under dataclass slots
        _unique("body", [body.id for body in self.bodies])
        _unique("group", [group.id for group in self.groups])
        _unique("event", [event.id for event in self.events])
        for place, source in self._sources():
            if not 0 <= source[0] <= source[1] <= len(self.text):
                raise ScoreError(
                    f"{place}: source {list(source)} is no range of the text ({len(self.text)} code points)"
                )
        bodies = {body.id for body in self.bodies}
        groups = {group.id for group in self.groups}
        for event in self.events:
            if event.body not in bodies:
                raise ScoreError(f"event {event.id!r} names the body {event.body!r}, which the score does not have")
            if event.group is not None and event.group not in groups:
                raise ScoreError(f"event {event.id!r} names the group {event.group!r}, which the score does not have")
            if isinstance(event, Utterance) and event.media not in self.media:
                raise ScoreError(
                    f"event {event.id!r} names media {shortened(event.media)!r}, which the score does not list"
                )
        check_targets(self.events)

    def _sources(self) -> Iterator[tuple[str, tuple[int, int]]]:
        """Every range of the text that is named, and by whom."""
        for group in self.groups:
            yield f"group {group.id!r}", group.source
        for event in self.events:
            if isinstance(event, Phrase):
                yield f"event {event.id!r}", event.source
            elif isinstance(event, Utterance):
                for word in event.words:
                    if word.source:
                        yield f"word {word.text!r} of event {event.id!r}", word.source

    def of(self, kind: type[E], body: str | None = None) -> Iterator[E]:
        """Events of one type, of one body or of all, in the Score's order."""
        return (e for e in self.events if isinstance(e, kind) and (body is None or e.body == body))


def overrun(score: Score) -> float:
    """How long events go on after the Score's duration, s: that much is not rendered; 0.0 where all is."""
    return max(0.0, snap(max((event.end for event in score.events), default=0.0) - score.duration))


def _unique(what: str, names: list[str]) -> None:
    if len(set(names)) != len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise ScoreError(f"{what} id {twice!r} is used twice")
