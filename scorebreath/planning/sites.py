"""Where a breath may fall, and how readily: boundaries by their punctuation, or by the function word that follows."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cache
from importlib.resources import files
from math import log
from types import MappingProxyType
from typing import Literal, NamedTuple

from scorebreath.planning.assemble import SITES
from scorebreath.planning.units import Unit, dividing, forbids
from scorebreath.score.document import Site
from scorebreath.script.marks import Act
from scorebreath.script.model import Edge, ScriptWord

Style = Literal["reading", "spontaneous"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Habits:
    """How a way of speaking places its breaths."""

    readiness: Mapping[Site, float]
    """how probable a breath is at each kind of boundary once some of the budget is used"""
    sentence_pull: float
    """what a breath costs less at the end of a sentence, however little has been said: there one rests for the sense"""
    comma_clause: float
    """the same at a comma before a word that opens a clause"""
    clinging: float
    """the same after a function word, which belongs to what follows: "the | house"; and inside a pair of compounds that
    share a half: "pre- | and post-war", "Planung und | -bau" """
    variation: float
    """scale of the draws that make boundaries easier or harder, in the units of the costs"""
    unevenness: float
    """sigma of the lognormal draws of the preferred length from group to group"""
    length: float
    """x preferred length of a group"""
    spread: float
    """sigma of the lognormal cost of a group's length"""
    budget: float
    """share of the preferred length from which on a boundary is passed at a cost"""


# What was measured with espeak on three texts of 2,000 to 2,650 words (a chapter of Alice in Wonderland, the
# introduction to the proceedings of a conference, an act of As You Like It), seeds 0 to 6, seconds from the inspiration
# to the last phone, and of the speech alone; lowest and highest of all:
#
#     reading       mean 4.0-4.9, alone 3.4-4.2, SD 1.3-1.75, longest 9.0; at punctuation 90.7-100 %, the rest before
#                   clauses and at line ends; physiology 10 asks for 3.3-4.8 (speech alone), 1.0-2.2, 12.6; 90 %
#     spontaneous   mean 4.4-4.8; at punctuation 65-91 %; people: 4.4-4.9; 60-90 %; 69 % there or before a clause (Wang
#                   et al. 2010; Henderson et al. 1965: physiology 1.1, 1.2)
#
# From paragraph to comma the weights of reading are those of physiology 1.2. Clause, phrase and word are lower than
# there (0.35, 0.12, 0.03): those are chances at one place, and a plan passes many such places between two commas. With
# them 79 % of the breaths in the proceedings, which have few commas, fell at punctuation. In spontaneous speech all
# are lower, for groups are longer, and draws of the scale of the costs do the rest.

HABITS: Mapping[Style, Habits] = MappingProxyType(
    {
        "reading": Habits(
            readiness={
                "paragraph": 1.0,
                "sentence": 0.95,
                "semicolon": 0.75,
                "comma": 0.50,
                "line": 0.30,
                "marker": 0.90,
                "clause": 0.04,
                "phrase": 0.008,
                "word": 0.0015,
            },
            sentence_pull=1.0,
            comma_clause=0.60,
            clinging=0.0002,
            variation=0.2,
            unevenness=0.35,
            length=1.0,
            spread=0.6,
            budget=0.7,
        ),
        "spontaneous": Habits(
            readiness={
                "paragraph": 1.0,
                "sentence": 0.75,
                "semicolon": 0.45,
                "comma": 0.20,
                "line": 0.05,
                "marker": 0.90,
                "clause": 0.10,
                "phrase": 0.04,
                "word": 0.015,
            },
            sentence_pull=0.2,
            comma_clause=0.25,
            clinging=0.001,
            variation=1.4,
            unevenness=0.55,
            length=1.16,
            spread=0.5,
            budget=0.35,
        ),
    }
)
"""By style; see above for what comes of them."""
INSIDE: frozenset[Edge] = frozenset({"word", "joint", "line"})
"""Edges without punctuation."""
NEAR = (0.1, 0.35)
"""x readiness inside a sentence, one and two words from punctuation: nobody breathes before the last word of all."""
PAUSE = (0.3, 0.90)
"""A pause from so many seconds on that the markup asks for is a place to breathe, as readily as at a marker."""
JOINED = 1e-9
"""How probable a breath is inside a chain of joined words that is longer than a breath."""
EASING: Mapping[Site, tuple[float, float]] = MappingProxyType(
    {
        "semicolon": (2.0, -1.5),
        "comma": (2.5, -1.5),
        "line": (2.5, -1.0),
        "clause": (3.5, 0.0),
        "phrase": (3.5, 0.3),
        "word": (3.5, 0.7),
    }
)
"""Power of a group's relative length with which readiness goes, and the least cost it comes to (ours)."""
UNTOUCHED = 15.0
"""What costs more is all but impossible, and stays so."""
FORBIDDEN = 1e4
"""What a breath costs where the markup forbids it: more than any other place. Only a stretch without any other place,
longer than a breath, is cut there all the same."""


