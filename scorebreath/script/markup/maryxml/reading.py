"""A MaryXML document to a text with its marks, and what it tells of its words."""

from __future__ import annotations

from bisect import bisect_left

from scorebreath.script.marks import Mark
from scorebreath.script.markup.marked import Marked
from scorebreath.script.markup.maryxml.document import MaryDocument
from scorebreath.script.markup.maryxml.doubled import doubled
from scorebreath.script.markup.maryxml.elements import ELEMENTS
from scorebreath.script.markup.maryxml.meaning import MEANINGS
from scorebreath.script.markup.origin import Origin
from scorebreath.script.markup.settle import settle
from scorebreath.script.markup.xml import Dialect, XmlReader

MARYXML = Dialect(
    called="a MaryXML document",
    root="maryxml",
    elements=ELEMENTS,
    meanings=MEANINGS,
    open_attributes=True,
    doctype=True,
)


def parse(origin: Origin, language: str | None = None) -> Marked:
    """Read a MaryXML document.

    Args:
        origin: The whole document.
        language: BCP 47, whatever the document says; None: as it says, or English.

    Raises:
        ScriptError: It is no MaryXML, is broken, or has wrong values.
    """
    document = MaryDocument(language=language, doubled=doubled(origin.text))
    XmlReader(origin, MARYXML, document).run()
    writer, told = document.writer, document.all_told()
    places = sorted({*writer.ends, *(place for place, _ in told)})
    marks: list[Mark]
    text, marks, moved = settle("".join(writer.pieces), writer.marks, places)
    return Marked(
        text=text,
        marks=tuple(marks),
        ends=tuple(moved[bisect_left(places, end)] for end in writer.ends),
        language=document.told,
        told=tuple((moved[bisect_left(places, place)], one) for place, one in told),
    )
