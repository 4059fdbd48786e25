"""What a voice says to measure how loud it is: one sentence in its language."""

from __future__ import annotations

SENTENCES = {
    "de": "Der alte Fährmann ruderte langsam über den Fluss, und die Kinder winkten ihm vom Ufer aus nach.",
    "en": "The old ferryman rowed slowly over the river, and the children waved to him from the bank.",
}
"""Language: what its voices' level is measured on."""
ELSEWHERE = ("1 2 3 4 5 6 7 8 9 10, 20 30 40 50 60 70 80 90 100.", "La mana luna sila, nona mila sana.")
"""In other languages: figures are read in nearly all of them, and letters in those that are silent there or crash."""
LEAST_DB = -60.0
"""Below, nothing was said."""
TYPICAL_DB = -20.0
"""Of a voice that says none of this; 20 languages of eSpeak NG lie between -18 and -23."""


def sentences(language: str) -> tuple[str, ...]:
    """What to say, the next one where a voice makes nothing of the one before.

    Args:
        language: BCP 47.
    """
    primary = language.replace("_", "-").partition("-")[0].lower()
    return (SENTENCES[primary],) if primary in SENTENCES else ELSEWHERE
