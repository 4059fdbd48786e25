"""Listening to a recording: words by whoever can find them, their edges by level, silences and breaths between."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from scorebreath.errors import InputError, MissingExtraError, VoiceError
from scorebreath.script.language import primary
from scorebreath.speech.recording import given, sphinx, warping
from scorebreath.speech.recording.model import (
    Alignment,
    HeardBreath,
    HeardPhone,
    HeardWord,
    Mismatch,
    Progress,
    Take,
    Written,
)
from scorebreath.speech.recording.pauses import Levels, breath_in, parted, settled
from scorebreath.speech.recording.pronounce import Pronouncer

SILENCE = 0.1
"""s between two words from which on a breath is looked for"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Gap:
    """A silence before, between or behind the words."""

    start: float
    """s of the recording"""
    end: float
    """s"""
    before: int | None
    """place of the heard word that ends there; None: it is the beginning"""
    breath: HeardBreath | None
    """that is heard in it"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Listened:
    """All that is heard."""

    words: tuple[HeardWord, ...]
    """in order, each with phones"""
    gaps: tuple[Gap, ...]
    """from `SILENCE` on, and the beginning however short"""
    mismatches: tuple[Mismatch, ...]
    by: str
    """what found the words"""
    notes: tuple[str, ...]


def listen(
    take: Take,
    written: Sequence[Written],
    language: str,
    *,
    textgrid: Path | None = None,
    words: Path | None = None,
    on_progress: Progress | None = None,
) -> Listened:
    """Find a transcript in a recording.

    Args:
        take: The recording.
        written: Its transcript, at least one word.
        language: BCP 47.
        textgrid: A Praat TextGrid that says where words are.
        words: A JSON file that does.
        on_progress: Told the fraction that is done, 0..1.

    Raises:
        InputError: Recording, transcript and files do not belong together.
        VoiceError: eSpeak NG is not installed.
    """
    notes: list[str] = []
    with Pronouncer(language) as say:
        if textgrid or words:
            told = given.read_textgrid(textgrid, take) if textgrid else given.read_words(words or Path(), take)
            found = given.align(take, written, told, lambda word: spoken_of(word, language))
        else:
            found = _aligned(take, written, language, say, notes, on_progress=on_progress)
        if not found.words:
            raise InputError(f"{take.path}: no word of the transcript is heard in it")
        line = list(found.words)
        levels = Levels.of(take, line)
        if found.by == warping.NAME:  # that counts silences among the words
            line = parted(take, line, levels)
            levels = Levels.of(take, line)
        line = settled(take, line, levels, exact=textgrid is not None)
        line = filled(line, say)
    return Listened(
        words=tuple(line), gaps=tuple(_gaps(take, line, levels)), mismatches=found.mismatches, by=found.by,
        notes=tuple(notes),
    )  # fmt: skip


def _aligned(
    take: Take,
    written: Sequence[Written],
    language: str,
    say: Pronouncer,
    notes: list[str],
    *,
    on_progress: Progress | None,
) -> Alignment:
    """By PocketSphinx for English, where it is installed; else by warping."""
    if primary(language) != "en":
        return warping.align(take, written, say)
    try:
        return sphinx.align(take, written, say, on_progress)
    except MissingExtraError as error:
        notes.append(f"{error}: words are found less exactly, and not compared with the transcript")
        return warping.align(take, written, say)


def spoken_of(word: str, language: str) -> Sequence[str]:
    """The bare words that one is said as; itself where it has no digits."""
    if not any(character.isdigit() for character in word):
        return (word,)
    from scorebreath.script.reader import read

    try:
        script = read(word, language=language, markup="none")
    except InputError:
        return (word,)
    return [spoken for sentence in script.sentences for one in sentence.words for spoken in one.words] or (word,)


def filled(words: Sequence[HeardWord], say: Pronouncer) -> list[HeardWord]:
    """Words of which only the times are known get the phones that eSpeak NG says them with, stretched to fit."""
    bare = [word.text for word in words if not word.phones]
    try:
        told = dict(zip(bare, say.words(bare), strict=True))
    except VoiceError:
        told = {}
    out = []
    for word in words:
        if word.phones:
            out.append(word)
            continue
        phones: list[HeardPhone] = []
        at = word.start
        for sound in told.get(word.text, ()):
            end = min(word.end, at + sound.share * (word.end - word.start))
            phones.append(HeardPhone(ipa=sound.ipa, start=at, end=end, stress=sound.stress))
            at = end
        whole = HeardPhone(ipa="ə", start=word.start, end=word.end)
        phones = [*phones[:-1], replace(phones[-1], end=word.end)] if phones else [whole]
        out.append(replace(word, phones=tuple(phones)))
    return out


def _gaps(take: Take, words: Sequence[HeardWord], levels: Levels) -> list[Gap]:
    out = []
    for place in range(len(words) + 1):
        start = words[place - 1].end if place else 0.0
        end = words[place].start if place < len(words) else take.duration
        if end - start >= SILENCE or not place:
            out.append(
                Gap(
                    start=start,
                    end=end,
                    before=place - 1 if place else None,
                    breath=breath_in(take, start, end, levels),
                )
            )
    return out
