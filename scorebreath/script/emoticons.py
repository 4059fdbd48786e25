"""Emoticons (A11): found as written, compact `:-)` or with the inner spaces the paper prints `: - )`; the heart too.

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

_MEASURED = (
    r"(?:milli|cent|zent|kilo|deci)?(?:meter|metre)s?n?|(?:nano|micro|mikro|milli)?sec(?:ond)?s?|(?:Milli)?Sekunden?|"
    r"min(?:ute)?[sn]?|hours?|hrs?|Stunden?|days?|Tagen?|weeks?|Wochen?|months?|Monaten?|years?|yrs?|Jahren?|miles?|"
    r"inch(?:es)?|feet|foot|degrees?|Grad|per\s?cent|Prozent|points?|Punkten?|dollars?|euros?|times|Personen|"
    r"[munk]?m|[mk]?g|ms|[sh]|[kMG]?B|[kM]?Hz|°"
)
"""What is counted often enough to show that `<3` before it is "less than three"."""

_PATTERN = re.compile(
    rf"""
    >?[:;]-[)(|<oO?/\\DPp]            (?![^\W_])  # :-)   >:-<   :-o
    | (?<!\S) >?\ ?[:;]\ ?-\ ?[)(|<oO] (?![^\W_])  # : - )   :- )   > : - <
    | (?<!\S) [:;=][)(|DPp]           (?![^\W_])  # :)   ;)   :D
    | (?<!\S) \(-?[:;=]               (?![^\s.,!?])  # (:   (-:
    | (?<!\S) [xX]D{{1,4}}            (?![^\W_])  # XD
    | (?<!\S) (?: ([oOTuUxX^.;*-])_{{1,3}}(?i:\1) | >_{{1,3}}< ) (?![^\s.,!?])  # o_O   -_-
    | (?<!\S) (?: (?<!\d[ ]) | (?<=<3[ ]) | (?<=<33[ ]) )   # <3   </3   <3 <3, but 5 <3, x <3, in <3 days, <3 %
      (?<!\b[a-hj-tv-z][ ]) (?: (?<![\w,][ ]) | (?<=\b[Ii][ ]) | (?! <3[ ](?i:{_MEASURED})\b) )
      </?3{{1,4}} (?! \w | [.,:]\d | [-–]\d | [ ]?[%‰°€$£+*/=] )
    """,
    re.VERBOSE,
)


LONGEST = 8
"""Code points of the longest emoticon, with a margin."""


def possible(text: str) -> bool:
    """Whether an emoticon may stand in `text`: quick, and never wrongly False.

    >>> possible("Hi <3"), possible("Hi there.")
    (True, False)
    """
    return _SIGN.search(text) is not None


_SIGN = re.compile("[-:;=<_]|[xX]D")


def spans(text: str, start: int = 0, end: int | None = None) -> Iterator[Span]:
    """Where emoticons stand in `text[start:end]`.

    >>> [span.cut("Hi :-) it's a Grab: : - ( . (a:)") for span in spans("Hi :-) it's a Grab: : - ( . (a:)")]
    [':-)', ': - (']
    """
    for match in _PATTERN.finditer(text, start, len(text) if end is None else end):
        yield Span(*match.span())


def emotion(emoticon: str) -> str | None:
    """The emotion an emoticon stands for, or None for one that is only kept from being spoken.

    >>> emotion(": - O"), emotion(":)"), emotion(":-D"), emotion("<3")
    ('surprised', 'happy', None, None)
    """
    bare = emoticon.replace(" ", "").replace("=", ":").replace("O", "o")
    return EMOTIONS.get(bare if "-" in bare else bare[:1] + "-" + bare[1:])
