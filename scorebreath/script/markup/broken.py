"""What is wrong with XML that expat refuses, in words that say how to mend it."""

from __future__ import annotations

from xml.parsers.expat import ErrorString
from xml.parsers.expat.errors import codes

from scorebreath.errors import ScriptError, shortened
from scorebreath.script.markup.origin import Origin

ENTITIES = "&amp; &lt; &gt; &quot; &apos; or a number such as &#8212;"
_EXPECTED = {
    "syntax error": "{called}: <{root}> ... </{root}>",
    "no element found": "{called}: <{root}> ... </{root}>",
    "not well-formed (invalid token)": "XML: &amp; for & and &lt; for <, values in quotes, tags closed by >",
    "unclosed token": "> or --> that closes it",
    "partial character": "text",
    "mismatched tag": "tags closed in the order they were opened",
    "duplicate attribute": "each attribute once",
    "junk after document element": "nothing behind </{root}>",
    "undefined entity": ENTITIES,
    "reference to invalid character number": "the number of a character",
    "unclosed CDATA section": "]]> that closes it",
    "XML or text declaration not at start of entity": "<?xml ... ?> only at the very beginning",
}
"""What expat says, and what it expected."""


def error(origin: Origin, code: int, at: int, inner: tuple[str, int] | None, *, called: str, root: str) -> ScriptError:
    """The error for what expat found.

    Args:
        origin: The document.
        code: Of expat's error.
        at: Where it was noticed, code points.
        inner: The innermost open element, and where it was opened.
        called: What the document should be, with its article.
        root: Its outermost element.
    """
    if inner and code == codes["no element found"]:
        name, opened = inner
        return origin.error(opened, f"<{shortened(name, 40)}> is not closed", f"</{shortened(name, 40)}>")
    if inner and code == codes["mismatched tag"]:
        name, opened = inner
        at -= 2
        found = shortened(origin.text[at + 2 :].partition(">")[0].strip(), 40)
        line = origin.line(opened)
        problem = f"</{found}> where <{shortened(name, 40)}> of line {line} is open"
        return origin.error(at, problem, f"</{shortened(name, 40)}>")
    said = ErrorString(code) or "an error"
    expected = _EXPECTED.get(said, "well-formed XML")
    if "{root}" in expected:
        expected = expected.format(called=called, root=root)
    return origin.error(at, f"broken XML: {said}", expected)
