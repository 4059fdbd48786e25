"""Text that stands in a document twice: as it was, and as the tokens that were made of it.

Some of MaryTTS's modules leave the text of a paragraph or a sentence in front of its tokens. It is recognised by being
the same, letter by letter, as the tokens within the same element (or as what they were made of: `orig` of an `mtu`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from xml.parsers import expat

_ENCODING = "utf-8"
_CHUNK = 1 << 20


@dataclass(slots=True)
class _Open:
    byte: int
    first: int
    """how many tokens there are before it"""
    length: int
    """letters of these"""
    own: list[str] = field(default_factory=list)
    """letters that stand in it and in nothing within it"""


@dataclass(slots=True)
class _Scan:
    """What is known so far."""

    parser: expat.XMLParserType
    stack: list[_Open] = field(default_factory=list)
    tokens: list[str] = field(default_factory=list)
    length: int = 0
    token: int = 0
    """how deep inside a token"""
    unit: int = 0
    """how deep inside an `mtu` that tells what it was"""
    found: set[int] = field(default_factory=set)

    def start(self, name: str, given: Mapping[str, str]) -> None:
        """An element begins; a prefix says nothing here."""
        name = name.rpartition(":")[2]
        self.stack.append(_Open(self.parser.CurrentByteIndex, len(self.tokens), self.length))
        if self.token or name == "t":
            self.token += 1
        if self.unit or (name == "mtu" and given.get("orig", "").strip()):
            if not self.unit:
                self._add(given["orig"])
            self.unit += 1

    def end(self, _: str) -> None:
        """An element ends."""
        element = self.stack.pop()
        own = "".join(element.own)
        alike = own and not self.token and len(own) == self.length - element.length
        if alike and own == "".join(self.tokens[element.first :]):
            self.found.add(element.byte)
        self.token -= bool(self.token)
        self.unit -= bool(self.unit)

    def text(self, text: str) -> None:
        """Text, of a token or of what is around them."""
        if not self.token:
            self.stack[-1].own.append(_letters(text))
        elif not self.unit:
            self._add(text)

    def _add(self, text: str) -> None:
        letters = _letters(text)
        self.tokens.append(letters)
        self.length += len(letters)


def doubled(text: str) -> frozenset[int]:
    """Elements whose own text is said by the tokens in them.

    Args:
        text: The document; if it is broken, what can be seen before that counts.

    Returns:
        The bytes, of the document in UTF-8, at which their tags begin.

    >>> doubled("<p>One two.<s><t>One</t><t>two</t><t>.</t></s></p>"), doubled("<p>One <t>two</t></p>")
    (frozenset({0}), frozenset())
    """
    if ("<t" not in text and ":t" not in text) or "<!ENTITY" in text:  # such a document is refused
        return frozenset()
    parser = expat.ParserCreate(_ENCODING)
    parser.buffer_text = True
    scan = _Scan(parser)
    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = scan.start, scan.end, scan.text
    data = text.encode(_ENCODING, "surrogatepass")
    try:
        for start in range(0, len(data), _CHUNK):
            parser.Parse(data[start : start + _CHUNK], False)
    except expat.ExpatError:
        pass  # whoever reads the document says what is wrong with it
    return frozenset(scan.found)


def _letters(text: str) -> str:
    """A text without its white space."""
    return "".join(text.split())
