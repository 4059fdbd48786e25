"""What is known of the words of an utterance: which words of the text they are, and which of them bear an accent."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import replace

from scorebreath.planning.model import Part
from scorebreath.score.events import Word
from scorebreath.script.accents import is_content
from scorebreath.script.model import ScriptWord
from scorebreath.script.told import Told
from scorebreath.speech.model import Speech

UNACCENTED = "none"
"""What MaryXML says of a word that bears no accent (A12)."""


def accented(speech: Speech, part: Part, language: str) -> tuple[Word, ...]:
    """The words of a speech with their accents (A7).

    A word bears one if it is a content word and the voice stresses it. The stress is asked for because voices, like
    speakers, leave some content words without: eSpeak NG one in twenty in English ("went", "got", "put"), one in a
    hundred in German ("jetzt", "kam"), and there its melody does not move. Where nothing in the speech is stressed, the
    voice does not say, and content words bear accents. What somebody told of a word stands in place of all this.

    Args:
        speech: As spoken.
        part: What was to be said.
        language: BCP 47.
    """
    stressed = {phone.word for phone in speech.phones if phone.stress == 1}
    out: list[Word] = []
    for number, (word, own) in enumerate(zip(speech.words, owners(speech.words, part.words), strict=True)):
        told = [one.told for one in part.words[own.start : own.stop] if one.told is not None]
        sounding = number in stressed or not stressed
        if told:
            out.append(_told(word, told, sounding, language))
        else:
            out.append(replace(word, accent=sounding and is_content(word.text, language)))
    return tuple(out)


def _told(word: Word, told: Sequence[Told], sounding: bool, language: str) -> Word:
    head = next((one for one in told if one.accent and one.accent != UNACCENTED), None)
    if head is not None:
        return replace(word, accent=True, tone=head.accent or "", pos=head.pos)
    free = any(not one.accent for one in told)
    pos = next((one.pos for one in told if one.pos), "")
    return replace(word, accent=free and sounding and is_content(word.text, language), pos=pos)


def owners(words: Sequence[Word], written: Sequence[ScriptWord]) -> list[range]:
    """Which words of the text each spoken word is.

    Args:
        words: As spoken, in their order; one may be several of the text ("was the"), and several one ("23").
        written: As read.

    Returns:
        A range of indices of `written` for each of `words`, none before the one of the word before; empty only where
        nothing is written.
    """
    starts = [word.source.start for word in written]
    out: list[range] = []
    first, last = 0, 0
    for word in words:
        if word.source is not None:
            start, end = word.source
            first = max(first, last if out else 0, bisect_right(starts, start) - 1)
            last = max(first, bisect_left(starts, end) - 1)
        else:
            first = last
        out.append(range(first, min(last + 1, len(written))))
    return out
