"""Emoticons (A11): found as written, compact `:-)` or with the inner spaces the paper prints `: - )`.

They are no punctuation: they end nothing and are not spoken. What they mean is read here and used elsewhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from scorebreath.spans import Span

EMOTIONS = {
    ":-)": "happy",
    ";-)": "kidding",
    ":-(": "sad",
    ">:-<": "angry",
    ":-o": "surprised",
    ":-|": "disgusted",
}
"""The first list of S3 section 4. The last glyph of its sixth is lost; `:-|` is what was read into it (A11)."""

_PATTERN = re.compile(
    r"""
    >?[:;]-[)(|<oO?/\\DPp]            (?![^\W_])  # :-)   >:-<   :-o
    | (?<!\S) >?\ ?[:;]\ ?-\ ?[)(|<oO] (?![^\W_])  # : - )   :- )   > : - <
    | (?<!\S) [:;=][)(|DPp]           (?![^\W_])  # :)   ;)   :D
    """,
    re.VERBOSE,
)


LONGEST = 8
"""Code points of the longest emoticon, with a margin."""


def spans(text: str, start: int = 0, end: int | None = None) -> Iterator[Span]:
    """Where emoticons stand in `text[start:end]`.

    >>> [span.cut("Hi :-) it's a Grab: : - ( . (a:)") for span in spans("Hi :-) it's a Grab: : - ( . (a:)")]
    [':-)', ': - (']
    """
    for match in _PATTERN.finditer(text, start, len(text) if end is None else end):
        yield Span(*match.span())


def emotion(emoticon: str) -> str | None:
    """The emotion an emoticon stands for, or None for one that is only kept from being spoken.

    >>> emotion(": - O"), emotion(":)"), emotion(":-D")
    ('surprised', 'happy', None)
    """
    bare = emoticon.replace(" ", "").replace("=", ":").replace("O", "o")
    return EMOTIONS.get(bare if "-" in bare else bare[:1] + "-" + bare[1:])