HYPHENS = ("-", "\N{HYPHEN}", "\N{NON-BREAKING HYPHEN}", "\N{EN DASH}")


class Boundary(NamedTuple):
    """What follows a unit."""

    site: Site
    breathing: float
    """cost of a breath there: -ln P"""
    passing: float
    """cost of going on: -ln (1 - P)"""


@dataclass(frozen=True, slots=True, kw_only=True)
class FunctionWords:
    """A language's small words, lower case, as far as an apostrophe. Without any, only punctuation counts."""

    clause: frozenset[str] = frozenset()
    """open a clause"""
    coordinators: frozenset[str] = frozenset()
    """open one unless they join a single word: "bread and butter," """
    before_subject: frozenset[str] = frozenset()
    """open one before a subject ("after he left"), a phrase otherwise ("after lunch")"""
    subjects: frozenset[str] = frozenset()
    """pronouns that show a clause"""
    phrase: frozenset[str] = frozenset()
    """open a phrase: prepositions, articles, possessives"""
    pairing: frozenset[str] = frozenset()
    """stand between two compounds that share a half, with the coordinators"""
    clinging: frozenset[str] = frozenset()
    """others that are not parted from what follows: auxiliaries, negations"""

    def cling(self, word: str, as_written: bool = True) -> bool:
        """Whether `word` belongs to what follows it; one that is not said as written only like "Dr." and "bzw."."""
        if not as_written:
            return word in self.clinging or word in self.pairing
        return any(word in getattr(self, field.name) for field in fields(self))


@cache
def function_words(language: str) -> FunctionWords:
    """The table of a language (`tables/<language>.toml`); an empty one if there is none.

    >>> "because" in function_words("en").clause, function_words("xx").clause
    (True, frozenset())
    """
    table = files("scorebreath.planning").joinpath("tables", f"{language.split('-', maxsplit=1)[0].lower()}.toml")
    if not table.is_file():
        return FunctionWords()
    rows = tomllib.loads(table.read_text(encoding="utf-8"))
    return FunctionWords(**{name: frozenset(" ".join(lines).split()) for name, lines in rows.items()})


LOOK_AHEAD = 2
"""Units after a boundary that can change what it is."""


def boundary(units: Sequence[Unit], index: int, small: FunctionWords, habits: Habits = HABITS["reading"]) -> Boundary:
    """What follows `units[index]`; units beyond the end of `units` are taken not to exist."""
    unit = units[index]
    if unit.after:
        if dividing(unit.after):
            return Boundary("paragraph" if unit.edge == "paragraph" else "tag", 0.0, 0.0)
        if forbids(unit):
            return Boundary(_written(units, index, small, habits).site, FORBIDDEN, 0.0)
        if habits.readiness["marker"] > habits.readiness[SITES[unit.edge]] and _pauses(unit):
            return _boundary("marker", PAUSE[1])
    return _written(units, index, small, habits)


def eased(place: Boundary, shortness: float) -> Boundary:
    """A boundary to somebody who says more or less on a breath than usual.

    Short of breath, people breathe more readily inside sentences, at punctuation and without: children, exertion, COPD
    and Parkinson's bring shorter groups and more breaths in odd places (physiology 1.2, 1.5). Readiness there goes with
    a power of the groups' length, the higher the less stands there (`EASING`); sentences and paragraphs end as they do.

    Args:
        place: As it is to somebody with groups of usual length.
        shortness: How long groups are, relative to that.

    >>> word = Boundary("word", 6.2, 0.0)
    >>> [round(eased(word, shortness).breathing, 1) for shortness in (1.1, 1.0, 0.5, 0.3)]
    [6.5, 6.2, 3.8, 2.0]
    """
    if place.site not in EASING or place.breathing > UNTOUCHED:
        return place
    power, least = EASING[place.site]
    eased_ = place.breathing + power * log(shortness)
    return place._replace(breathing=eased_ if shortness > 1.0 else min(place.breathing, max(least, eased_)))


