"""Intonational phrases: what an utterance is divided into, and the silences in it (A8, A12).

A phrase ends at punctuation, at a line's end in verse, where the voice falls silent for 150 ms or more, where somebody
told so, and where an utterance ends that no other touches. How it ends follows from what stands there and from what
kind of sentence it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import takewhile
from typing import NamedTuple

from scorebreath.compose.placer import Placer
from scorebreath.compose.sentences import CLOSING, SentenceSaid, opening_left, quotation, sentences_of
from scorebreath.compose.wording import owners
from scorebreath.planning.model import Part
from scorebreath.score.event import PauseKind, SentenceType
from scorebreath.score.events import Pause, Phrase, Utterance
from scorebreath.script.model import Edge, ScriptWord
from scorebreath.units import snap

PAUSE = 0.15
"""s of silence that divide a phrase."""
ROUNDING = 0.001
"""s; eSpeak NG's pauses of 150 ms are some samples shorter."""
CONTINUING, LOW, HIGH = "h-l%", "l-l%", "h-h%"
"""ToBI: it goes on (S3, table 2); a statement ends; a question does."""


class Ending(NamedTuple):
    """How a phrase ends."""

    break_index: int
    tone: str
    rule: str
    silence: PauseKind = "phrase"
    """what a silence is that stands there"""


EDGES: dict[Edge, Ending] = {
    "paragraph": Ending(6, LOW, "paragraph", "paragraph"),
    "sentence": Ending(5, LOW, "sentence", "sentence"),
    "semicolon": Ending(4, CONTINUING, "punctuation"),
    "comma": Ending(4, CONTINUING, "comma"),
    "line": Ending(4, CONTINUING, "line of verse"),
}
"""Edges that end a phrase, strongest first; where a sentence ends, its tone stands in place of the row's.

S3 gives a line's end 4 and `h-l%`, with a comma and without; MARY has 5 and 6 for the ends of sentences and paragraphs.
What is in no row ends no phrase: at a word's end, a joint and the marker `_` nothing is heard unless the voice falls
silent.
"""
TOLD = Ending(4, CONTINUING, "told")
"""Where nothing is written, but somebody told of a boundary."""
SILENT = Ending(3, "h-", "silence of 150 ms")
"""Where nothing is written, but the voice falls silent: an intermediate phrase."""
CUT = Ending(4, CONTINUING, "end of the utterance")
"""Where nothing is written, but the utterance ends: the voice was asked to sound as if it went on."""
INNER: tuple[tuple[str, str], ...] = (("...", CONTINUING), ("?", HIGH), ("!", LOW), (".", LOW))
"""Tones of marks inside a sentence, behind what is quoted, say; first match wins."""


class _Spoken(NamedTuple):
    """A word as spoken, and what is known of it."""

    onset: float
    """s"""
    end: float
    own: range
    """which of the group's written words it is"""
    behind: int
    """the written word that is heard next: those between the two are silent"""
    part: Part
    silence: float
    """s, behind it; 0 where it is shorter than a pause"""
    over: bool
    """whether the voice stops behind it: what is said next, if anything, does not touch it"""


class _Phrase(NamedTuple):
    """A phrase on its way."""

    onset: float
    """s"""
    end: float
    words: Sequence[ScriptWord]
    ending: Ending
    final: bool
    sentence: SentenceSaid
    silence: float
    """s, behind it"""


def phrase(placer: Placer, said: Sequence[tuple[Utterance, Part]]) -> None:
    """Place the phrases of a breath group and the silences between them; moves no time.

    A phrase goes on from one utterance to the next where they touch: that the voice speaks otherwise, of what is
    emphasised say, divides nothing.

    Args:
        placer: Knows the language and how the sentence began; is told how the next one does.
        said: The group's utterances as placed, in order, each with the part that it says.
    """
    state, body, group = placer.state, placer.state.body, placer.group
    parts = [part for _, part in said]
    sentences = sentences_of(parts, state.opening)
    for number, one in enumerate(_divided(_spoken(said), parts, sentences, state.language), 1):
        name = f"{placer.id}.phrase{number}"
        onset, end = snap(one.onset), snap(one.end)
        verse = one.sentence.stanza is not None
        placer.events.append(
            Phrase(
                id=name, body=body, group=group, onset=onset, duration=snap(end - onset),
                rule=one.ending.rule, source=(one.words[0].source.start, one.words[-1].source.end),
                break_index=one.ending.break_index, tone=one.ending.tone,
                position="final" if one.final else "internal", sentence_type=one.sentence.type,
                line=one.words[0].line if verse else None, stanza=one.sentence.stanza,
            )
        )  # fmt: skip
        if one.silence:
            placer.events.append(
                Pause(
                    id=f"{name}.pause", body=body, group=group, onset=end, duration=snap(one.silence),
                    rule="silence in speech", kind=one.ending.silence,
                )
            )  # fmt: skip
    placer.state = replace(state, opening=opening_left(parts, sentences))


