"""What a Score knows of its words, in the order in which they are said: sentences, phrases, words, what is between."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Literal

from scorebreath.score.document import Group, Score
from scorebreath.score.events import Emotion, Event, Marker, Pause, Phone, Phrase, Utterance, Word

SENTENCE_SITES = frozenset({"sentence", "paragraph", "text end"})
PARAGRAPH_SITES = frozenset({"paragraph", "text end"})
SENTENCE, PARAGRAPH, PHRASE = 5, 6, 4
"""Break indices of ends that no phrase tells of."""
NEAR = 0.02
"""s within which a pause begins where a word ends: voices leave samples of silence behind it."""

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
    ends: Literal["", "sentence", "paragraph"] = ""
    """what ends behind it, whatever its break index"""
    asked: float = 0.0
    """s of silence that somebody asked for behind it"""

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
    _pause(words, score.of(Pause))
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
            if last is not None and gap and not any(map(str.isspace, gap)) and last.phrase is one.phrase:
                one.merged = True  # the parts of an address, say, with what is not spoken between them
            elif last is not None:
                last.closing = tuple(_closing(gap))
                gap = gap[len("".join(last.closing)) :] if last.closing and last.closing[0] == gap[:1] else gap
            opening = None if one.merged else _OPENING.search(gap)
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
    for one, following in zip_longest(words, words[1:]):
        one.break_index, one.ends = _break(one, following)


def _break(one: Said, following: Said | None) -> tuple[int, Literal["", "sentence", "paragraph"]]:
    """Break index behind a word, as its phrase has it, and what ends there."""
    phrase, group = one.phrase, one.group
    left = following is None or following.group is not group
    site = group.cut.site if left and group is not None else "word"
    if phrase is None:
        if not left:
            return 0, ""
        if site not in SENTENCE_SITES and following is not None:
            return PHRASE, ""
        return (PARAGRAPH, "paragraph") if site in PARAGRAPH_SITES else (SENTENCE, "sentence")
    if following is not None and following.phrase is phrase and following.utterance.body == one.utterance.body:
        return 0, ""
    if following is not None and phrase.position != "final":
        return phrase.break_index or 1, ""
    paragraph = site in PARAGRAPH_SITES if left and group is not None else phrase.break_index == PARAGRAPH
    return phrase.break_index or SENTENCE, "paragraph" if paragraph else "sentence"


def _pause(words: Sequence[Said], pauses: Iterable[Pause]) -> None:
    """Give the words the silences that were asked for behind them: all others come by themselves when it is read."""
    own = _by_body(words)
    ends = {body: [one.end for one in said] for body, said in own.items()}
    for pause in pauses:
        index = bisect_right(ends.get(pause.body, ()), pause.onset + NEAR) - 1
        if pause.kind == "asked" and index >= 0:
            own[pause.body][index].asked += pause.duration


def _by_body(words: Sequence[Said]) -> dict[str, list[Said]]:
    own: dict[str, list[Said]] = {}
    for one in words:
        own.setdefault(one.utterance.body, []).append(one)
    return own


def _place(words: Sequence[Said], events: Sequence[Event]) -> None:
    """Put emotions, at their climax, and markers between the words of their body."""
    own = _by_body(words)
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
