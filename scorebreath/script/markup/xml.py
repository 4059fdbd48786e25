"""XML of one dialect or another, read by expat: no entities, nothing fetched.

Of namespaces only the root's prefix is known: a name with it is one of the dialect's. Where the root has none, no
element may have one.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import Generic, TypeVar
from xml.parsers import expat

from scorebreath.errors import ScriptError, did_you_mean, shortened
from scorebreath.script.markup import broken
from scorebreath.script.markup.attributes import Attributes
from scorebreath.script.markup.elements import IDLE_PREFIXES, Element
from scorebreath.script.markup.meaning import Close, Document
from scorebreath.script.markup.origin import Origin

D = TypeVar("D", bound=Document)
DEEPEST = 64
"""Elements within each other."""
_ENCODING = "utf-8"
_TAG = re.compile(rb"<(?:[^>\"']|\"[^\"]*\"|'[^']*')*+>")
_CHUNK = 1 << 20
_ALIKE = 0.75
"""How alike names are that one is taken for a slip for the other."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Dialect(Generic[D]):
    """What documents of one kind may hold, and what it means."""

    called: str
    """with its article, for messages"""
    root: str
    """the outermost element"""
    elements: Mapping[str, Element]
    unsupported: frozenset[str] = frozenset()
    """elements that are known, but not supported"""
    meanings: Mapping[str, Callable[[D, Attributes], Close | None]]
    """what elements do"""
    open_attributes: bool = False
    """whether an attribute nobody knows is accepted, unless it looks like a slip for one that means something"""
    doctype: bool = False
    """whether a document type may be named; it is never loaded"""


@dataclass(slots=True)
class _Open:
    """An element that is not closed yet."""

    name: str
    element: Element
    byte: int
    """where its tag begins"""
    close: Close | None
    text: list[str] = field(default_factory=list)
    """of an element that holds text alone"""


