"""A MaryXML document while it is read: the text that its tokens make, and what it tells of them."""

from __future__ import annotations

from dataclasses import dataclass, field

from scorebreath.script.marks import Act
from scorebreath.script.markup.maryxml.tokens import PART, is_word, opens, spaces
from scorebreath.script.markup.meaning import Document
from scorebreath.script.told import NO_ACCENT, Told

SENTENCE = 5
"""Break index from which on a boundary ends a sentence."""
BREATH = 1.2
"""s that a sentence's end takes by itself, with a breath: only what is told beyond it is asked for."""
PHRASE = 4
"""Break index of a phrase's end that tells none of its own: an intonational phrase."""


@dataclass(slots=True, kw_only=True)
class Token:
    """A `t` that is not closed yet."""

    accent: str | None
    pos: str
    ipa: str
    sounds_like: str
    """what is said instead of what is written"""
    pieces: list[str] = field(default_factory=list)


@dataclass(slots=True, kw_only=True)
class MaryDocument(Document):
    """What is known about a document while it is read."""

    doubled: frozenset[int] = frozenset()
    """elements whose own text its tokens say again, by the byte of their tag"""
    token: Token | None = None
    """that is open"""
    found: list[tuple[int, Told]] = field(default_factory=list)
    """what is told, at places of letters in the text so far, ascending"""
    bare: list[int] = field(default_factory=list)
    """of these, which are words of which no accent is told"""
    accented: bool = False
    """whether any token tells its accent"""
    raw: bool = False
    """whether anything is said that is no token"""
    last: int = -1
    """place of the last letter said; -1: there is none"""
    bounded: int = -1
    """the last letter behind which a boundary is told"""
    implied: int = -1
    """the last letter of a phrase that has just ended without telling how; -1: none"""
    parted: bool = False
    """whether a boundary was the last thing, so that what comes next is another word"""
    glued: bool = False
    """whether what comes next has no space before it"""
    quoted: bool = False
    """whether a quotation is open"""

    def text(self, text: str, element: int) -> None:
        """Take text: of a token, of what is around tokens, or what tokens say again."""
        if self.token is not None:
            self.token.pieces.append(text)
        elif element not in self.doubled and not (self.glued and not text.strip()):
            if is_word(text):
                self._begin()
                self.raw = True
            self._say(f" {text}" if self.parted and text[0].isalnum() else text)
            self.glued, self.parted = opens(text), False

    def close_token(self) -> None:
        """Say a token, and keep what is told of it."""
        token, self.token = self.token, None
        if token is None:
            return
        written = " ".join((token.sounds_like or "".join(token.pieces)).split())
        if not written:
            return
        side, self.quoted = spaces(written, self.quoted)
        glued = self.glued or side == "behind"
        if glued and self.writer.gap == " ":
            self.writer.gap = ""
        word = is_word(written)
        if word:
            self._begin()
        self._say(written if glued else f" {written}")
        if word:
            self._tell(token, written)
        self.glued = side == "before"

    def _begin(self) -> None:
        """A word comes: the phrase that ended before it ended within its sentence."""
        if self.implied >= 0:
            self.found.append((self.implied, Told(break_index=PHRASE)))
            self.implied = -1

    def _say(self, text: str) -> None:
        """Write, and remember where the last letter stands."""
        self.writer.text(text)
        core = text.rstrip(" \t\n")
        behind = next((n for n, letter in enumerate(reversed(core)) if letter.isalnum()), None)
        if behind is not None:
            self.last = self.writer.length - 1 - behind

    def _tell(self, token: Token, written: str) -> None:
        """What a token tells, at its first letter; its other parts, behind hyphens, bear no accent of their own."""
        start = self.writer.length - len(written)
        self.accented = self.accented or token.accent is not None
        for number, part in enumerate(PART.finditer(written)):
            accent, ipa = (token.accent, token.ipa) if number == 0 else (token.accent and NO_ACCENT, "")
            if accent is None:
                self.bare.append(len(self.found))
            self.found.append((start + part.start(), Told(accent=accent, pos=token.pos, ipa=ipa)))

    def boundary(self, written: str, break_index: int | None, tone: str, pause: float | None) -> None:
        """A boundary behind what was said so far."""
        if self.last >= 0 and (break_index is not None or tone or pause):
            self.found.append((self.last, Told(break_index=break_index, tone=tone, pause=pause)))
            self.bounded, self.implied = self.last, -1
        self.parted = True
        asked = round((pause or 0.0) - (BREATH if (break_index or 0) >= SENTENCE else 0.0), 6)
        if asked > 0.0:
            self.writer.mark(Act(at=0, written=written, name="pause", seconds=asked))

    def end_phrase(self, began: int) -> None:
        """A phrase ends that began when `began` was the last letter."""
        if self.last > began and self.bounded != self.last:
            self.implied = self.last

    def end_sentence(self) -> None:
        """A sentence ends, and with it its last phrase."""
        self.implied = -1
        self.glued = False
        self.writer.sentence()

    def end_paragraph(self) -> None:
        """A paragraph ends, and whatever quotation is open in it."""
        self.end_sentence()
        self.quoted = False
        self.writer.paragraph()

    def all_told(self) -> list[tuple[int, Told]]:
        """Everything told, ascending.

        Where tokens tell their accents and nothing else is said, those that tell none have none.
        """
        told = list(self.found)
        if self.accented and not self.raw:
            for index in self.bare:
                place, one = told[index]
                told[index] = place, Told(accent=NO_ACCENT, pos=one.pos, ipa=one.ipa)
        return sorted(((place, one) for place, one in told if one != Told()), key=lambda pair: pair[0])
