"""Phones of a word as MaryXML has them: in syllables, by MARY's names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType

from scorebreath.equations.phones import is_nucleus, sampa_of
from scorebreath.score.events import Phone

NAMES: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {"en": {"ɹ": "r", "ɝ": "r=", "eɪ": "EI", "aɪ": "AI", "ɔɪ": "OI", "əʊ": "@U", "oʊ": "@U"}}
)
"""What MARY calls a phone in a language where that is not its X-SAMPA name; `equations.phones.MARY` reads it."""
STRESS = ("", "'", ",")
LIQUIDS = frozenset("lrɹʁʀɾɻjwʋ")
"""What may stand between another consonant and a vowel at a syllable's beginning."""
FIRM = frozenset("pbtdkɡfvθðszʃʒxçʔ")
"""What may stand before those."""
NEVER_FIRST = frozenset("ŋ")


@dataclass(frozen=True, slots=True, kw_only=True)
class Syllable:
    """Phones around one vowel."""

    phones: tuple[Phone, ...]
    stress: int
    """0 none, 1 primary, 2 secondary: the strongest of its phones"""


def name_of(ipa: str, language: str) -> str:
    """A phone's name; its IPA where SAMPA has none.

    >>> name_of("ʃ", "de"), name_of("ɹ", "en"), name_of("aɪ", "de"), name_of("ɪɹ", "en")
    ('S', 'r', 'aI', 'Ir')
    """
    names = NAMES.get(language, {})
    vowel = ipa.removesuffix("ɹ")
    if vowel and vowel != ipa and "ɹ" in names:  # eSpeak's vowels coloured by what follows
        return name_of(vowel, language) + names["ɹ"]
    return names.get(ipa) or sampa_of(ipa) or ipa


def written(syllables: Sequence[Syllable], language: str) -> str:
    """The sounds of a word in one line: phones apart, `-` between syllables, `'` and `,` for their stress."""
    return " - ".join(sounds(syllable, language) for syllable in syllables)


def sounds(syllable: Syllable, language: str) -> str:
    """The sounds of a syllable with its stress."""
    names = [name_of(phone.ipa, language) for phone in syllable.phones]
    return " ".join([STRESS[syllable.stress], *names] if syllable.stress else names)


def syllables_of(phones: Sequence[Phone]) -> tuple[Syllable, ...]:
    """A word's phones cut into syllables.

    Between two vowels the last consonant begins the new syllable, together with a firm one before a liquid; voices do
    not tell where syllables begin.
    """
    centres = [index for index, phone in enumerate(phones) if is_nucleus(phone.ipa)]
    starts = [0]
    for before, centre in pairwise(centres):
        start = centre
        if centre - before > 1 and phones[centre - 1].ipa not in NEVER_FIRST:
            start = centre - 1
            if centre - before > 2 and phones[start].ipa[:1] in LIQUIDS and phones[start - 1].ipa[:1] in FIRM:
                start -= 1
        starts.append(start)
    ends = [*starts[1:], len(phones)]
    cut = [tuple(phones[start:end]) for start, end in zip(starts, ends, strict=True)]
    return tuple(Syllable(phones=part, stress=_stress(part)) for part in cut if part)


def _stress(phones: Sequence[Phone]) -> int:
    found = [phone.stress for phone in phones if 0 < phone.stress < len(STRESS)]
    return min(found, default=0)
