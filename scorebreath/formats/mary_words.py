"""What a Score knows of its words, in the order in which they are said: sentences, phrases, words, what is between."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from scorebreath.score.document import Group, Score
from scorebreath.score.events import Emotion, Event, Marker, Phone, Phrase, Utterance, Word

SENTENCE_SITES = frozenset({"sentence", "paragraph", "text end"})
PARAGRAPH_SITES = frozenset({"paragraph", "text end"})
SENTENCE, PARAGRAPH, PHRASE = 5, 6, 4
"""Break indices of ends that no phrase tells of."""

_EMOTICON = re.compile(r"(?<!\w)(?:[:;=][-'^oO]?[()|/\\DPpoO*]|<3)(?!\w)")
_CLOSING = re.compile(r"[.,;:!?…)\]}\"'”’»«“]+")
_OPENING = re.compile(r"[(\[{\"'“„‚‘«»¿¡]+$")
_ALONE = re.compile(r"(?<=\s)[-–—]{1,3}(?=\s)|(?<=\s)(?:…|\.\.\.)(?=\s)")
_MARKS = re.compile(r"\.{2,}|[!?]+|.")


@dataclass(slots=True, kw_only=True)
class Said:
    """One word, and what is known of the place behind it."""

    word: Word
    utterance: Utterance
    group: Group | None
    phrase: Phrase | None
    phones: tuple[Phone, ...]
    before: list[Event] = field(default_factory=list)
    """emotions and markers that come before it"""
    behind: list[Event] = field(default_factory=list)
    """such that come behind it, if it is the last one"""
    opening: tuple[str, ...] = ()
    """marks of punctuation before it"""
    closing: tuple[str, ...] = ()
    """marks of punctuation behind it"""
    merged: bool = False
    """whether it comes of the same written text as the word before it"""
    break_index: int = 0
    """of the boundary behind it; 0: none"""
    silence: float = 0.0
    """s until the next word"""

    @property
    def onset(self) -> float:
        """Seconds from the Score's start."""
        return self.utterance.onset + self.word.onset

    @property
    def end(self) -> float:
        """Seconds from the Score's start."""
        return self.onset + self.word.duration


def said(score: Score) -> list[Said]:
    """All words of all bodies, in order of time, in time linear in the Score (but for sorting)."""
    groups = {group.id: group for group in score.groups}
    phrases = _phrases(score)
    words: list[Said] = []
    for utterance in sorted(score.of(Utterance), key=lambda event: event.onset):
        phones = _by_word(utterance)
        for index, word in enumerate(utterance.words):
            words.append(
                Said(
                    word=word,
                    utterance=utterance,
                    group=groups.get(utterance.group or ""),
                    phrase=_phrase(phrases.get(utterance.body, ((), ())), utterance.onset + word.onset),
                    phones=phones[index],
                )
            )
    words.sort(key=lambda one: one.onset)
    _punctuate(words, score.text)
    _bound(words)
    _place(words, [*score.of(Emotion), *score.of(Marker)])
    return words


def _phrases(score: Score) -> Mapping[str, tuple[Sequence[float], Sequence[Phrase]]]:
    """Phrases of each body, with their onsets, ascending."""
    found: dict[str, list[Phrase]] = {}
    for phrase in sorted(score.of(Phrase), key=lambda event: event.onset):
        found.setdefault(phrase.body, []).append(phrase)
    return {body: ([phrase.onset for phrase in own], own) for body, own in found.items()}


def _phrase(phrases: tuple[Sequence[float], Sequence[Phrase]], time: float) -> Phrase | None:
    onsets, own = phrases
    index = bisect_right(onsets, time + 1e-6) - 1
    return own[index] if index >= 0 and time < own[index].end else None


def _by_word(utterance: Utterance) -> list[tuple[Phone, ...]]:
    found: list[list[Phone]] = [[] for _ in utterance.words]
    for phone in utterance.phones:
        if phone.word is not None and phone.ipa:
            found[phone.word].append(phone)
    return [tuple(phones) for phones in found]


def _punctuate(words: Sequence[Said], text: str) -> None:
    """Give the words the punctuation between them."""
    place = 0
    last: Said | None = None
    for one in words:
        source = one.word.source
        if source is None:
            last = None
            continue
        if last is not None and source[0] < place:
            one.merged = True
        elif source[0] >= place:
            gap = _EMOTICON.sub(" ", text[place : source[0]])
            if last is not None:
                last.closing = tuple(_closing(gap))
                gap = gap[len("".join(last.closing)) :] if last.closing and last.closing[0] == gap[:1] else gap
            opening = _OPENING.search(gap)
            one.opening = tuple(_MARKS.findall(opening.group())) if opening else ()
        place = max(place, source[1])
        last = one
    if last is not None:
        last.closing = tuple(_closing(_EMOTICON.sub(" ", text[place:])))


def _closing(gap: str) -> Iterator[str]:
    """Marks that hang on the word before a gap, and those that stand by themselves."""
    hanging = _CLOSING.match(gap)
    if hanging:
        yield from _MARKS.findall(hanging.group())
    yield from _ALONE.findall(gap)


def _bound(words: Sequence[Said]) -> None:
    """Find where phrases, sentences and paragraphs end."""
    for one, following in pairwise(words):
        one.silence = max(0.0, following.onset - one.end)
        one.break_index = _break(one, following)
    if words:
        words[-1].break_index = _break(words[-1], None)


def _break(one: Said, following: Said | None) -> int:
    """Break index behind a word."""
    phrase, group = one.phrase, one.group
    ended = following is None or following.group is not group
    if phrase is not None:
        if following is not None and following.phrase is phrase and following.utterance.body == one.utterance.body:
            return 0
        at_end = following is None or phrase.position == "final"
        index = max(phrase.break_index, SENTENCE) if at_end else phrase.break_index or 1
        return PARAGRAPH if index == SENTENCE and ended and group and group.cut.site in PARAGRAPH_SITES else index
    if not ended:
        return 0
    if group is None or group.cut.site not in SENTENCE_SITES:
        return SENTENCE if following is None else PHRASE
    return PARAGRAPH if group.cut.site in PARAGRAPH_SITES else SENTENCE


def _place(words: Sequence[Said], events: Sequence[Event]) -> None:
    """Put emotions, at their climax, and markers between the words of their body."""
    own: dict[str, list[Said]] = {}
    for one in words:
        own.setdefault(one.utterance.body, []).append(one)
    middles = {body: [(one.onset + one.end) / 2.0 for one in said] for body, said in own.items()}
    for event in sorted(events, key=_time):
        if event.body not in own:
            continue
        index = bisect_right(middles[event.body], _time(event))
        if index < len(own[event.body]):
            own[event.body][index].before.append(event)
        else:
            own[event.body][-1].behind.append(event)


def _time(event: Event) -> float:
    return event.onset + event.apex if isinstance(event, Emotion) else event.onset
