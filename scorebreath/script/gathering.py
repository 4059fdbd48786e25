"""The emotions written into a text as emoticons and emoji, gathered sentence by sentence as the reader gives them."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath.errors import shortened
from scorebreath.script import emoticons
from scorebreath.script.marks import EmotionMark
from scorebreath.spans import Span

BEHIND = 64
"""Code points before a sentence that may decide what an emoticon in it means."""
LONGEST = 40
"""Code points of a mark as written; of more emoji in a row not all are told."""


@dataclass(slots=True, kw_only=True)
class Gatherer:
    """Goes along with the reader; the marks are the same however the text was cut on its way.

    An emotion belongs to the last sentence that has begun, up to the first letter of the next one; before the first
    letter of all, to the first sentence.
    """

    lead: str = ""
    """what stands before the next sentence, as far as it matters"""
    done: int = 0
    """code points of the text that are gone through"""

    def begin(self, gap: str) -> None:
        """Take what stands before the first sentence, in pieces."""
        self.lead += gap

    def take(self, text: str, source: Span, letter: int, ahead: str, until: int | None) -> list[EmotionMark]:
        """The emotions of one sentence.

        Args:
            text: The sentence and what stands behind it, up to the next one.
            source: Where that is.
            letter: Place of its first letter.
            ahead: The beginning of the next sentence, with its first letter at least.
            until: Place of that letter; None: no sentence follows.
        """
        whole, origin = self.lead + text + ahead, source.start - len(self.lead)
        self.lead = (self.lead + text)[-BEHIND:]
        marks: list[EmotionMark] = []
        if not emoticons.possible(whole):
            return marks
        for sign in emoticons.signs(whole, max(0, self.done - origin)):
            place = origin + sign.span.start
            if until is not None and place >= until:
                break
            self.done = origin + sign.span.end
            at = min(place, source.start) if place < letter else min(place, source.end)
            marks.append(
                EmotionMark(
                    at=at, written=shortened(sign.span.cut(whole), LONGEST), name=sign.name, intensity=sign.intensity
                )
            )
        self.done = max(self.done, until or 0)  # what meant nothing is not asked again, with less before it
        return marks


def alone(text: str) -> tuple[EmotionMark, ...]:
    """The emotions of a text without a word.

    >>> [(mark.name, mark.at) for mark in alone(":-) ... :-(")]
    [('happy', 0), ('sad', 8)]
    """
    return tuple(Gatherer().take(text, Span(0, len(text)), 0, "", None))
