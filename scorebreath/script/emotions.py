"""What an emoticon, an emoji or a word of markup means: the rows of `emotions.toml`."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

from scorebreath.errors import did_you_mean
from scorebreath.score.acting import EMOTIONS


class Meaning(NamedTuple):
    """An emotion, and how much of it."""

    name: str
    """one of `score.acting.EMOTIONS`"""
    intensity: float
    """0..1"""


@dataclass(frozen=True, slots=True, kw_only=True)
class VoiceChange:
    """What an emotion does to a voice (A58)."""

    pitch: float = 0.0
    """st, its mean"""
    range: float = 1.0
    """x what its pitch does around the mean"""
    rate: float = 1.0
    """x"""
    effort: float = 0.0
    """dB"""

    def by(self, share: float) -> VoiceChange:
        """So much of it.

        >>> VoiceChange(pitch=2.0, range=1.4, effort=-4.0).by(0.5)
        VoiceChange(pitch=1.0, range=1.2, rate=1.0, effort=-2.0)
        """
        return VoiceChange(
            pitch=self.pitch * share, range=1.0 + (self.range - 1.0) * share, rate=1.0 + (self.rate - 1.0) * share,
            effort=self.effort * share,
        )  # fmt: skip

    def with_(self, other: VoiceChange) -> VoiceChange:
        """Both of them, added up."""
        return VoiceChange(
            pitch=self.pitch + other.pitch, range=self.range + other.range - 1.0, rate=self.rate + other.rate - 1.0,
            effort=self.effort + other.effort,
        )  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class EmotionRow:
    """One row of the table."""

    name: str
    """one of `score.acting.EMOTIONS`"""
    words: tuple[str, ...]
    """other words for it"""
    state: str
    """of breathing, that goes with it (B60)"""
    voice: VoiceChange
    """what a full one does to the voice"""
    signs: Mapping[str, float]
    """emoticons and emoji as `bare` leaves them, and how much of the emotion they show"""


_RUN = re.compile(r"([()D3_])\1+")
_TURNED = re.compile(r"([()])(-?)([:;])")
_BRACKETS = str.maketrans("()", ")(")
_PLAIN = re.compile("[\ufe0e\ufe0f\U0001f3fb-\U0001f3ff]|\u200d$")
"""Variation selectors, skin tones, and a joiner that joins nothing."""


@cache
def rows() -> Mapping[str, EmotionRow]:
    """Every emotion by its name."""
    told = tomllib.loads((files("scorebreath.script") / "emotions.toml").read_text("utf-8"))
    return {name: _row(name, told[name]) for name in EMOTIONS}


def _row(name: str, told: Mapping[str, Any]) -> EmotionRow:
    signs = {
        sign: float(group["intensity"])
        for group in told["signs"]
        for kind in ("emoticons", "emoji")
        for sign in group.get(kind, ())
    }
    voice = VoiceChange(**{key: float(value) for key, value in told["voice"].items()})
    return EmotionRow(name=name, words=tuple(told["words"]), state=told["state"], voice=voice, signs=signs)


@cache
def _signs() -> Mapping[str, Meaning]:
    return {sign: Meaning(name, share) for name, row in rows().items() for sign, share in row.signs.items()}


@cache
def _words() -> Mapping[str, str]:
    words = {word: name for name, row in rows().items() for word in row.words}
    return words | {name: name for name in rows()}


def bare(sign: str) -> str:
    """An emoticon or an emoji as the table has it.

    >>> bare(": - O"), bare("=))"), bare("(-:"), bare("xDD"), bare("O__o"), bare("</333")
    (':-o', ':)', ':-)', 'XD', 'o_o', '</3')
    """
    if not sign.isascii():
        return _PLAIN.sub("", sign)
    short = _RUN.sub(r"\1", sign.replace(" ", "").replace("=", ":")).replace("O", "o")
    if turned := _TURNED.fullmatch(short):
        return turned[3] + turned[2] + turned[1].translate(_BRACKETS)
    return short.replace("p", "P").replace("xD", "XD")


def meaning(sign: str) -> Meaning | None:
    """The emotion that an emoticon or an emoji shows, or None for one that is only kept from being spoken.

    >>> meaning("; - )"), meaning("😀️"), meaning(":-?")
    (Meaning(name='kidding', intensity=1.0), Meaning(name='happy', intensity=0.9), None)
    """
    return _signs().get(bare(sign))


def named(word: str) -> str | None:
    """The emotion that a word of markup names, or None.

    >>> named("Joy"), named("afraid"), named("hungry")
    ('happy', 'afraid', None)
    """
    return _words().get(word.lower())


def expected(word: str = "") -> str:
    """What an error says of a word that names none."""
    return f"one of {', '.join(rows())}{did_you_mean(word, _words(), 2) if word else ''}"
