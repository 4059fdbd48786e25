"""Is a text a poem? Told from its shape: verse breaks its lines before they are full."""

from __future__ import annotations

import re
from itertools import pairwise

BREAKS = 3
"""Line breaks inside stanzas it takes to tell."""
WIDTH = 60
"""Code points of a line of verse."""
NARROW = 0.9
"""Share of lines that are no longer than that, and that set the length of a full line."""
EARLY = 1 / 3
"""Share of line breaks before which the next line's first word would still have fitted."""
CAPITALS = 4
"""Lines that go on from the one before and begin with a capital, which also tell, if nearly all do."""
COMMON = 2
"""How many of those begin with a word that the text has in small letters too: no name, no German noun."""
STOPPED = 0.6
"""Share of lines that may end as a sentence does; with more, it is a list of sentences."""

_STOP = re.compile(r"[.!?…:][\"'”’»«“)\]]*$")
_ORNAMENT = re.compile(r"^\W+|\W+$")
_STANZA = re.compile(r"\n[^\S\n]*\n|[\f\u2029]")


def is_verse(text: str) -> bool:
    r"""Whether the lines of `text` are lines of verse, to be kept in speech.

    Four signs, all needed: at least `BREAKS` line breaks inside stanzas; short lines; lines that mostly do not end as
    sentences do; and line breaks that come early, or capitals at the beginnings of nearly all lines. The last one tells
    verse from prose that was wrapped, at whatever width: wrapping breaks a line only where the next word does not fit
    any more into the length that nine in ten lines keep to, and capitals inside a sentence come to lie there by chance.

    >>> is_verse("Es gingen zwei Parallelen\nins Endlose hinaus,\nzwei kerzengerade Seelen\nund aus solidem Haus.")
    True
    >>> is_verse("A text that was wrapped\nat two dozen columns by\nan editor is not verse:\nits lines are full.")
    False
    """
    lines: list[str] = []
    breaks: list[tuple[int, int]] = []
    running: list[str] = []
    for stanza in _STANZA.split(text):
        inside = [line.rstrip() for line in stanza.split("\n") if line.strip()]
        lines += inside
        breaks += [(len(line), len(after.split(maxsplit=1)[0])) for line, after in pairwise(inside)]
        running += [after.split(maxsplit=1)[0] for line, after in pairwise(inside) if not _STOP.search(line)]
    if len(breaks) < BREAKS:
        return False
    full = sorted(len(line) for line in lines)[int(NARROW * (len(lines) - 1))]
    narrow = sum(len(line) <= WIDTH for line in lines)
    stopped = sum(_STOP.search(line) is not None for line in lines)
    early = sum(length + 1 + word <= full for length, word in breaks)
    shaped = early >= EARLY * len(breaks)
    shaped = shaped or _capitals(running, text)
    return narrow >= NARROW * len(lines) and stopped <= STOPPED * len(lines) and shaped


def _capitals(firsts: list[str], text: str) -> bool:
    """Whether first words of lines that go on from the one before have capitals because the lines are verse."""
    begun = [word for word in (_ORNAMENT.sub("", first) for first in firsts) if word[:1].isupper()]
    if len(begun) < max(CAPITALS, NARROW * len(firsts)):
        return False
    small = {_ORNAMENT.sub("", word) for word in text.split()}
    return sum(word.lower() in small for word in begun) >= COMMON
