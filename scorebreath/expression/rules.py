"""The table of rules: what a face does, on which channel, how often, and who says so.

Every event of the face names its rule and says what made it happen; `scorebreath explain --face` lists the rules, and
a rate of 0 switches a rule off.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

Moves = Literal["blink", "brow", "head", "gaze"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """One row."""

    name: str
    moves: tuple[Moves, ...]
    """types of events it makes"""
    rates: tuple[str, ...]
    """parameters that say how often, how far, how long"""
    source: str
    meaning: str


def _rows(*rows: tuple[str, str, str, str, str]) -> Mapping[str, Rule]:
    kinds: dict[str, Moves] = {"blink": "blink", "brow": "brow", "head": "head", "gaze": "gaze"}
    return MappingProxyType(
        {
            name: Rule(
                name=name,
                moves=tuple(kinds[each] for each in moves.split()),
                rates=tuple(rates.split()),
                source=source,
                meaning=meaning,
            )
            for name, moves, rates, source, meaning in rows
        }
    )


RULES: Mapping[str, Rule] = _rows(
    ("blink at pause", "blink", "blink_at_pause", "A20", "lids blink in a pause of 150 ms or more, or where it ends"),
    ("blink by itself", "blink", "blink_interval", "A21, Y3", "the eyes' own need; each blink restarts its clock"),
    ("double blink", "blink", "blink_double", "physiology 7.5", "some blinks come in twos"),
    ("look at the asked", "gaze", "", "A22", "eyes stay at the listener throughout a question"),
    (
        "question", "brow head", "question_brow question_raise", "A23, Y6",
        "brows and head are raised on a question's last word, and stay until speech goes on",
    ),
    (
        "head at maximum", "head", "head_at_maximum head_per_semitone head_highest roll_at_raise roll_angle",
        "A25-A27", "the head is raised at a pitch maximum, the higher the more, at rest at minima, often rolled",
    ),
    (
        "brow at maximum", "brow", "brow_at_maximum brow_interval brow_per_minute brow_height", "A28, A29",
        "brows are raised at a pitch maximum, the left one by its height",
    ),
    (
        "glance at accent", "gaze", "glance_at_accent", "A30, A31",
        "eyes are at the listener while an accented syllable is spoken; at the others they do not turn away",
    ),
    (
        "search", "gaze brow", "word_search", "A32, A33, Y2",
        "a word is searched for: down with a frown, or up with raised brows, a little to the own right",
    ),
    ("glance at pause", "gaze", "glance_at_pause", "A34", "eyes go to the listener where a phrase ends in a pause"),
    ("small shift", "gaze", "gaze_range", "A35", "eyes never stay quite still"),
    ("look at listener", "gaze", "look_at_listener", "physiology 7.5", "eyes stay at the listener"),
    (
        "look away", "gaze", "look_at_listener gaze_away", "physiology 7.5",
        "eyes leave the listener while the speaker thinks of what to say, from phrase beginnings on",
    ),
    (
        "listen", "gaze", "look_when_silent gaze_away", "physiology 7.5",
        "who does not speak looks at the other for most of the time",
    ),
)  # fmt: skip
"""By name."""


def because(name: str, why: str = "") -> str:
    """What an event says of its rule.

    Raises:
        KeyError: There is no such rule (a bug).

    >>> because("brow at maximum", "6.1 st on 'conference'")
    "brow at maximum (A28, A29): 6.1 st on 'conference'"
    """
    rule = RULES[name]
    return f"{name} ({rule.source})" + (f": {why}" if why else "")
