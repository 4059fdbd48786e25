"""What a face does, event by event, in words: when, how far, at which words, and by which rule."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from itertools import pairwise
from types import MappingProxyType
from typing import Any

from scorebreath.curves.performed import performed
from scorebreath.score.document import Score
from scorebreath.score.events import Blink, Brow, Emotion, Event, Gaze, Head, Utterance
from scorebreath.units import snap

WORDS_SHOWN = 6
"""Of more, the first and the last few."""
_COMMON = frozenset(field.name for field in fields(Event))


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceRow:
    """One event of a face."""

    time: float
    """s from the Score's start"""
    end: float
    """s"""
    body: str
    kind: str
    """`blink`, `brow`, `head`, `gaze` or `emotion`"""
    what: str
    """how far, in words"""
    amounts: Mapping[str, Any]
    """the event's own fields"""
    words: str
    """spoken meanwhile; empty in a pause"""
    rule: str
    """which rule made it, and why where it says more"""
    origin: str
    """who asked for it: `rule`, `markup`, `user` or `performer`"""
    id: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleRow:
    """How often a rule had its way."""

    kind: str
    rule: str
    count: int
    per_minute: float
    """of the Score's duration"""


def face_rows(score: Score, body: str | None = None) -> Iterator[FaceRow]:
    """The events of faces in order of time.

    Args:
        score: Any Score.
        body: Whose; None: everybody's.
    """
    score = performed(score)
    said = {each.id: _Said(score.of(Utterance, each.id)) for each in score.bodies}
    for event in sorted(_events(score, body), key=lambda event: (event.onset, event.type, event.id)):
        look = LOOKS[event.type]
        yield FaceRow(
            time=event.onset, end=snap(event.end), body=event.body, kind=event.type, what=look.what(event),
            amounts={f.name: getattr(event, f.name) for f in fields(event) if f.name not in _COMMON},
            words=said[event.body].between(event.onset, event.onset + look.seconds(event)) if event.body in said
            else "",
            rule=event.rule, origin=event.origin, id=event.id,
        )  # fmt: skip


def rule_rows(rows: Iterable[FaceRow], duration: float) -> tuple[RuleRow, ...]:
    """How often each rule had its way, the kinds in the order of `LOOKS`, the most frequent rule first.

    Args:
        rows: Of `face_rows`.
        duration: Of the Score, s.
    """
    counts: dict[tuple[str, str], int] = {}
    for row in rows:
        key = row.kind, rule_name(row.rule)
        counts[key] = counts.get(key, 0) + 1
    order = list(LOOKS)
    found = sorted(counts.items(), key=lambda item: (order.index(item[0][0]), -item[1], item[0][1]))
    return tuple(
        RuleRow(kind=kind, rule=rule, count=count, per_minute=round(60.0 * count / duration, 2) if duration else 0.0)
        for (kind, rule), count in found
    )


def rule_name(rule: str) -> str:
    """A rule without what it says about one event.

    >>> rule_name("brow_at_maximum: 4.2 st"), rule_name("")
    ('brow_at_maximum', '')
    """
    return rule.partition(":")[0].strip()


def blink_interval(rows: Iterable[FaceRow]) -> float | None:
    """Mean time from one blink to the next of the same body, s; None where there are not two."""
    onsets: dict[str, list[float]] = {}
    for row in rows:
        if row.kind == Blink.type:
            onsets.setdefault(row.body, []).append(row.time)
    steps = [after - before for times in onsets.values() for before, after in pairwise(times)]
    return sum(steps) / len(steps) if steps else None


def _events(score: Score, body: str | None) -> Iterator[Event]:
    return (event for event in score.events if event.type in LOOKS and (body is None or event.body == body))


class _Said:
    """One body's words by their times."""

    def __init__(self, utterances: Iterable[Utterance]) -> None:
        words = sorted(
            (one.onset + word.onset, one.onset + word.onset + word.duration, word.text)
            for one in utterances
            for word in one.words
        )
        self._onsets = [onset for onset, _, _ in words]
        self._ends = [end for _, end, _ in words]
        self._texts: Sequence[str] = [text for _, _, text in words]

    def between(self, start: float, end: float) -> str:
        """Words that sound in between."""
        first = bisect_right(self._ends, start)
        last = max(first, bisect_left(self._onsets, end))
        if last - first <= WORDS_SHOWN:
            return " ".join(self._texts[first:last])
        half = WORDS_SHOWN // 2
        return " ".join((*self._texts[first : first + half], "...", *self._texts[last - half : last]))


@dataclass(frozen=True, slots=True)
class Look:
    """How one kind of event is told."""

    what: Callable[[Any], str]
    seconds: Callable[[Any], float] = lambda event: float(event.duration)
    """of it, in which words count as spoken meanwhile"""


def _blink(event: Blink) -> str:
    which = "both lids" if event.left and event.right else "left lid" if event.left else "right lid"
    sides = event.left, event.right
    far = f"{max(sides):.2f}" if min(sides) in (0.0, max(sides)) else f"left {event.left:.2f}, right {event.right:.2f}"
    return f"{which} {far}, {1000 * event.duration:.0f} ms"


def _brow(event: Brow) -> str:
    parts = {"left": event.left, "right": event.right, "frown": event.frown}
    return ", ".join(f"{name} {amount:.2f}" for name, amount in parts.items() if amount) or "nothing"


def _head(event: Head) -> str:
    return _turned(event.pitch, event.yaw, event.roll) or "stays"


def _gaze(event: Gaze) -> str:
    turned = _turned(event.pitch, event.yaw)
    return f"to {event.target}, {turned}" if turned else f"to {event.target}"


def _emotion(event: Emotion) -> str:
    return f"{event.name} {event.intensity:.2f} at {event.onset + event.apex:.2f} s"


_WAYS = (("up", "down"), ("left", "right"), ("tilt right", "tilt left"))
"""Of pitch, yaw and roll, as the character sees it: positive, negative."""


def _turned(*degrees: float) -> str:
    said = (
        f"{ways[amount < 0]} {abs(amount):.1f}"
        for ways, amount in zip(_WAYS, degrees, strict=False)
        if round(amount, 1)
    )
    words = ", ".join(said)
    return f"{words} deg" if words else ""


LOOKS: Mapping[str, Look] = MappingProxyType(
    {
        Emotion.type: Look(_emotion),
        Blink.type: Look(_blink),
        Brow.type: Look(_brow),
        Head.type: Look(_head),
        Gaze.type: Look(_gaze, lambda event: max(float(event.move), 1e-6)),
    }
)
"""Every kind of event of a face."""
