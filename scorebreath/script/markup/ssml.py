"""SSML 1.1, with Amazon's breaths, read by expat: no namespaces, no document type, no entities, nothing fetched."""

from __future__ import annotations

from scorebreath.script.markup.elements import ELEMENTS, UNSUPPORTED
from scorebreath.script.markup.marked import Marked
from scorebreath.script.markup.meaning import MEANINGS, Document
from scorebreath.script.markup.origin import Origin
from scorebreath.script.markup.settle import settle
from scorebreath.script.markup.xml import DEEPEST, Dialect, XmlReader

__all__ = ["DEEPEST", "parse"]

SSML = Dialect(called="an SSML document", root="speak", elements=ELEMENTS, unsupported=UNSUPPORTED, meanings=MEANINGS)


def parse(origin: Origin, language: str | None = None) -> Marked:
    """Read an SSML document.

    Args:
        origin: The whole document.
        language: BCP 47, whatever the document says; None: as it says, or English.

    Raises:
        ScriptError: It is no SSML, or has what is not supported.
    """
    document = Document(language=language)
    XmlReader(origin, SSML, document).run()
    writer = document.writer
    text, marks, ends = settle("".join(writer.pieces), writer.marks, writer.ends)
    return Marked(text=text, marks=tuple(marks), ends=tuple(ends), language=document.told)
