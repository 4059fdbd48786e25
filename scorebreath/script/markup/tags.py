r"""Inline tags found in a text: `[sigh]`, `[pause 0.4]`, `[state anxious 0.8]`.

A tag is a bracket with a known name directly in it, on one line. Brackets have other uses, so these are text: what
begins with no ASCII letter (`[1]`, `[...]`), words of one or two letters, brackets with a capital (`[He] left`), with
several words (`[emphasis added]`), or within a word (`[t]he`), all unless the name is one slip of the finger away from
a tag's. Everything else that looks like a tag and is none is an error, for nobody wants to hear it read. A backslash
in front makes any bracket text: `\[sigh]`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

from scorebreath.errors import ScriptError, did_you_mean, shortened
from scorebreath.parameters.states import STATES
from scorebreath.script.marks import Mark
from scorebreath.script.markup.names import TAGS, make, states, tags
from scorebreath.script.markup.origin import Origin

EDITORIAL = frozenset({"sic"})
"""Words in lower case that stand in brackets in books."""
LONGEST = 32
"""Letters of a name."""

_BRACKET = re.compile(rf"(\\?)\[(/?[A-Za-z][A-Za-z_-]{{0,{LONGEST - 1}}}(?![A-Za-z_-])|)")
_REST = re.compile(r"[^\[\]\n]*")
_ALONE = re.compile(r"/?[a-z]{3,}(?:[-_][a-z]+)*")
_QUANTITY = re.compile(r"[\s:=,]+(?:[0-9]*\.[0-9]+|[0-9]+\s?m?s)\s*")
"""What nobody writes in a bracket behind a single word, but in a tag: `[whisper 0.5]`."""
_SHORTEST = 4
"""Letters of what may be a slip of the finger."""

Found = tuple[list[str], list[tuple[int, Mark]]]
"""Pieces of the text between the tags; places in those pieces joined, and the marks."""


def find(origin: Origin) -> Found:
    """Cut the tags out of a text.

    Raises:
        ScriptError: A tag is unknown, unclosed, or has the wrong things behind its name.
    """
    text = origin.text
    pieces: list[str] = []
    marks: list[tuple[int, Mark]] = []
    taken = length = 0
    for start, end, mark in _tags(origin):
        pieces.append(text[taken:start])
        length += start - taken
        taken = end
        if mark is not None:
            marks.append((length, mark))
    pieces.append(text[taken:])
    return pieces, marks


def _tags(origin: Origin) -> Iterator[tuple[int, int, Mark | None]]:
    """Where each tag stands and its mark; a backslash that is to go, without one."""
    text, known = origin.text, tags()
    for bracket in _BRACKET.finditer(text):
        start = bracket.start()
        if bracket[1]:
            yield start, start + 1, None
            continue
        if not bracket[2]:
            continue
        name, end = bracket[2].lower(), bracket.end()
        if name not in known:
            _check(origin, bracket)
            continue
        rest = _REST.match(text, end)
        stop = rest.end() if rest else end
        if text[stop : stop + 1] != "]":
            raise _unclosed(origin, start, name)
        written = text[start : stop + 1]
        mark = make(name, text[end:stop].strip(), written)
        if isinstance(mark, str):
            raise origin.error(start, f"tag {shortened(written, 40)}", f"{mark}, or {_escaped(written)}")
        yield start, stop + 1, mark


def _check(origin: Origin, bracket: re.Match[str]) -> None:
    """A bracket with a word that is no tag's name: nothing if it may be text.

    Raises:
        ScriptError: It looks like a tag.
    """
    text, start, end, name = origin.text, bracket.start(), bracket.end(), bracket[2]
    rest = _REST.match(text, end)
    stop = rest.end() if rest else end
    closed = text[stop : stop + 1] == "]"
    if not _is_slip(name.lower()):
        if not closed:
            return
        if stop == end:
            if name in EDITORIAL or not _ALONE.fullmatch(name) or _glued(text, start, end + 1):
                return
        elif not (_ALONE.fullmatch(name) and _QUANTITY.fullmatch(text, end, stop)):
            return
    if not closed:
        raise _unclosed(origin, start, name.lower())
    written = text[start : stop + 1]
    names = ", ".join(tag.name for tag in TAGS)
    state = f"[state {name.lower()}], " if name.lower() in states() else ""
    raise origin.error(
        start,
        f"no tag is called {name!r}{'' if state else did_you_mean(name, tags(), 2)}",
        f"{state}one of {names}, a state ({', '.join(STATES)}), or {_escaped(written)}",
    )


def _unclosed(origin: Origin, start: int, name: str) -> ScriptError:
    """The error for a tag without its bracket."""
    return origin.error(start, f"tag [{name} is not closed", rf"] on the same line, or \[{name} to have it spoken")


def _escaped(written: str) -> str:
    """How to have a bracket spoken."""
    return rf"\{shortened(written, 24)} to have it spoken"


def _glued(text: str, start: int, end: int) -> bool:
    """Whether a bracket is part of a word, or the text of a link."""
    before, after = text[start - 1 : start], text[end : end + 1]
    return before.isalnum() or after.isalnum() or (bool(after) and after in "(:")


def _is_slip(name: str) -> bool:
    """Whether a name is a tag's with one letter too many, too few, or two exchanged."""
    if len(name) < _SHORTEST:
        return False
    return name in _slips() or any(shorter in tags() for shorter in _shortened(name))


@cache
def _slips() -> frozenset[str]:
    """Names of tags with a letter missing, or two exchanged."""
    found: set[str] = set()
    for name in tags():
        found.update(shorter for shorter in _shortened(name) if len(shorter) >= _SHORTEST)
        found.update(name[:at] + name[at + 1] + name[at] + name[at + 2 :] for at in range(len(name) - 1))
    return frozenset(found)


def _shortened(name: str) -> set[str]:
    """A name without one of its letters, each in turn."""
    return {name[:at] + name[at + 1 :] for at in range(len(name))}
