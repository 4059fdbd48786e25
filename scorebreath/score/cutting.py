"""What cuts do to events: which end early, which never happen, and what has been said until then.

A cut is an event of its own, and the events that it ends stay as they were written. Whoever turns events into sound,
motion or pictures asks here what became of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TypeVar

from scorebreath.errors import ScoreError, shortened
from scorebreath.score.event import Event
from scorebreath.score.performing import Cut
from scorebreath.score.speaking import Level, Phone, Pitch, Utterance, Word
from scorebreath.units import snap

E = TypeVar("E", bound=Event)


@dataclass(frozen=True, slots=True, kw_only=True, order=True)
class Ending:
    """When a cut ends an event, whatever that said."""

    time: float
    """s from the Score's start; an event that begins then or later never happens"""
    fade: float
    """s in which its sound fades out from there"""

    def prevents(self, event: Event) -> bool:
        """Whether the event never happens."""
        return event.onset >= self.time

    def shortens(self, event: Event) -> bool:
        """Whether the event begins, but does not come to its own end."""
        return event.onset < self.time < snap(event.end)


def endings(events: Iterable[Event]) -> Mapping[str, Ending]:
    """What cuts end, by the id of what they end; the earliest counts, of those at once the one that fades fastest.

    An event may be here that had ended by itself before.
    """
    found: dict[str, Ending] = {}
    for event in events:
        if isinstance(event, Cut):
            ending = Ending(time=event.onset, fade=event.fade)
            for target in event.targets:
                found[target] = min(found.get(target, ending), ending)
    return MappingProxyType(found)


def end_of(event: Event, ends: Mapping[str, Ending]) -> float:
    """When an event is over, s from the Score's start: at its own end or where it is cut, never before its onset."""
    ending = ends.get(event.id)
    return snap(event.end) if ending is None else max(event.onset, min(snap(event.end), ending.time))


def never(event: Event, ends: Mapping[str, Ending]) -> bool:
    """Whether a cut keeps an event from happening at all."""
    return event.id in ends and ends[event.id].prevents(event)


def cut_short(event: E, ends: Mapping[str, Ending]) -> E:
    """The event with its duration as far as it lasts, whatever else it says; itself where nothing cuts it short.

    Only for events whose other numbers need not fit into the duration, such as utterances.
    """
    if event.id not in ends or not ends[event.id].shortens(event):
        return event
    return replace(event, duration=snap(ends[event.id].time - event.onset))


def check_targets(events: Iterable[Event]) -> None:
    """Check that cuts end what there is.

    Raises:
        ScoreError: A target is no event, is another body's, or is itself a cut.
    """
    events = tuple(events)
    cuts = [event for event in events if isinstance(event, Cut)]
    known = {event.id: event for event in events} if cuts else {}
    for cut in cuts:
        for target in cut.targets:
            place = f"event {cut.id!r} cuts {shortened(target)!r}"
            if target not in known:
                raise ScoreError(f"{place}, which is no event of the score")
            if known[target].body != cut.body:
                raise ScoreError(f"{place}, an event of {known[target].body!r}; expected one of its own, {cut.body!r}")
            if isinstance(known[target], Cut):
                raise ScoreError(f"{place}, which is a cut, too; what is cut stays cut")


def beginning(said: Utterance, time: float) -> Utterance:
    """An utterance as far as it is said until a time: no word and no phone goes on behind it.

    Before that time its level and its pitch are what they were.

    Args:
        said: Begins before `time`.
        time: s from the Score's start.
    """
    length = snap(min(said.end, time) - said.onset)
    places = [place for place, word in enumerate(said.words) if word.onset < length]
    kept = {place: number for number, place in enumerate(places)}
    words = tuple(_word(said.words[place], length) for place in places)
    phones = tuple(_phone(phone, length, kept) for phone in said.phones if phone.onset < length)
    return replace(
        said,
        duration=length,
        words=words,
        phones=phones,
        level=Level(step=said.level.step, db=_steps(said.level.db, said.level.step, length)),
        pitch=Pitch(step=said.pitch.step, hertz=_steps(said.pitch.hertz, said.pitch.step, length)),
    )


def _word(word: Word, length: float) -> Word:
    return replace(word, duration=snap(min(word.duration, length - word.onset)))


def _phone(phone: Phone, length: float, kept: Mapping[int, int]) -> Phone:
    word = None if phone.word is None else kept.get(phone.word)
    return replace(phone, duration=snap(min(phone.duration, length - phone.onset)), word=word)


def _steps(values: tuple[float, ...], step: float, length: float) -> tuple[float, ...]:
    """One more than begins before the end: between two values the line goes from one to the other."""
    return values[: int(length / step) + 2]
