"""Phones as others write them: IPA, ARPAbet, X-SAMPA; and what they write for silence."""

from __future__ import annotations

import re
from collections.abc import Sequence

from scorebreath.equations.phones import letters_of, makings, sounds_of
from scorebreath.errors import InputError
from scorebreath.speech.recording.arpabet import IPA

SILENCES = frozenset(
    {"", "sil", "sp", "spn", "silence", "<eps>", "<sil>", "<p:>", "<p>", "#", "_", "-", "p:", "pau", "[noise]"}
)
"""What is written where nothing is said, in small letters."""
_STRESS = re.compile(r"[0-2]$")
_MARKS = "ˈˌ\"'%"


def silent(label: str) -> bool:
    """Whether a label stands for silence."""
    return label.strip().lower() in SILENCES


def as_ipa(labels: Sequence[str]) -> list[str]:
    """IPA of some phones, all written in the same alphabet: whichever knows most of them.

    >>> as_ipa(["HH", "AH0", "L", "OW1"]), as_ipa(["h", "@", "l", "@U"]), as_ipa(["h", "ə", "l", "oʊ"])
    (['h', 'ʌ', 'l', 'oʊ'], ['h', 'ə', 'l', 'əʊ'], ['h', 'ə', 'l', 'oʊ'])
    """
    readings = [[read(label) for label in labels] for read in (_arpabet, _ipa, _xsampa)]
    best = max(readings, key=lambda reading: sum(bool(ipa) for ipa in reading))
    return [ipa or "ə" for ipa in best]


def _arpabet(label: str) -> str:
    return IPA.get(_STRESS.sub("", label.strip()), "")


def _ipa(label: str) -> str:
    bare = label.strip().strip(_MARKS)
    letters = letters_of(bare)
    return bare if letters and all(letter in makings() for letter in letters) else ""


def _xsampa(label: str) -> str:
    try:
        return "".join(sound.ipa for sound in sounds_of(label.strip().strip(_MARKS)))
    except InputError:
        return ""
