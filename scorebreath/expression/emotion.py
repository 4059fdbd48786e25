"""Emotions: full where the text asks for them, and linear to the borders of the phrases around (A40-A44).

| where it stands | it rises from | full at | it falls to |
|---|---|---|---|
| between two words of a phrase (A41) | the phrase's beginning | the end of the word before | the phrase's end |
| between two phrases (A42), also across a breath | the first one's beginning | its end | the second one's end |
| before all that is said (Y5) | at most 0.5 s before the phrase | the phrase's beginning | its end |
| behind all that is said (Y5) | the phrase's beginning | its end | at most 0.5 s behind |

Where it stands is told by the words around it, whatever punctuation is there. Where more than `LONGEST_SILENCE` lies
between two phrases, each is for itself: the emotion is the first one's, as at the end of all. Times are those of phones
(A19). No ramp is shorter than `RAMP`: a border moves into the silence beside it, else the climax into its phrase; in a
phrase too short for both, the emotion does not become full. Equal emotions at one place are one; what overlaps is for
the curves (Y5).
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from scorebreath.score.events import Blink, Emotion, Phrase, Utterance, Word
from scorebreath.script.marks import LONG_PAUSE, EmotionMark
from scorebreath.units import snap

DECAY = 0.5
"""s that an emotion takes to come before the first phrase and to go behind the last (Y5)."""
RAMP = 0.15
"""s of a ramp, at least: what is faster is seen as a step (A54: 100-200 ms)."""
LONGEST_SILENCE = LONG_PAUSE
"""s between two phrases that one emotion may span: what is longer is a rest."""
WINKS = frozenset({"kidding"})
"""Emotions that wink."""
CLOSE, HOLD, OPEN = 0.12, 0.2, 0.18
"""s of the wink (physiology 7.7), which is on the right, as the head's roll is."""

_RULES = {
    "inside": "A41: full at {written}, within its phrase",
    "between": "A42: full at {written}, between two phrases",
    "before": "Y5: full at {written}, before the first phrase",
    "behind": "Y5: full at {written}, behind the last phrase",
    "alone": "Y5: full at {written}, without words",
}


def emotion_events(
    marks: Sequence[EmotionMark],
    phrases: Sequence[Phrase],
    utterances: Sequence[Utterance],
    *,
    body: str,
    start: float = 0.0,
    over: float | None = None,
) -> list[Emotion | Blink]:
    """What the face does for emotions that the text asks for.

    The ids of the events tell the group that follows their mark (behind the last one: that group) and number the
    marks there, so all marks between one group's end and the next one's are to be given at once, as `Placed.marks`
    has them.

    Args:
        marks: In the order of the text.
        phrases: Those of `utterances`, in order; a stretch of speech that is in none counts as one.
        utterances: One body's, in order: for each mark, the one that its words are in or that ends before it (unless
            nothing was said before), and the one behind it (unless nothing will be said).
        body: Whose they are.
        start: s; before this nothing may begin.
        over: s; when all is over; None: not known yet.

    Returns:
        For each mark an emotion, and a wink where it is one that winks; none for a mark of intensity 0. Emotions may
        overlap, and begin where their phrase does, however long ago that was.
    """
    words = _words(phrases, utterances)
    if not words:
        return []
    starts = [word.source for word in words]
    bounds = _Bounds(start, words[-1].phrase.end + DECAY if over is None else over)
    events: list[Emotion | Blink] = []
    numbers: Counter[str] = Counter()
    for place, mark in _strongest(marks, starts):
        span = _span(words, place, bounds)
        here = words[min(place, len(words) - 1)].group
        numbers[here] += 1
        events += _events(mark, span, bounds, body=body, group=here, number=numbers[here])
    return events


def wordless(marks: Sequence[EmotionMark], *, body: str, onset: float) -> list[Emotion | Blink]:
    """Emotions of a text without a word, one after the other: each comes and goes within `DECAY`.

    Args:
        marks: In the text's order.
        body: Whose face it is.
        onset: s; when the first one begins.
    """
    events: list[Emotion | Blink] = []
    for number, mark in enumerate(marks, 1):
        bounds = _Bounds(onset, onset + 2.0 * DECAY)
        span = _Span(
            onset=snap(onset), apex=snap(onset + DECAY), end=snap(bounds.most), strength=1.0, kind="alone", phrases=()
        )
        events += _events(mark, span, bounds, body=body, group=None, number=number)
        onset = bounds.most
    return events


class _Bounds(NamedTuple):
    """From when to when something may happen, s."""

    least: float
    most: float


class _Stretch(NamedTuple):
    """A phrase in time."""

    id: str
    """empty where it is no `Phrase`"""
    onset: float
    end: float


@dataclass(frozen=True, slots=True, kw_only=True)
class _Spoken:
    """A word in time."""

    source: int
    """code points of the text before it"""
    onset: float
    end: float
    """at a phone's boundary"""
    group: str
    phrase: _Stretch


@dataclass(frozen=True, slots=True, kw_only=True)
class _Span:
    """From where to where an emotion reaches."""

    onset: float
    apex: float
    end: float
    strength: float
    """of the climax: below 1 where there is no time for all of it"""
    kind: str
    """a rule's name"""
    phrases: tuple[str, ...]


