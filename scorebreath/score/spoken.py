"""Which events make a breath group (B52): the breath taken for it, what is said on it, the air that this spends."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from scorebreath.score.document import Score
from scorebreath.score.events import Expiration, Inspiration, Utterance

FOR_SPEECH = ("speech", "gasp")
"""Kinds of inspiration that speech may follow on: a sigh, a sniff or a breath at rest is none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SpokenGroup:
    """The events of one group."""

    inspiration: Inspiration | None
    """the last one taken for what is said"""
    utterances: tuple[Utterance, ...]
    """in order of time: several where something is done between words"""
    spent: tuple[Expiration, ...]
    """the air of each, in order of time"""

    @property
    def onset(self) -> float | None:
        """Where the group begins: with its breath, or with its speech where it has none; None: it has no time."""
        if self.inspiration is not None:
            return self.inspiration.onset
        return self.utterances[0].onset if self.utterances else None

    @property
    def end(self) -> float | None:
        """The end of the last phone; None where nothing is said."""
        return self.utterances[-1].end if self.utterances else None


@dataclass(slots=True)
class _Found:
    inspirations: list[Inspiration] = field(default_factory=list)
    utterances: list[Utterance] = field(default_factory=list)
    spent: list[Expiration] = field(default_factory=list)


def spoken_groups(score: Score) -> Mapping[str, SpokenGroup]:
    """The events of every group of a Score by the group's id, in time linear in the events."""
    found = {(group.id, group.body): _Found() for group in score.groups}
    for event in score.events:
        if event.group is None or (own := found.get((event.group, event.body))) is None:
            continue
        if isinstance(event, Inspiration) and event.kind in FOR_SPEECH:
            own.inspirations.append(event)
        elif isinstance(event, Utterance):
            own.utterances.append(event)
        elif isinstance(event, Expiration) and event.kind == "speech":
            own.spent.append(event)
    return {name: _spoken(own) for (name, _), own in found.items()}


def _spoken(found: _Found) -> SpokenGroup:
    utterances = sorted(found.utterances, key=lambda event: event.onset)
    before = found.inspirations
    if utterances:
        before = [event for event in before if event.onset < utterances[0].onset]
    return SpokenGroup(
        inspiration=_last(before),
        utterances=tuple(utterances),
        spent=tuple(sorted(found.spent, key=lambda event: event.onset)),
    )


def _last(inspirations: Sequence[Inspiration]) -> Inspiration | None:
    return max(inspirations, key=lambda event: event.onset, default=None)
