"""What MaryXML tells of a word, beyond its letters: it stands in place of what would be found by rule (A12)."""

from __future__ import annotations

from dataclasses import dataclass


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