class XmlReader(Generic[D]):
    """Goes through a document, element by element.

    Args:
        origin: The whole document.
        dialect: What it may hold.
        document: What becomes of it.

    Raises:
        ScriptError: From `run`: it is broken, or holds what it may not.
    """

    def __init__(self, origin: Origin, dialect: Dialect[D], document: D) -> None:
        """Nothing read yet."""
        self._origin = origin
        self._dialect = dialect
        self.document = document
        self._data = origin.text.encode(_ENCODING, "surrogatepass")
        self._stack: list[_Open] = []
        self._prefix = ""
        self._parser = expat.ParserCreate(_ENCODING)
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._text
        self._parser.StartDoctypeDeclHandler = self._doctype
        self._parser.SkippedEntityHandler = self._entity

    def run(self) -> None:
        """Read all of it."""
        try:
            for start in range(0, len(self._data), _CHUNK):
                self._parser.Parse(self._data[start : start + _CHUNK], False)
            self._parser.Parse(b"", True)
        except expat.ExpatError as error:
            last = self._stack[-1] if self._stack else None
            place = self._place(max(0, self._parser.ErrorByteIndex))
            opened = (last.name, self._place(last.byte)) if last else None
            called, root = self._dialect.called, self._dialect.root
            raise broken.error(self._origin, error.code, place, opened, called=called, root=root) from None

    def _place(self, byte: int) -> int:
        """Code points before a byte."""
        return len(self._data[:byte].decode(_ENCODING, "replace"))

    def _error(self, problem: str, expected: str, byte: int | None = None) -> ScriptError:
        at = self._parser.CurrentByteIndex if byte is None else byte
        return self._origin.error(self._place(at), problem, expected)

    def _written(self) -> str:
        """The tag that is being read, as written."""
        match = _TAG.match(self._data, self._parser.CurrentByteIndex)
        return shortened(match.group().decode(_ENCODING, "replace"), 200) if match else ""

    def _doctype(self, _: str, __: str | None, ___: str | None, inner: int) -> None:
        if self._dialect.doctype and not inner:
            return
        byte = max(0, self._data.rfind(b"<!DOCTYPE", 0, self._parser.CurrentByteIndex + 1))
        expected = f"<{self._dialect.root}> without one: no entities are expanded, and nothing is fetched"
        raise self._error("a document type with declarations" if inner else "a document type", expected, byte=byte)

    def _entity(self, name: str, _: bool) -> None:
        raise self._error(f"the entity &{shortened(name, 40)};", broken.ENTITIES)

    def _start(self, name: str, given: Mapping[str, str]) -> None:
        if not self._stack:
            self._prefix = self._own(name, given)
        name = name.removeprefix(self._prefix)
        element = self._known(name)
        if len(self._stack) >= DEEPEST:
            raise self._error(f"{DEEPEST + 1} elements within each other", f"at most {DEEPEST}")
        if self._stack and self._stack[-1].element.content == "ignored":
            self._stack.append(_Open(name, Element(content="ignored"), self._parser.CurrentByteIndex, None))
            return
        attributes = self._attributes(name, element, given)
        meaning = self._dialect.meanings.get(name)
        close = meaning(self.document, attributes) if meaning else None
        self._stack.append(_Open(name, element, self._parser.CurrentByteIndex, close))

    def _own(self, name: str, given: Mapping[str, str]) -> str:
        """The prefix of the root with its colon; empty where it has none, or is no root."""
        prefix, colon, local = name.partition(":")
        if not colon or local != self._dialect.root:
            return ""
        if not given.get(f"xmlns:{prefix}"):
            shown = shortened(prefix, 40)
            raise self._error(f"<{shown}:{local}> whose prefix is not declared", f'xmlns:{shown}="..." in it')
        return f"{prefix}:"

    def _known(self, name: str) -> Element:
        """The row of an element that may stand here."""
        if self._stack and self._stack[-1].element.content == "ignored":
            return self._stack[-1].element
        shown = shortened(name, 40)
        elements, root = self._dialect.elements, self._dialect.root
        if name not in elements:
            supported = ", ".join(f"<{known}>" for known in elements)
            if name in self._dialect.unsupported:
                raise self._error(f"<{shown}> is not supported", f"one of {supported}")
            raise self._error(f"no element is called <{shown}>{did_you_mean(name, elements)}", f"one of {supported}")
        if not self._stack and name != root:
            raise self._error(f"<{shown}> as the outermost element", f"<{root}>")
        element = elements[name]
        for outer in self._stack:
            if outer.name in element.outside:
                line = self._origin.line(self._place(outer.byte))
                raise self._error(f"<{name}> inside the <{outer.name}> of line {line}", f"</{outer.name}> before it")
        if self._stack and self._stack[-1].element.content != "mixed":
            inside = "nothing" if self._stack[-1].element.content == "empty" else "only text"
            raise self._error(f"<{name}> inside <{self._stack[-1].name}>", f"{inside} there")
        return element

    def _attributes(self, name: str, element: Element, given: Mapping[str, str]) -> Attributes:
        """The attributes of an element, looked at before anyone uses them."""
        byte = self._parser.CurrentByteIndex
        attributes = Attributes(
            origin=self._origin, place=lambda: self._place(byte), element=name, values=given, written=self._written()
        )
        for key in given:
            if key in element.refused:
                raise attributes.error(key, "is not supported", f"one of {', '.join(element.attributes)}")
            if key not in (*element.attributes, *element.idle) and not key.startswith(IDLE_PREFIXES):
                known = ", ".join(element.attributes) or "none"
                if self._dialect.open_attributes and not get_close_matches(key, element.attributes, 1, _ALIKE):
                    continue
                raise attributes.error(key, f"is unknown{did_you_mean(key, element.attributes)}", known)
        for key in element.required:
            if key not in given:
                raise self._error(f"<{name}> without {key}", f'<{name} {key}="...">')
        return attributes

    def _text(self, text: str) -> None:
        inner = self._stack[-1]
        if inner.element.content == "mixed":
            self.document.text(text, inner.byte)
        elif inner.element.content == "text":
            inner.text.append(text)
        elif inner.element.content == "empty" and text.strip():
            tag = _TAG.match(self._data, inner.byte)
            byte = tag.end() if tag else inner.byte  # expat is further on: it gathers text
            raise self._error(f"text inside <{inner.name}>", f"nothing: <{inner.name}/>", byte=byte)

    def _end(self, _: str) -> None:
        inner = self._stack.pop()
        if inner.close is None:
            return
        problem = inner.close("".join(inner.text), self._written())
        if problem:
            raise self._error(*problem, byte=inner.byte)
