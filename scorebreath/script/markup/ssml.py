"""SSML 1.1, with Amazon's breaths, read by expat: no namespaces, no document type, no entities, nothing fetched."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from xml.parsers import expat

from scorebreath.errors import ScriptError, did_you_mean, shortened
from scorebreath.script.markup import broken
from scorebreath.script.markup.attributes import Attributes
from scorebreath.script.markup.elements import ELEMENTS, IDLE_PREFIXES, UNSUPPORTED, Element
from scorebreath.script.markup.marked import Marked
from scorebreath.script.markup.meaning import MEANINGS, Close, Document
from scorebreath.script.markup.origin import Origin
from scorebreath.script.markup.settle import settle

DEEPEST = 64
"""Elements within each other."""
_ENCODING = "utf-8"
_TAG = re.compile(rb"<(?:[^>\"']|\"[^\"]*\"|'[^']*')*+>")
_CHUNK = 1 << 20


def parse(origin: Origin, language: str | None = None) -> Marked:
    """Read an SSML document.

    Args:
        origin: The whole document.
        language: BCP 47, whatever the document says; None: as it says, or English.

    Raises:
        ScriptError: It is no SSML, or has what is not supported.
    """
    reader = _Reader(origin, language)
    reader.run()
    writer = reader.document.writer
    text, marks, ends = settle("".join(writer.pieces), writer.marks, writer.ends)
    return Marked(text=text, marks=tuple(marks), ends=tuple(ends), language=reader.document.told)


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


class _Reader:
    """Goes through a document, element by element."""

    def __init__(self, origin: Origin, language: str | None) -> None:
        self._origin = origin
        self._data = origin.text.encode(_ENCODING, "surrogatepass")
        self._stack: list[_Open] = []
        self._parser = expat.ParserCreate(_ENCODING)
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._text
        self._parser.StartDoctypeDeclHandler = self._doctype
        self.document = Document(language=language)

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
            raise broken.error(self._origin, error.code, place, opened) from None

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

    def _doctype(self, *_: object) -> None:
        byte = max(0, self._data.rfind(b"<!DOCTYPE", 0, self._parser.CurrentByteIndex + 1))
        expected = "<speak> without one: no entities are expanded, and nothing is fetched"
        raise self._error("a document type", expected, byte=byte)

    def _start(self, name: str, given: Mapping[str, str]) -> None:
        element = self._known(name)
        if len(self._stack) >= DEEPEST:
            raise self._error(f"{DEEPEST + 1} elements within each other", f"at most {DEEPEST}")
        if self._stack and self._stack[-1].element.content == "ignored":
            self._stack.append(_Open(name, Element(content="ignored"), self._parser.CurrentByteIndex, None))
            return
        attributes = self._attributes(name, element, given)
        close = MEANINGS[name](self.document, attributes) if name in MEANINGS else None
        self._stack.append(_Open(name, element, self._parser.CurrentByteIndex, close))

    def _known(self, name: str) -> Element:
        """The row of an element that may stand here."""
        if self._stack and self._stack[-1].element.content == "ignored":
            return self._stack[-1].element
        shown = shortened(name, 40)
        if name not in ELEMENTS:
            supported = ", ".join(f"<{known}>" for known in ELEMENTS)
            if name in UNSUPPORTED:
                raise self._error(f"<{shown}> is not supported", f"one of {supported}")
            raise self._error(f"no element is called <{shown}>{did_you_mean(name, ELEMENTS)}", f"one of {supported}")
        if not self._stack and name != "speak":
            raise self._error(f"<{shown}> as the outermost element", "<speak>")
        element = ELEMENTS[name]
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
                raise attributes.error(key, f"is unknown{did_you_mean(key, element.attributes)}", known)
        for key in element.required:
            if key not in given:
                raise self._error(f"<{name}> without {key}", f'<{name} {key}="...">')
        return attributes

    def _text(self, text: str) -> None:
        inner = self._stack[-1]
        if inner.element.content == "mixed":
            self.document.writer.text(text)
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
