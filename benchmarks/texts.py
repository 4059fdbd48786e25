"""Texts of any length, of which no two sentences are the same: the example's prose with its words moved about."""

from __future__ import annotations

import re
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent / "examples" / "prose.txt"
WORDS_A_MINUTE = 180
"""Of text, breaths and pauses included, as the default voice reads it."""
_WORD = re.compile(r"[A-Za-z]{4,}")


def text_of(minutes: float, *, newlines: bool) -> str:
    """Prose that takes about so many minutes.

    In each round through the source another word in seven is replaced by one from elsewhere in it, so nothing that was
    counted, spoken or stored before serves again.

    Args:
        minutes: Wanted length.
        newlines: Paragraphs as in the source; otherwise a single line.
    """
    source = SOURCE.read_text(encoding="utf-8").strip()
    words = _WORD.findall(source)
    wanted = round(minutes * WORDS_A_MINUTE)
    parts: list[str] = []
    rounds = 0
    while wanted > 0:
        text = source if rounds == 0 else _varied(source, words, rounds)
        pieces = text.split()
        if len(pieces) > wanted:
            text = _first_words(text, wanted)
        parts.append(text)
        wanted -= len(pieces)
        rounds += 1
    whole = "\n\n".join(parts)
    return whole + "\n" if newlines else " ".join(whole.split())


def _varied(text: str, words: list[str], round_: int) -> str:
    count = 0

    def other(found: re.Match[str]) -> str:
        nonlocal count
        count += 1
        if count % 7 != round_ % 7:
            return found.group()
        word = words[(count * 31 + round_ * 1009) % len(words)]
        return word.capitalize() if found.group()[0].isupper() else word.lower()

    return _WORD.sub(other, text)


def _first_words(text: str, count: int) -> str:
    """The first words, up to the end of the sentence that the last one is in."""
    place = 0
    for _ in range(count):
        found = re.compile(r"\s*\S+").match(text, place)
        if found is None:
            return text
        place = found.end()
    end = re.compile(r"[.!?](?=\s|$)").search(text, place - 1)
    return text[: end.end()] if end else text
