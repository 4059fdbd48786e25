"""How the tone voice reads: words to phones, letter by letter, by table."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from typing import Literal

Kind = Literal["vowel", "voiced", "noise", "stop", "pause"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Sound:
    """How a phone sounds."""

    ipa: str
    kind: Kind
    steps: int
    """5 ms each, at the voice's own rate"""
    colour: int = 0
    """vowels: the overtone that rings with the tone"""
    closure: int = 0
    """stops: steps of silence at the beginning"""


VOWELS = {
    "a": Sound(ipa="a", kind="vowel", steps=22, colour=7),
    "e": Sound(ipa="e", kind="vowel", steps=20, colour=5),
    "i": Sound(ipa="i", kind="vowel", steps=18, colour=3),
    "o": Sound(ipa="o", kind="vowel", steps=22, colour=4),
    "u": Sound(ipa="u", kind="vowel", steps=20, colour=2),
    "y": Sound(ipa="y", kind="vowel", steps=18, colour=6),
}
CONSONANTS = {
    "b": Sound(ipa="b", kind="stop", steps=12, closure=8),
    "c": Sound(ipa="k", kind="stop", steps=16, closure=10),
    "d": Sound(ipa="d", kind="stop", steps=12, closure=8),
    "f": Sound(ipa="f", kind="noise", steps=16),
    "g": Sound(ipa="ɡ", kind="stop", steps=12, closure=8),
    "h": Sound(ipa="h", kind="noise", steps=12),
    "j": Sound(ipa="j", kind="voiced", steps=12),
    "k": Sound(ipa="k", kind="stop", steps=16, closure=10),
    "l": Sound(ipa="l", kind="voiced", steps=14),
    "m": Sound(ipa="m", kind="voiced", steps=14),
    "n": Sound(ipa="n", kind="voiced", steps=14),
    "p": Sound(ipa="p", kind="stop", steps=16, closure=10),
    "q": Sound(ipa="k", kind="stop", steps=16, closure=10),
    "r": Sound(ipa="r", kind="voiced", steps=12),
    "s": Sound(ipa="s", kind="noise", steps=18),
    "t": Sound(ipa="t", kind="stop", steps=16, closure=10),
    "v": Sound(ipa="v", kind="voiced", steps=14),
    "w": Sound(ipa="w", kind="voiced", steps=14),
    "x": Sound(ipa="s", kind="noise", steps=18),
    "z": Sound(ipa="z", kind="voiced", steps=16),
}
DIGITS = "oaieuyoaie"
"""The vowel a digit is read with, after a t."""
COMMA = Sound(ipa="", kind="pause", steps=30)
STOP = Sound(ipa="", kind="pause", steps=60)
PAUSES = {**dict.fromkeys(",;:，、；：–—―", COMMA), **dict.fromkeys(".!?…。！？", STOP)}
"""Marks between words, and what they are worth; the longest counts."""
_TOKEN = re.compile(r"[^\s–—―…/]+")


@dataclass(frozen=True, slots=True, kw_only=True)
class Read:
    """A word and what it is read as."""

    start: int
    """place of its first letter or digit in the text"""
    end: int
    """place behind its last"""
    sounds: tuple[Sound, ...]
    """at least one; none a pause"""
    pause: Sound | None
    """before it"""


def read(text: str) -> tuple[Read, ...]:
    """Words of a text, those with a letter or digit in them."""
    words: list[Read] = []
    for match in _TOKEN.finditer(text):
        spoken = [place for place in range(*match.span()) if text[place].isalnum()]
        sounds = sounds_of(match.group())
        if not spoken or not sounds:
            continue
        start, end = spoken[0], spoken[-1] + 1
        between = text[words[-1].end : start] if words else ""
        marks = [PAUSES[mark] for mark in between if mark in PAUSES]
        pause = max(marks, key=lambda mark: mark.steps, default=None)
        words.append(Read(start=start, end=end, sounds=sounds, pause=pause))
    return tuple(words)


def sounds_of(word: str) -> tuple[Sound, ...]:
    """A vowel for each group of vowel letters, a consonant for each group of one consonant.

    Letters beyond a-z are read without their marks; those of other scripts as m or a, by their number.

    >>> "".join(sound.ipa for sound in sounds_of("Queenie"))
    'kuni'
    """
    out: list[Sound] = []
    grouped = ""
    for letter in _plain(word):
        group = "vowel" if letter in VOWELS else letter
        if group != grouped:
            out.append(VOWELS.get(letter) or CONSONANTS[letter])
        grouped = group
    return tuple(out)


def _plain(word: str) -> str:
    """Letters a to z only."""
    letters = []
    for character in unicodedata.normalize("NFKD", word.casefold()):
        if character in VOWELS or character in CONSONANTS:
            letters.append(character)
        elif character.isdecimal():
            letters.append("t" + DIGITS[unicodedata.decimal(character)])
        elif character.isalpha():
            letters.append("ma"[ord(character) % 2])
    return "".join(letters)
