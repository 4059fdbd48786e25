"""Rows about where breaths are taken (physiology 1.2)."""

from __future__ import annotations

from typing import get_args

import numpy as np

from scorebreath.report.norms.figures import Array, Figure, When
from scorebreath.report.norms.material import Boundary, Material
from scorebreath.report.norms.row import PAIRS, Row
from scorebreath.score.document import Site

PLACES = "Where breaths are taken"
SITES: tuple[Site, ...] = tuple(site for site in get_args(Site) if site != "text end")
PUNCTUATED: frozenset[Site] = frozenset({"paragraph", "sentence", "semicolon", "comma", "line"})
"""Kinds of boundary that the text shows by a mark or a new line."""
ASKED: frozenset[Site] = frozenset({"tag", "marker"})
"""Kinds that the markup asks for; they count as punctuated where a mark stands there as well, else not at all."""
CLAUSES: frozenset[Site] = frozenset({*PUNCTUATED, "clause"})
PHRASES: frozenset[Site] = frozenset({*CLAUSES, "phrase"})
MARKS = ".!?…,;:–—-)"
QUOTES = "\"'’”»«“‘)]}_*"
APOSTROPHES = "'’"
UNSPACED = (
    (0x0E00, 0x0FFF),
    (0x1000, 0x109F),
    (0x1780, 0x17FF),
    (0x2E80, 0xA4CF),
    (0xF900, 0xFAFF),
    (0x20000, 0x3FFFF),
)
"""Scripts that put no space between words: Thai, Lao, Tibetan, Burmese, Khmer, Chinese and Japanese."""


def sites(m: Material) -> Array:
    """Place of each boundary's kind in SITES."""
    return np.array([SITES.index(each.site) for each in m.boundaries if each], dtype=np.float64)


def share_at(m: Material, kinds: frozenset[Site]) -> Array:
    """1 for each breath taken at one of these kinds, 0 for the others."""
    found = []
    for each in filter(None, m.boundaries):
        if each.site not in ASKED:
            found.append(each.site in kinds)
        elif _marked(m.score.text, each):
            found.append(True)
    return np.array(found, dtype=np.float64)


def inside_word(m: Material) -> Array:
    """1 for each breath taken between two letters of one word, 0 for the others."""
    return np.array([splits(m.score.text, each.place) for each in m.boundaries if each], dtype=np.float64)


def splits(text: str, place: tuple[int, int]) -> bool:
    """Whether a word goes on from one side of a place to the other.

    >>> splits("is not", (2, 3)), splits("isnot", (2, 2)), splits("don't", (3, 3)), splits("well-known", (5, 5))
    (False, True, True, False)
    """
    end, start = place
    if end < start or not 0 < end < len(text):
        return False
    before = text[end - 2 : end - 1] if text[end - 1] in APOSTROPHES else text[end - 1]
    after = text[end + 1 : end + 2] if text[end] in APOSTROPHES else text[end]
    return all(letter.isalnum() and not _unspaced(letter) for letter in (before, after))


def _unspaced(letter: str) -> bool:
    return any(low <= ord(letter) <= high for low, high in UNSPACED)


def _marked(text: str, boundary: Boundary) -> bool:
    """Whether punctuation, or a new line, stands at a boundary."""
    end, start = boundary.place
    written = text[max(0, end - 20) : end].rstrip().rstrip(QUOTES)
    return written[-1:] in tuple(MARKS) or "\n" in text[end:start]


ROWS: tuple[Row, ...] = (
    Row(
        name="sites", title="Kinds of boundary", part=PLACES, unit="%", measure=sites, kind="sites", labels=SITES,
        digits=1,
        measured="of all breaths but the first: what stands where the group before ends, as the planner says; the end "
                 "of "
                 "the text does not count",
    ),
    Row(
        name="at_punctuation", title="At punctuation", part=PLACES, unit="%", kind="share", digits=1, fewest=PAIRS,
        measure=lambda m: share_at(m, PUNCTUATED),
        measured="breaths at the end of a paragraph, a sentence or a line, at a semicolon or a comma; places that the "
                 "markup asks for count where a mark stands there, else not at all; nor does the end of the text",
        figures=(
            Figure(of="value", source="scorebreath", mark="E", low=90.0, when=When(style="reading"),
                   note="acceptance window; Winkworth 1994: almost all breaths at boundaries"),
            Figure(of="value", source="scorebreath", mark="E", low=60.0, high=90.0, when=When(style="spontaneous"),
                   note="acceptance window"),
            Figure(of="value", source="pajupuu", mark="V", low=66.0, high=90.0, when=When(style="reading"),
                   judges=False,
                   note="Estonian; pauses: 66 % in fiction read by an actor, 90 % in news"),
        ),
    ),
    Row(
        name="at_clauses", title="At punctuation or clauses", part=PLACES, unit="%", kind="share", digits=1,
        measure=lambda m: share_at(m, CLAUSES), fewest=PAIRS,
        measured="as at punctuation, and before a word that opens a clause",
        figures=(
            Figure(of="value", source="winkworth95", mark="E", low=65.0, high=85.0, when=When(style="spontaneous"),
                   note="the paper says the majority; the range is ours"),
            Figure(of="value", source="henderson", mark="M", mean=69.0, when=When(style="spontaneous")),
            Figure(of="value", source="pajupuu", mark="V", low=68.0, when=When(style="reading"),
                   note="Estonian, before connectives too: 68 % in fiction, 96 % in news; open above, as Winkworth "
                        "1994 found almost all"),
        ),
    ),
    Row(
        name="at_boundaries", title="At punctuation, clauses, phrases", part=PLACES, unit="%", kind="share",
        measure=lambda m: share_at(m, PHRASES), fewest=PAIRS, digits=1,
        measured="as at punctuation, and before a word that opens a clause or a phrase",
        figures=(
            Figure(of="value", source="winkworth94", mark="E", low=95.0, when=When(style="reading"),
                   note="the paper says almost exclusively; the number is ours"),
        ),
    ),
    Row(
        name="inside_words", title="Inside a word", part=PLACES, unit="%", kind="share", measure=inside_word, digits=1,
        measured="breaths with a letter of the same word on either side",
        figures=(Figure(of="value", source="wang", mark="V2", low=0.0, high=0.0, note="never"),),
    ),
)  # fmt: skip
"""Rows about places."""
