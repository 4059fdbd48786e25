"""The text eSpeak NG is given: nothing in it that it takes for a command, and an end that tells how to close."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass

from scorebreath.score.events import Closing

MARKS: dict[Closing, str] = {"final": ".", "continuing": ",", "question": "?"}
"""The mark whose tune closes so (tunes: `catalogue.CONTINUATION`)."""
EXCLAMATION = "!"
"""Also final, and kept where it is written."""
ENDINGS = frozenset(" .,;:!?…‥–—―-·、。，；：！？؟،؛।॥։።\"'”’“‘„‚»«›‹)]}」』）")
"""What may stand after the last word; taken off, for one mark to decide."""
OPENINGS = frozenset("\"'“”‘’„‚»«›‹([{¿¡「『（–—-")
"""What may stand before a word."""
SPACED = frozenset({"Cc", "Cs", "Co", "Cn", "Zl", "Zp", "Zs"})
"""Categories read as a space: control characters would be commands to the library, the others are nothing."""
JOINERS = "\u200c\u200d"
"""Format characters with a meaning in Indic and Persian spelling and in emoji; all others are left out."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Said:
    """Text for the library, with the way back."""

    text: str
    places: tuple[int, ...]
    """for each character but the closing mark, its place in the text asked for"""

    def span(self, start: int, end: int) -> tuple[int, int]:
        """Half-open range of the text asked for, from one of this text."""
        inside = self.places[max(0, start) : max(0, end)]
        return (inside[0], inside[-1] + 1) if inside else (0, 0)


def prepare(text: str, closing: Closing) -> Said:
    r"""Clean a text and give it the end that its closing wants.

    >>> prepare("along the river;", "continuing").text
    'along the river,'
    >>> prepare("Go!", "final").text, prepare("a\x01b", "final").text
    ('Go!', 'a b.')
    """
    kept = [(place, _clean(character)) for place, character in enumerate(text)]
    kept = [(place, character) for place, character in kept if character]
    tail = len(kept)
    while tail and kept[tail - 1][1] in ENDINGS:
        tail -= 1
    exclaimed = closing == "final" and any(character in "!！" for _, character in kept[tail:])
    mark = EXCLAMATION if exclaimed else MARKS[closing]
    body = "".join(character for _, character in kept[:tail])
    return Said(text=body + mark if body else "", places=tuple(place for place, _ in kept[:tail]))


def _clean(character: str) -> str:
    category = unicodedata.category(character)
    if category in SPACED:
        return " "
    return "" if category == "Cf" and character not in JOINERS else character