def _words(phrases: Sequence[Phrase], utterances: Sequence[Utterance]) -> list[_Spoken]:
    """All words that stand in the text, in its order."""
    found: list[_Spoken] = []
    first = 0
    for utterance in utterances:
        while first < len(phrases) and phrases[first].end <= utterance.onset:
            first += 1
        until = bisect_left(phrases, utterance.end, first, key=lambda phrase: phrase.onset)
        said = [(phrase.source, _Stretch(phrase.id, phrase.onset, phrase.end)) for phrase in phrases[first:until]]
        whole = _Stretch("", utterance.onset, utterance.end)
        edges = [phone.onset for phone in utterance.phones]
        edges += [utterance.phones[-1].onset + utterance.phones[-1].duration] if utterance.phones else []
        for at, onset, end in (part for word in utterance.words for part in _parts(word)):
            found.append(
                _Spoken(
                    source=at,
                    onset=snap(utterance.onset + _nearest(edges, onset)),
                    end=snap(utterance.onset + _nearest(edges, end)),
                    group=utterance.group or utterance.body,
                    phrase=next((stretch for (low, high), stretch in said if low <= at < high), whole),
                )
            )
    return found


def _parts(word: Word) -> Iterator[tuple[int, float, float]]:
    """Place in the text, onset and end of a word; of several that a voice has merged, with a sign between, of each.

    How they share its time follows their letters.
    """
    if word.source is None:
        return
    low, high = word.source
    pieces = word.text.split()
    end = word.onset + word.duration
    if len(pieces) < 2 or high - low <= len(word.text):
        yield low, word.onset, end
        return
    # the sign is taken to stand before the last of them
    cut = word.onset + word.duration * (1.0 - len(pieces[-1]) / sum(map(len, pieces)))
    yield low, word.onset, cut
    yield high - len(pieces[-1]), cut, end


def _nearest(edges: Sequence[float], time: float) -> float:
    """The phone's boundary nearest to a time (A19)."""
    place = bisect_left(edges, time)
    near = edges[max(0, place - 1) : place + 1]
    return min(near, key=lambda edge: abs(edge - time)) if near else time


def _strongest(marks: Sequence[EmotionMark], starts: Sequence[int]) -> Iterator[tuple[int, EmotionMark]]:
    """The marks that count, and how many words stand before each: of equal ones at a place, the strongest."""
    best: dict[tuple[int, str], EmotionMark] = {}
    for mark in marks:
        key = bisect_left(starts, mark.at), mark.name
        if mark.intensity > 0.0 and (key not in best or mark.intensity > best[key].intensity):
            best[key] = mark
    for (place, _), mark in best.items():
        yield place, mark


def _span(words: Sequence[_Spoken], place: int, bounds: _Bounds) -> _Span:
    """How far an emotion reaches that stands behind `place` words."""
    before = words[place - 1] if place else None
    after = words[place] if place < len(words) else None
    if before and after and after.onset - before.end > LONGEST_SILENCE:
        after = None
    if before and after:
        first, last = before.phrase, after.phrase
        kind = "inside" if first == last else "between"
        times = first.onset, before.end, last.end
    elif before:
        first = last = before.phrase
        kind, times = "behind", (first.onset, before.end, before.end + DECAY)
    else:
        first = last = words[0].phrase
        kind, times = "before", (words[0].onset - DECAY, words[0].onset, last.end)
    ids = tuple(dict.fromkeys(stretch.id for stretch in (first, last) if stretch.id))
    return _eased(times, _silence(words, place, (first, last), bounds), kind, ids)


def _silence(words: Sequence[_Spoken], place: int, around: tuple[_Stretch, _Stretch], bounds: _Bounds) -> _Bounds:
    """From when to when nothing else is said, as far as is known, around the phrases behind and before a place."""
    back, on = place - 1, place
    while back >= 0 and words[back].phrase == around[0]:
        back -= 1
    while on < len(words) and words[on].phrase == around[1]:
        on += 1
    return _Bounds(
        max(bounds.least, words[back].end if back >= 0 else bounds.least),
        min(bounds.most, words[on].onset if on < len(words) else bounds.most),
    )


def _eased(times: tuple[float, float, float], silence: _Bounds, kind: str, phrases: tuple[str, ...]) -> _Span:
    """Onset, apex and end with time enough for both ramps."""
    onset, apex, end = times
    onset = max(silence.least, min(onset, apex - RAMP))
    end = min(max(end, apex + RAMP), max(silence.most, apex))
    ramp = min(RAMP, (end - onset) / 2.0)
    apex = min(max(apex, onset + ramp), end - ramp)
    return _Span(onset=snap(onset), apex=snap(apex), end=snap(end), strength=ramp / RAMP, kind=kind, phrases=phrases)


def _events(
    mark: EmotionMark, span: _Span, bounds: _Bounds, *, body: str, group: str | None, number: int
) -> Iterator[Emotion | Blink]:
    """The emotion itself, and its wink."""
    duration, apex = snap(span.end - span.onset), snap(span.apex - span.onset)
    if duration <= 0.0:
        return
    written, home = " ".join(mark.written.split()), group or body
    yield Emotion(
        id=f"{home}.emotion{number}", body=body, group=group, onset=span.onset, duration=duration, origin="markup",
        rule=_RULES[span.kind].format(written=written), name=mark.name, apex=min(duration, apex),
        intensity=snap(mark.intensity * span.strength), phrases=span.phrases,
    )  # fmt: skip
    length = snap(CLOSE + HOLD + OPEN)
    onset = max(bounds.least, min(span.apex - CLOSE, bounds.most - length))
    if mark.name in WINKS and onset + length <= bounds.most:
        yield Blink(
            id=f"{home}.wink{number}", body=body, group=group, onset=snap(onset), duration=length, origin="markup",
            rule=f"A40: winks at {written}", left=0.0, right=1.0, close=CLOSE, hold=HOLD, open=OPEN,
        )  # fmt: skip
