"""A text with markup to the text that is said, and marks in it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from scorebreath.script.decode import checked
from scorebreath.script.marks import Mark
from scorebreath.script.markup.origin import Origin
from scorebreath.script.markup.settle import settle

Markup = Literal["auto", "tags", "ssml", "none"]
"""Which markup a text has; `auto`: SSML if it begins like that, else inline tags."""

_XML = re.compile(r"\s*+<(?:speak[\s/>]|\?xml\s|!DOCTYPE\s)")
_COMMENT = re.compile(r"\s*+<!--")


@dataclass(frozen=True, slots=True, kw_only=True)
class Marked:
    """A text whose markup is taken out."""

    text: str
    """what is said; newlines are universal"""
    marks: tuple[Mark, ...] = ()
    """in order, their places in `text`; each beside white space or at an end"""
    ends: tuple[int, ...] = ()
    """places of the last characters of sentences that the markup ends, whatever they look like"""
    language: str | None = None
    """BCP 47, if the text tells"""


def marked(text: str, *, markup: Markup = "auto", language: str | None = None, file: str = "") -> Marked:
    r"""Take the markup out of a text.

    Args:
        text: As somebody wrote it.
        markup: What to look for; `none`: nothing, all of it is said.
        language: BCP 47, in which `say-as` says numbers; None: what the text tells, or English.
        file: Its name, for messages.

    Raises:
        ScriptError: The text is too long, or no text; a tag or an element is unknown, unclosed, or has wrong values;
            the XML is broken.

    >>> marked("Well [sigh], no.").text, marked("Well [sigh], no.").marks[0].at
    ('Well, no.', 5)
    >>> marked(r"Press \[sigh] [1].").text
    'Press [sigh] [1].'
    >>> marked("<speak>One <break time='1s'/> two</speak>").marks[0].seconds
    1.0
    """
    text = checked(text, file)
    if markup == "ssml" or (markup == "auto" and is_ssml(text)):
        from scorebreath.script.markup.ssml import parse

        return parse(Origin(text=text, file=file), language)
    if markup == "none" or "[" not in text:
        return Marked(text=text)
    from scorebreath.script.markup.tags import find

    pieces, found = find(Origin(text=text, file=file))
    if len(pieces) == 1:
        return Marked(text=text)
    clean, marks, _ = settle("".join(pieces), found, ())
    return Marked(text=clean, marks=tuple(marks))


def is_ssml(text: str) -> bool:
    """Whether a text begins as an SSML document does: with `<speak`, perhaps behind comments, or as XML.

    >>> is_ssml("<!-- mine --> <speak>Hi</speak>"), is_ssml("<3 you"), is_ssml("<speaker>")
    (True, False, False)
    """
    at = 0
    while match := _COMMENT.match(text, at):
        end = text.find("-->", match.end())
        if end < 0:
            return False
        at = end + 3
    return _XML.match(text, at) is not None
