"""What MaryXML tells of a word, beyond its letters: it stands in place of what would be found by rule (A12)."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from operator import itemgetter

NO_ACCENT = "none"


@dataclass(frozen=True, slots=True, kw_only=True)
class Told:
    """Of one word and of the boundary behind it; None and empty: nothing is told."""

    accent: str | None = None
    """ToBI label of its accent, such as `l+h*`; `none`: it has none"""
    pos: str = ""
    """part of speech, in whatever tag set"""
    ipa: str = ""
    """how it is pronounced, with stress marks"""
    break_index: int | None = None
    """of the boundary behind it, 1..6"""
    tone: str = ""
    """of that boundary, such as `h-l%`"""
    pause: float | None = None
    """s of silence at that boundary"""

    @property
    def boundary(self) -> bool:
        """Whether a phrase ends behind the word: from break index 3 on, or where a tone or a silence stands."""
        return (self.break_index or 0) >= 3 or bool(self.tone) or bool(self.pause)

    @property
    def joined(self) -> bool:
        """Whether it is told that no phrase ends behind the word."""
        return self.break_index is not None and not self.boundary


def together(told: Sequence[Told]) -> Told:
    """What several tokens tell of the one word that they make; the boundary is the last one's.

    >>> together([Told(accent="none", ipa="aɪ"), Told(accent="h*", ipa="m"), Told(break_index=4)])
    Told(accent='h*', pos='', ipa='aɪm', break_index=4, tone='', pause=None)
    """
    accents = [one.accent for one in told if one.accent]
    return Told(
        accent=next((accent for accent in accents if accent != NO_ACCENT), accents[0] if accents else None),
        pos=next((one.pos for one in told if one.pos), ""),
        ipa="".join(one.ipa for one in told),
        break_index=next((one.break_index for one in reversed(told) if one.break_index is not None), None),
        tone=next((one.tone for one in reversed(told) if one.tone), ""),
        pause=next((one.pause for one in reversed(told) if one.pause), None),
    )


def between(told: Sequence[tuple[int, Told]], start: int, end: int) -> Sequence[tuple[int, Told]]:
    """What is told at places from `start` on, up to `end`, of all that is told, ascending."""
    first, last = (bisect_left(told, place, key=itemgetter(0)) for place in (start, end))
    return told[first:last]
