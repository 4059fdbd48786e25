"""Turns of a dialogue: `NAME:` at the beginning of a line, as in a play, an interview or a log.

A line's end is no place to breathe in prose, for most lines end where the page did. In front of a speaker's label it is
one, whatever the line before it ends with. A colon may come to stand behind the first word of a line by chance, too, so
a text must show that its labels are meant. There are two of them at least, and one line in ten or more begins with one.
And either half of them stand where a line is over, or broke before it was full; or two that differ are in capitals; or
a third of the lines begin with one.
"""

from __future__ import annotations

import re

LABELS = 2
"""Lines with a label it takes to tell."""
SHARE = 0.1
"""Share of lines that begin with one, at least."""
OFTEN = 1 / 3
"""Share of such lines that needs no other sign, if there are more than `LABELS`."""
CLEAN = 0.5
"""Share of labels before which a line is over, at least."""
NARROW = 0.9
"""Share of lines that set the length of a full line."""

_NAME = r"[^\W\d_][\w.'\u2019-]{0,23}"
_LABEL = re.compile(rf"[^\S\n]*(?P<label>{_NAME}(?: (?:{_NAME}|\d{{1,2}})){{0,3}})(?: ?\([^()\n]{{1,40}}\))? ?:(?=\s)")
_LONGEST = 32
_OVER = re.compile(r"[.!?\u2026:;\u2014][\"'\u201d\u2019\u00bb\u00ab\u201c)\]]*$")


def turns(text: str) -> tuple[int, ...]:
    r"""Places of the newlines before lines that begin a speaker's turn; none in a text that is no dialogue.

    >>> turns("HAMLET: To be\nOPHELIA: Good my lord\nand so\nHAMLET: Well")
    (13, 42)
    >>> turns("He bought these:\nbread, milk, and\nCheese: the best.")
    ()
    """
    places: list[int] = []
    capitals: set[str] = set()
    clean = labels = count = start = 0
    before = ""
    lines = text.split("\n")
    full = sorted(len(line.rstrip()) for line in lines if line.strip())
    width = full[int(NARROW * (len(full) - 1))] if full else 0
    for line in lines:
        label = _LABEL.match(line + "\n")
        if label and _is_name(label["label"]):
            labels += 1
            if label["label"].isupper():
                capitals.add(label["label"])
            early = len(before) + 1 + label.end() <= width
            clean += not before or early or _OVER.search(before) is not None
            if before:
                places.append(start - 1)
        count += bool(line.strip())
        before = line.strip()
        start += len(line) + 1
    if labels < LABELS or labels < SHARE * count:
        return ()
    meant = clean >= CLEAN * labels or len(capitals) >= LABELS or (labels > LABELS and labels >= OFTEN * count)
    return tuple(places) if meant else ()


def _is_name(label: str) -> bool:
    """Whether a label is short and every word of it has a capital: FIRST LORD, Mrs. Smith, Q."""
    words = label.split(" ")
    return len(label) <= _LONGEST and all(word[0].isupper() or word.isdigit() for word in words)
