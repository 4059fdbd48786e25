"""What of a long performance its present curves are made from: a Score that does not grow with the evening."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import replace

from scorebreath.score.cutting import end_of, endings, never
from scorebreath.score.document import Score
from scorebreath.score.events import Cut, Event, Expiration, Hold, Inspiration, Parameter

KEPT = 12.0
"""s; longer than any event reaches, and than a movement takes to settle behind a cut (`settling.MOVEMENTS`)"""


def recent(score: Score, since: float) -> Score:
    """The Score without events that are over and change nothing any more.

    Args:
        score: Any Score.
        since: s; from here on the curves are the same.

    Returns:
        Events in their order: what goes on or comes, of each body the last breath and the last move of a parameter
        that is heard, however long ago, and the cuts of all these.
    """
    limit = since - KEPT
    ends = endings(score.events)
    last: dict[tuple[str, bool], Event] = {}
    for event in score.events:
        if isinstance(event, Inspiration | Expiration | Hold) or (
            isinstance(event, Parameter) and event.heard is not None
        ):
            key = event.body, isinstance(event, Parameter)
            if event.onset <= limit and not never(event, ends) and (key not in last or event.onset >= last[key].onset):
                last[key] = event
    kept = {event.id for event in last.values()}
    kept |= {event.id for event in score.events if end_of(event, ends) >= limit}
    left = (
        _cut(event, kept) if isinstance(event, Cut) else event if event.id in kept else None for event in score.events
    )
    return replace(score, events=tuple(event for event in left if event is not None))


def _cut(cut: Cut, kept: Set[str]) -> Cut | None:
    """A cut of what is kept; None where nothing of it is."""
    targets = tuple(target for target in cut.targets if target in kept)
    return replace(cut, targets=targets) if targets else None
