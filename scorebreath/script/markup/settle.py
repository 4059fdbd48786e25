"""Where a mark comes to stand once its tag is out of the text, and what becomes of the space around it.

A mark stands beside white space, or at an end of the text: never inside a word with its punctuation. So it goes behind
what closes (`Well[sigh], no`), in front of what opens (`"[sigh]Well`), and keeps apart what its tag kept apart. A line
of tags alone goes with its white space and its newline, so that no paragraph begins where none was meant.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from scorebreath.script.marks import Mark

_NEAR = 64
"""Code points that are looked at on either side of a tag."""
_MOST = 64
"""Marks that move together."""
_CLOSING = re.compile(r"(?![:;][)(|])(?:[,.;!?…‥)\]}”’»\"'。，、！？；]{1,8}|:)(?=\s|\Z)")
_STOPS = frozenset(",.;:")
_OPENERS = "([{“„‘‚«»\"'¿¡"
_REST_OF_LINE = re.compile(rf"[^\S\n]{{0,{_NEAR}}}(?:\n|\Z)")


@dataclass(slots=True, kw_only=True)
class Settled:
    """The text without tags, while it grows."""

    pieces: list[str] = field(default_factory=list)
    length: int = 0
    tail: str = ""
    """its last code points"""
    taken: int = 0
    """what lies before this place of the bare text is done with"""
    places: list[int] = field(default_factory=list)
    """of the marks"""
    tidy: bool = True
    """whether a mark of punctuation that a tag leaves twice goes"""
    edits: list[tuple[int, int]] = field(default_factory=list)
    """from which place of the bare text on places differ, and by how much"""

    def push(self, piece: str) -> None:
        """Append."""
        if piece:
            self.pieces.append(piece)
            self.length += len(piece)
            self.tail = piece[-_NEAR - 2 :] if len(piece) > _NEAR + 1 else (self.tail + piece)[-_NEAR - 2 :]

    def drop(self, end: int) -> None:
        """Leave out the bare text up to `end`."""
        self.taken = max(self.taken, end)
        self.edits.append((self.taken, self.length - self.taken))

    def unspace(self) -> None:
        """Take the last space back."""
        while not self.pieces[-1]:
            self.pieces.pop()
        self.pieces[-1] = self.pieces[-1][:-1]
        self.length -= 1
        self.tail = self.tail[:-1]
        self.edits.append((self.taken, self.length - self.taken))

    def fresh(self) -> bool:
        """Whether nothing stands in the line so far."""
        start = self.tail.rfind("\n") + 1
        return not self.tail[start:].strip() and (start > 0 or self.length <= _NEAR)

    def opening(self) -> int:
        """How many quotes and brackets that open something are the last thing so far."""
        if self.tail[-1:] not in _OPENERS:
            return 0
        before = self.tail.rstrip(_OPENERS)
        whole = not before and len(self.tail) == self.length
        return len(self.tail) - len(before) if whole or before[-1:].isspace() else 0

    def crowded(self) -> bool:
        """Whether so many marks stand here that moving them on again and again would take long."""
        return len(self.places) > _MOST and self.places[-_MOST] >= self.length - 1

    def mark(self, count: int, place: int, since: int | None = None) -> None:
        """Put marks at a place, with those that stand at `since` or behind, or further on than it."""
        index = len(self.places)
        while index and self.places[index - 1] >= (place + 1 if since is None else since):
            index -= 1
            self.places[index] = place
        self.places += [place] * count


def settle(bare: str, marks: Sequence[tuple[int, Mark]], places: Sequence[int]) -> tuple[str, list[Mark], list[int]]:
    """Give marks their places.

    Args:
        bare: The text with all tags cut out.
        marks: Places in it and what stood there, ascending.
        places: Other places in it, each of a character that is no space, ascending.

    Returns:
        The text, the marks in it, the other places in it.

    >>> from scorebreath.script.marks import NoBreath
    >>> text, marks, _ = settle("Well , no", [(5, NoBreath(at=0, written="[no-breath]"))], [])
    >>> text, marks[0].at
    ('Well, no', 5)
    """
    settled = Settled(tidy=not places)
    index = 0
    while index < len(marks):
        place, first = marks[index][0], index
        while index < len(marks) and marks[index][0] == place:
            index += 1
        if place > settled.taken:
            settled.push(bare[settled.taken : place])
            settled.taken = place
        _put(settled, bare, index - first)
    settled.push(bare[settled.taken :])
    found = [replace(mark, at=at) for (_, mark), at in zip(marks, settled.places, strict=True)]
    return "".join(settled.pieces), found, [_moved(place, settled.edits) for place in places]


def _moved(place: int, edits: Sequence[tuple[int, int]]) -> int:
    """A place of the bare text in the settled one."""
    index = bisect_right(edits, place, key=lambda edit: edit[0])
    return place + edits[index - 1][1] if index else place


def _put(settled: Settled, bare: str, count: int) -> None:
    """Put marks at the end of what is settled."""
    at = settled.taken
    left, right = settled.tail[-1:], bare[at : at + 1]
    fresh = settled.fresh()
    if fresh and (rest := _REST_OF_LINE.match(bare, at)):
        while _is_space(settled.tail[-1:]):
            settled.unspace()
        settled.drop(rest.end())
        settled.mark(count, settled.length)
        return
    opening = 0 if right in ("", "\n") else settled.opening()
    if opening:
        settled.mark(count, settled.length - opening)
        if _is_space(right):
            settled.drop(at + 1)
        return
    closing = None if fresh or right.isspace() or settled.crowded() else _CLOSING.match(bare, at)
    if closing:
        if settled.tidy and _is_space(left) and settled.tail[-2:-1] in _STOPS and closing.group() in _STOPS:
            settled.drop(closing.end())  # "Well, [sigh], no": the second comma is the tag's
            settled.mark(count, settled.length)
            if _is_space(bare[settled.taken : settled.taken + 1]):
                settled.drop(settled.taken + 1)
            return
        if _is_space(left):
            settled.unspace()
        word = settled.length
        settled.push(closing.group())
        settled.taken = closing.end()
        settled.mark(count, settled.length, word)
        return
    settled.mark(count, settled.length)
    if not left or left.isspace():
        if _is_space(right):
            settled.drop(at + 1)
    elif right and not right.isspace():
        settled.push(" ")
        settled.edits.append((at, settled.length - at))


def _is_space(character: str) -> bool:
    """White space within a line."""
    return character.isspace() and character != "\n"
