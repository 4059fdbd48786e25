"""The elements of SSML that are understood, and those that are known but not supported, as tables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Content = Literal["mixed", "text", "empty", "ignored"]
"""What may stand in an element: anything, text alone, nothing, anything that is not said."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Element:
    """One row of the table."""

    content: Content = "mixed"
    attributes: tuple[str, ...] = ()
    """that mean something"""
    required: tuple[str, ...] = ()
    """of these"""
    idle: tuple[str, ...] = ()
    """attributes that are accepted and change nothing"""
    refused: tuple[str, ...] = ()
    """attributes of SSML that are not supported"""
    outside: tuple[str, ...] = ()
    """elements it may not stand in, at any depth"""


_P, _S = ("p", "paragraph"), ("s", "sentence")
_PARAGRAPH = Element(attributes=("xml:lang",), idle=("onlangfailure",), outside=(*_P, *_S))
_SENTENCE = Element(attributes=("xml:lang",), idle=("onlangfailure",), outside=_S)
_WORD = Element(attributes=("xml:lang",), idle=("role", "onlangfailure"))

ELEMENTS: Mapping[str, Element] = {
    "speak": Element(
        attributes=("version", "xml:lang"), idle=("onlangfailure",), refused=("startmark", "endmark"),
        outside=("speak",),
    ),
    "p": _PARAGRAPH,
    "paragraph": _PARAGRAPH,
    "s": _SENTENCE,
    "sentence": _SENTENCE,
    "break": Element(content="empty", attributes=("time", "strength")),
    "mark": Element(content="empty", attributes=("name",), required=("name",)),
    "emphasis": Element(attributes=("level",)),
    "prosody": Element(attributes=("rate", "pitch", "volume"), refused=("contour", "range", "duration")),
    "sub": Element(content="text", attributes=("alias",), required=("alias",)),
    "say-as": Element(
        content="text", attributes=("interpret-as", "format"), required=("interpret-as",), idle=("detail",)
    ),
    "voice": Element(
        attributes=("name", "xml:lang"), required=("name",),
        idle=("gender", "age", "variant", "languages", "required", "ordering", "onvoicefailure", "onlangfailure"),
    ),
    "lang": Element(attributes=("xml:lang",), required=("xml:lang",), idle=("onlangfailure",)),
    "w": _WORD,
    "token": _WORD,
    "meta": Element(content="empty", idle=("name", "content", "http-equiv")),
    "metadata": Element(content="ignored"),
    "emotion": Element(content="empty", attributes=("type", "intensity"), required=("type",)),
    "amazon:breath": Element(content="empty", attributes=("duration", "volume")),
    "amazon:auto-breaths": Element(attributes=("volume", "frequency", "duration")),
}  # fmt: skip
"""Elements of SSML 1.1 and Amazon Polly that are understood; `paragraph` and `sentence` are SSML 1.0's, `emotion` is
S3's (A9)."""

UNSUPPORTED = frozenset(
    {
        "audio", "desc", "lexicon", "lookup", "phoneme", "seq", "par", "media", "amazon:domain", "amazon:effect",
        "amazon:emotion", "google:style", "mstts:express-as", "mstts:silence", "mstts:viseme",
    }
)  # fmt: skip
"""Elements of SSML and its dialects that are known, but not supported."""

IDLE_PREFIXES = ("xmlns", "xml:id", "xml:base", "xml:space", "xsi:")
"""How attributes begin that any element may have."""
