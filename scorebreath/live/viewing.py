"""What can be seen of a performance at one moment, from any thread: for screens. It reads, and changes nothing."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from scorebreath.score.cutting import end_of, endings
from scorebreath.score.document import Group, Score
from scorebreath.score.events import Event, Expiration, Hold, Inspiration, Utterance

if TYPE_CHECKING:
    from scorebreath.curves.curve_set import CurveSet
    from scorebreath.live.show import Show

Doing = Literal["speaks", "breathes in", "breathes out", "holds", "rests"]
DOING: tuple[tuple[type[Event], Doing], ...] = (
    (Utterance, "speaks"),
    (Inspiration, "breathes in"),
    (Expiration, "breathes out"),
    (Hold, "holds"),
)
"""What a body does while an event lasts; speech comes first, as air goes out with it."""
BEHIND = 3.9
"""s of the lungs that a picture goes back."""
ATTEMPTS = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class Said:
    """A breath group while it is said."""

    id: str
    text: str
    onset: float
    """s; of the utterance that sounds"""
    word: tuple[int, int] | None = None
    """half-open range of the text's code points that sound now; None: between words"""


@dataclass(frozen=True, slots=True, kw_only=True)
class BodyView:
    """A body at one moment."""

    body: str
    doing: Doing
    said: Said | None
    lungs: tuple[float, ...]
    """fraction of vital capacity above residual volume, over the last `BEHIND` seconds, the present last"""


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """A performance at one moment."""

    time: float
    """s"""
    bodies: tuple[BodyView, ...]
    coming: tuple[str, ...]
    """texts of breath groups that are ready, in order"""
    paused: bool
    ending: bool
    over: float | None
    """s when all is over, once that is known"""


def view(show: Show, *, samples: int = 40) -> View:
    """A performance as it is now.

    Args:
        show: Which.
        samples: Of each body's lungs; 0: lungs are not looked at.
    """
    performance, ledger, now = show.performance, show.ledger, show.now
    bodies = []
    for body in ledger.bodies:
        near = ledger.near(body)
        lasting = _lasting(near, now)
        said = _said(ledger.part(body, (event for event in lasting if isinstance(event, Utterance))), now)
        lungs = lungs_until(ledger.curves(body), now, samples) if samples else ()
        bodies.append(BodyView(body=body, doing=doing(lasting), said=said, lungs=lungs))
    return View(
        time=now, bodies=tuple(bodies), coming=_coming(show), paused=performance.paused, ending=performance.ending,
        over=performance.over,
    )  # fmt: skip


def doing(lasting: Iterable[Event]) -> Doing:
    """What a body does, of the events that last."""
    kinds = {type(event) for event in lasting}
    return next((name for kind, name in DOING if kind in kinds), "rests")


def said_at(utterance: Utterance, group: Group | None, now: float) -> Said:
    """What is heard of an utterance at a time, s."""
    words = [word for word in utterance.words if 0.0 <= now - utterance.onset - word.onset < word.duration]
    if group is None:
        return Said(
            id=utterance.id, text=" ".join(word.text for word in utterance.words), onset=utterance.onset
        )  # fmt: skip
    source = next((word.source for word in words if word.source is not None), None)
    start, length = group.source[0], len(group.text)
    place = None if source is None else (source[0] - start, source[1] - start)
    inside = place is not None and 0 <= place[0] < place[1] <= length
    return Said(id=group.id, text=group.text, onset=utterance.onset, word=place if inside else None)


def lungs_until(curves: CurveSet, now: float, samples: int) -> tuple[float, ...]:
    """Lung volumes over the last `BEHIND` seconds, the present last; (samples,)."""
    steps = max(1, samples - 1)
    times = [now - BEHIND * (steps - step) / steps for step in range(samples)]
    return tuple(float(value) for value in curves.sample(times, ["lung_volume"])[:, 0])


def _lasting(events: Sequence[Event], now: float) -> list[Event]:
    ends = endings(events)
    begun = (event for event in events if event.onset <= now)
    real = (event for event in begun if event.id not in ends or not ends[event.id].prevents(event))
    return [event for event in real if now < end_of(event, ends)]


def _said(part: Score, now: float) -> Said | None:
    utterance = next((event for event in part.events if isinstance(event, Utterance)), None)
    if utterance is None:
        return None
    group = next((group for group in part.groups if group.id == utterance.group), None)
    return said_at(utterance, group, now)


def _coming(show: Show) -> tuple[str, ...]:
    for _ in range(ATTEMPTS):
        try:
            return tuple(prepared.group.text for prepared in show.performance.coming)
        except RuntimeError:  # it changed just now
            continue
    return ()