def _spoken(said: Sequence[tuple[Utterance, Part]]) -> list[_Spoken]:
    """The words of all utterances, in order; none of such as have no words."""
    out: list[_Spoken] = []
    first = 0
    for number, (speech, part) in enumerate(said):
        stop = first + len(part.words)
        own = owners(speech.words, part.words) if part.words else []
        silences = _silences(speech)
        following = said[number + 1] if number + 1 < len(said) else None
        touching = following is not None and _touching(speech, following[0]) and bool(following[1].words)
        for index, (word, here) in enumerate(zip(speech.words, own, strict=False)):
            last = index + 1 == len(own)
            silence = silences[index]
            if last and touching and following is not None:
                hushed = _hush(speech, -1) + _hush(following[0], 1)
                silence = hushed if hushed >= PAUSE - ROUNDING else 0.0
            out.append(
                _Spoken(
                    onset=speech.onset + word.onset,
                    end=speech.onset + word.onset + word.duration,
                    own=range(first + here.start, first + here.stop),
                    behind=stop if last else first + own[index + 1].start,
                    part=part,
                    silence=silence,
                    over=last and not touching,
                )
            )
        first = stop
    return out


def _touching(speech: Utterance, following: Utterance) -> bool:
    """Whether nothing lies between two utterances with words."""
    return bool(following.words) and following.onset - speech.end <= ROUNDING


def _hush(speech: Utterance, direction: int) -> float:
    """Seconds of silence at the beginning of an utterance (1), or at its end (-1)."""
    return sum(phone.duration for phone in takewhile(lambda phone: not phone.ipa, speech.phones[::direction]))


def _divided(
    spoken: Sequence[_Spoken], parts: Sequence[Part], sentences: Sequence[SentenceSaid], language: str
) -> Iterator[_Phrase]:
    """The phrases of a group, in order; none where it has no words."""
    words = [word for part in parts for word in part.words]
    first = 0
    for index, one in enumerate(spoken):
        last = one.own[-1]
        place = _strongest(words, last, one.behind)
        ending = _ending(place, heard=one.silence > 0, over=one.over)
        if ending is None:
            continue
        said = words[spoken[first].own.start : max(one.behind, one.own.stop)]
        final = one.part.ends_sentence if one.over else place is not None and place.edge in CLOSING
        sentence = sentences[last]
        quoted = not final and ending.tone == HIGH  # a question that ends, though the sentence around it goes on
        if quoted:
            sentence = quotation(said, sentence.stanza)
        elif not final and ending.tone == LOW and sentence.type == "question":  # "Never!" or "Yes.", quoted
            own: SentenceType = "exclamation" if place and place.spoken.text.endswith("!") else "statement"
            sentence = sentence._replace(type=own)
        if final or quoted:
            ending = ending._replace(tone=_tone(sentence, language))
        if place is not None and place.told is not None:
            told = place.told
            strength = None if told.joined else told.break_index
            ending = ending._replace(break_index=strength or ending.break_index, tone=told.tone or ending.tone)
        yield _Phrase(
            onset=spoken[first].onset,
            end=one.end,
            words=said,
            ending=ending,
            final=final,
            sentence=sentence,
            silence=one.silence,
        )
        first = index + 1


def _strongest(words: Sequence[ScriptWord], first: int, stop: int) -> ScriptWord | None:
    """The word with the strongest boundary behind it: of one as spoken and those behind it that nobody speaks.

    None where two spoken words are one written word.
    """
    strength = list(EDGES)
    return min(
        words[first:stop],
        key=lambda word: (
            strength.index(word.edge) if word.edge in EDGES else len(strength),
            word.told is None or not word.told.boundary,
        ),
        default=None,
    )


def _ending(word: ScriptWord | None, *, heard: bool, over: bool) -> Ending | None:
    """How a phrase ends behind a word, or None: it does not."""
    joined = word is not None and word.told is not None and word.told.joined and word.edge not in CLOSING
    if word is not None and word.edge in EDGES and not joined:
        ending = EDGES[word.edge]
        if word.edge == "semicolon":
            said = word.spoken.text
            ending = ending._replace(tone=next((tone for mark, tone in INNER if said.endswith(mark)), ending.tone))
        return ending
    if word is not None and word.told is not None and word.told.boundary:
        return TOLD
    if over:
        return CUT
    return SILENT if heard else None


def _tone(sentence: SentenceSaid, language: str) -> str:
    """Questions for yes or no rise; those for a word fall, as statements do."""
    return HIGH if sentence.rises(language) else LOW


def _silences(speech: Utterance) -> list[float]:
    """Seconds of silence behind each word, 0 where it is shorter than a pause or nothing follows."""
    out = [0.0] * len(speech.words)
    word, silence = None, 0.0
    for phone in speech.phones:
        if not phone.ipa:
            silence += phone.duration
            continue
        if word is not None and phone.word not in (None, word) and silence >= PAUSE - ROUNDING:
            out[word] = silence
        word, silence = (word if phone.word is None else phone.word), 0.0
    return out
