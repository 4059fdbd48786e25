"""Bytes to text: UTF-8, strictly, with the place of the first byte that is not; and what no text may be.

XML that names an encoding of one byte a letter, as MaryXML of S3's time does, is read in it where it is not UTF-8.
"""

from __future__ import annotations

import re

from scorebreath.errors import ScriptError

LIMIT = 64 * 1024 * 1024
"""Bytes of text that are read; more is no script but a mistake."""

SURROGATE = re.compile("[\ud800-\udfff]")
"""Half of a pair: no text."""

_OTHER_ENCODINGS = ((b"\xff\xfe", "UTF-16"), (b"\xfe\xff", "UTF-16"))

_DECLARED = re.compile(rb"\s*<\?xml\b[^>]{0,100}?\bencoding\s*=\s*[\"']([A-Za-z0-9._-]{1,40})[\"']")
_BY_XML = {
    "iso-8859-1": "iso-8859-1", "latin1": "iso-8859-1", "iso-8859-15": "iso-8859-15", "windows-1252": "cp1252",
}  # fmt: skip
"""Encodings that XML may name, in small letters, and what Python calls them."""

_TERMINAL = re.compile(
    r"(?:\x1b\[[0-?]*|\x9b[0-?]+)[@-~]"
    r"|(?:\x1b\]|\x9d)[^\x00-\x1f\x80-\x9f]*(?:\x07|\x1b\\|\x9c)"
    r"|\x1b[()][0-9A-Z]"
)
"""Sequences of ECMA-48 as they get into files: control sequences (CSI), titles and links (OSC), character sets."""


def decode(data: bytes, file: str = "") -> str:
    """Text of a UTF-8 file: without byte order mark, lines ended by a single newline.

    What was meant for a terminal (colours, titles) is left out whole. Other control characters than NUL are kept, and
    read as spaces later; a form feed is read as a new paragraph.

    Args:
        data: The whole file.
        file: Its name, for messages.

    Raises:
        ScriptError: Not UTF-8 (nor what its XML declaration names), a NUL byte (a binary file), or larger than `LIMIT`.
    """
    if len(data) > LIMIT:
        raise ScriptError(
            f"{len(data)} bytes of text", expected=f"at most {LIMIT}: render a long work in parts", file=file
        )
    for mark, name in _OTHER_ENCODINGS:
        if data.startswith(mark):
            raise ScriptError(f"{name} text", expected="UTF-8: save the text in that encoding", file=file, line=1)
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        if (declared := _declared(data)) is not None:
            return _clean(declared)
        found = f"byte 0x{data[error.start]:02x} that is not UTF-8 ({error.reason})"
        raise _at(data, error.start, found, "UTF-8 text", file) from None
    if (place := data.find(b"\0")) >= 0:
        raise _at(data, place, "NUL character", "text, not a binary file", file)
    return _clean(text)


def _clean(text: str) -> str:
    return universal_newlines(_TERMINAL.sub("", text.removeprefix("\ufeff")))


def _declared(data: bytes) -> str | None:
    """The text in the encoding that an XML declaration names, if that is one we know."""
    match = _DECLARED.match(data)
    encoding = _BY_XML.get(match[1].decode("ascii").lower()) if match else None
    if encoding is None or b"\0" in data:
        return None
    try:
        return data.decode(encoding)
    except UnicodeDecodeError:  # cp1252 has holes
        return None


def universal_newlines(text: str) -> str:
    r"""`\r\n` and `\r` as `\n`.

    >>> universal_newlines("a\r\nb\rc")
    'a\nb\nc'
    """
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text


def checked(text: str, file: str = "") -> str:
    """A text that did not come through `decode`, with universal newlines and without byte order mark.

    Raises:
        ScriptError: Half of a surrogate pair, which is no text, or more than `LIMIT` code points.
    """
    text = universal_newlines(text.removeprefix("\ufeff"))
    if len(text) > LIMIT:
        raise ScriptError(
            f"{len(text)} characters", expected=f"at most {LIMIT}: render a long work in parts", file=file
        )
    if match := SURROGATE.search(text):
        line = text.count("\n", 0, match.start()) + 1
        column = match.start() - text.rfind("\n", 0, match.start())
        problem = f"half of a surrogate pair (U+{ord(match.group()):04X})"
        raise ScriptError(problem, expected="text", file=file, line=line, column=column)
    return text


def _at(data: bytes, place: int, problem: str, expected: str, file: str) -> ScriptError:
    """The error for a byte, with line, column and the line itself."""
    before = universal_newlines(data[:place].decode("utf-8", "replace").removeprefix("\ufeff"))
    start = max(data.rfind(b"\n", 0, place), data.rfind(b"\r", 0, place)) + 1
    ends = [end for mark in (b"\n", b"\r") if (end := data.find(mark, place)) >= 0]
    shown = data[start : min([place + 200, *ends])].decode("utf-8", "replace").removeprefix("\ufeff")
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    return ScriptError(problem, expected=expected, file=file, line=line, column=column, text=shown)
