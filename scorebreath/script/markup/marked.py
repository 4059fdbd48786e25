"""A text with markup to the text that is said, and marks in it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from scorebreath.script.decode import checked
from scorebreath.script.marks import Mark
from scorebreath.script.markup.origin import Origin
from scorebreath.script.markup.settle import settle
from scorebreath.script.told import Told

Markup = Literal["auto", "tags", "ssml", "maryxml", "none"]
"""Which markup a text has; `auto`: MaryXML or SSML if it begins like that, else inline tags."""

_PREFIX = r"(?:[^\W\d][\w.-]*:)?"
"""Of a namespace."""
_XML = re.compile(rf"\s*+<(?:{_PREFIX}speak[\s/>]|\?xml\s|!DOCTYPE\s)")
_COMMENT = re.compile(r"\s*+<!--")
_BEFORE_ROOT = re.compile(
    r"\s*+(?:<\?.*?\?>|<!--.*?-->|<!DOCTYPE(?:[^>\[\"']|\"[^\"]*\"|'[^']*')*+(?:\[.*?\]\s*)?>)", re.DOTALL
)
_MARYXML = re.compile(rf"\s*+<{_PREFIX}maryxml[\s/>]")
_EMOTION = re.compile(r"<emotion(?=\s[^<>]*=|\s*/?>)")
"""Nobody means to have this read out."""


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
    told: tuple[tuple[int, Told], ...] = ()
    """what MaryXML tells of words: each at a place of a letter of the word, ascending (A12)"""


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
    if markup == "maryxml" or (markup == "auto" and is_maryxml(text)):
        from scorebreath.script.markup.maryxml.reading import parse as parse_maryxml

        return parse_maryxml(Origin(text=text, file=file), language)
    if markup == "ssml" or (markup == "auto" and is_ssml(text)):
        from scorebreath.script.markup.ssml import parse

        return parse(Origin(text=text, file=file), language)
    if markup != "none" and (element := _EMOTION.search(text)):
        problem = "<emotion> in a text without <speak> or <maryxml> around it"
        raise Origin(text=text, file=file).error(element.start(), problem, "[emotion happy], or one of these")
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

    >>> is_ssml("<!-- mine --> <speak>Hi</speak>"), is_ssml("<3 you"), is_ssml("<speaker>"), is_ssml("<s:speak>")
    (True, False, False, True)
    """
    at = 0
    while match := _COMMENT.match(text, at):
        end = text.find("-->", match.end())
        if end < 0:
            return False
        at = end + 3
    return _XML.match(text, at) is not None


def is_maryxml(text: str) -> bool:
    """Whether a text is a MaryXML document: its outermost element is `<maryxml>`, with a prefix or without.

    >>> is_maryxml("<?xml version='1.0'?><!DOCTYPE maryxml SYSTEM 'x.dtd'><maryxml>Hi</maryxml>")
    True
    >>> is_maryxml("<speak>Hi</speak>"), is_maryxml("<maryxmlish>")
    (False, False)
    """
    if "maryxml" not in text:
        return False
    at = 0
    while match := _BEFORE_ROOT.match(text, at):
        at = match.end()
    return _MARYXML.match(text, at) is not None