def _pauses(unit: Unit) -> bool:
    return any(isinstance(one, Act) and one.name == "pause" and (one.seconds or 0.0) >= PAUSE[0] for one in unit.after)


def _written(units: Sequence[Unit], index: int, small: FunctionWords, habits: Habits) -> Boundary:
    """What stands there, without markup."""
    unit, readiness = units[index], habits.readiness
    if unit.edge == "joint":
        return _boundary("word", JOINED)
    site = SITES[unit.edge]
    if "_" in unit.shown[unit.letters.end - unit.start :] and readiness[site] < readiness["marker"]:
        site = "marker"
    if site == "line" and small.cling(_last(unit), _as_written(unit.words[-1])):
        return _boundary(site, readiness["clause"])
    if site == "sentence":
        end = _boundary(site, readiness[site])
        return end._replace(breathing=end.breathing - habits.sentence_pull)
    if site not in ("comma", "word") or index + 1 >= len(units):
        return _boundary(site, readiness[site])
    if site == "comma":
        ready = habits.comma_clause if _opens(units, index + 1, small) == "clause" else readiness[site]
        either = 1.0 - (1.0 - ready) * (1.0 - readiness["line"])
        return _boundary(site, either if unit.ends_line else ready)
    if _suspended(units, index, small):
        return _boundary(site, habits.clinging)
    if small.cling(_last(unit), _as_written(unit.words[-1])):
        return _boundary(site, habits.clinging)
    site = _opens(units, index + 1, small)
    return _boundary(site, readiness[site] * _near(units, index))


def _near(units: Sequence[Unit], index: int) -> float:
    """How much less ready a place is that lies shortly before or behind punctuation, or the beginning of `units`."""
    for distance, factor in enumerate(NEAR, 1):
        ahead = units[index + distance].edge not in INSIDE if index + distance < len(units) else False
        if ahead or index - distance < 0 or units[index - distance].edge not in INSIDE:
            return factor
    return 1.0


def _opens(units: Sequence[Unit], index: int, small: FunctionWords) -> Site:
    """What the unit at `index` opens, after a word that is no function word."""
    word = _first(units[index])
    if not _as_written(units[index].words[0]):
        return "word"
    if word in small.clause:
        return "clause"
    following = units[index + 1] if units[index].edge == "word" and index + 1 < len(units) else None
    if word in small.coordinators:
        return "clause" if following and following.edge == "word" else "phrase"
    if word in small.before_subject:
        return "clause" if following and _first(following) in small.subjects else "phrase"
    return "phrase" if word in small.phrase else "word"


def _suspended(units: Sequence[Unit], index: int, small: FunctionWords) -> bool:
    """Whether a pair such as "pre- and post-war" or "Planung und -bau" goes on behind the unit at `index`."""
    unit, joint = units[index], units[index + 1]
    word = _first(joint)
    if word not in small.coordinators and word not in small.pairing:
        return False
    if unit.written[unit.letters.end - unit.start :].startswith(HYPHENS):
        return True
    after = units[index + 2] if joint.edge == "word" and index + 2 < len(units) else None
    return after is not None and after.written.startswith(HYPHENS) and after.letters.start == after.start + 1


@cache
def _boundary(site: Site, probability: float) -> Boundary:
    return Boundary(site, -log(probability), -log(1.0 - probability) if probability < 1.0 else 0.0)


def _first(unit: Unit) -> str:
    return _stem(unit.words[0].text)


def _last(unit: Unit) -> str:
    return _stem(unit.words[-1].text)


def _as_written(word: ScriptWord) -> bool:
    """Whether a word is said as it is written: the "in." of 2 in. and the IT of an office are no function words."""
    return _stem(word.words[0]) == _stem(word.text)


def _stem(word: str) -> str:
    """Lower case, as far as an apostrophe: "He's" is "he"."""
    return word.lower().replace("\N{RIGHT SINGLE QUOTATION MARK}", "'").split("'")[0]
