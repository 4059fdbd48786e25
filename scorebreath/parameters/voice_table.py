"""The table's rows of the voice: what is done to its pitch and sound after it has spoken, and what moves it.

With the defaults nothing is done to a voice unless it is loud, soft or moved; with `vocal_effort` and `emotion_voice`
at 0 as well, nothing ever.
"""

from __future__ import annotations

from scorebreath.parameters.breath_table import BreathTable
from scorebreath.parameters.row import row


class VoiceTable(BreathTable):
    """What pitch and sound of the voice follow, besides the text."""

    declination: float = row(
        0.0, "Slope of pitch over what is said on one breath, as it is heard; 0: as the voice has it by itself",
        unit="st/s", low=-8, high=8, level="voice", source="B58; physiology 5",
    )  # fmt: skip
    declination_share: float = row(
        0.0, "Declination by length: this much of what read speech was found to have, on top of `declination`",
        low=0, high=2, level="voice", source="B58; physiology 5 ('t Hart, Collier & Cohen 1990): 0.6 read, 0.4 free",
    )  # fmt: skip
    declination_reset: float = row(
        0.5, "Share of the fall that is taken back at a phrase edge without a breath; at a breath it is all",
        low=0, high=1.5, level="voice", source="physiology 5",
    )  # fmt: skip
    final_lowering: float = row(
        0.0, "Fall of pitch at the end of a statement, on top of what the voice does", unit="st", low=0, high=12,
        level="voice", source="physiology 5: 2 st over 250 ms",
    )  # fmt: skip
    question_rise: float = row(
        0.0, "Rise of pitch at the end of a question for yes or no, on top of what the voice does", unit="st",
        low=0, high=12, level="voice", source="physiology 5: 4 st",
    )  # fmt: skip
    vocal_effort: float = row(
        1.0, "How much a louder voice also sounds brighter and higher, as with more pressure; 0: a gain alone",
        low=0, high=1, level="voice", source="physiology 2.5, 5",
    )  # fmt: skip
    pressure_pitch: float = row(
        4.0, "Rise of pitch with the pressure below the larynx", unit="Hz/cmH2O", low=0, high=15,
        level="voice", source="physiology 5 (Strik & Boves 1989)",
    )  # fmt: skip
    emotion_voice: float = row(
        0.6, "How much an emotion moves the voice's pitch, range, rate and effort; 0: not at all", low=0, high=1,
        level="voice", source="A58 (Juslin & Laukka 2003, directions)",
    )  # fmt: skip
