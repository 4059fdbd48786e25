"""Rate and pitch: from factors of the voice's own to the numbers eSpeak NG takes."""

from __future__ import annotations

import math

from scorebreath.speech.espeak.catalogue import Chosen
from scorebreath.speech.espeak.library import Settings

WORDS_PER_MINUTE = 175
"""the library's own rate"""
HASTE = 1.1
"""Asked for r times its own rate, r > 1, it speaks r ** 0.91 times as fast; so it is asked for r ** 1.1."""
RATES = (80, 450)
"""words a minute it can speak at"""
OWN = 50
"""of pitch and range: the voice's own"""
STRONGEST, WEAKEST = 1.98, 0.5
"""what its pitch parameter can do to the base, 99 and 0 against 50; a factor of 2 each 50 steps"""
RAISED = 9
"""Hz by which a base is lowered before it is multiplied"""
COMPENSATION = 18 * 108 / 4096
"""by how much a changed range moves the base, per Hz of range (both from its source, `SetPitch2`)"""


def settings(voice: Chosen, *, rate: float = 1.0, pitch: float = 1.0, continuing: bool = False) -> Settings:
    """What to set so that a voice speaks at a multiple of its own rate and mean pitch.

    The library multiplies only the base of the pitch; so the range is set as well, which keeps the intervals, and the
    base corrected for what that does to it. Beyond what the parameter can reach (about 0.6 and 1.8) the rest is done in
    the voice's definition; this changes its formants a little, as a smaller speaker would.

    Args:
        voice: Whose own pitch counts.
        rate: Factor, > 0.
        pitch: Factor, > 0.
        continuing: Whether the end is to sound as if more came.
    """
    base, top = voice.pitch
    above = max(1, base - RAISED)
    moved = COMPENSATION * (top - base) / above
    reach = sorted(((limit + moved) / (1 + moved)) for limit in (WEAKEST, STRONGEST))
    inside = min(max(pitch, reach[0]), reach[1])
    strength = min(max(inside + moved * (inside - 1), WEAKEST), STRONGEST)
    rest = pitch / inside
    redefined = None
    if abs(rest - 1) > 0.001:
        redefined = (round(RAISED + above * rest), round(RAISED + above * rest + (top - base) * rest))
    return Settings(
        definition=voice.definition(redefined, continuing=continuing),
        rate=min(max(round(WORDS_PER_MINUTE * (rate**HASTE if rate > 1 else rate)), RATES[0]), RATES[1]),
        pitch=min(max(round(OWN + OWN * math.log2(strength)), 0), 99),
        range=round(OWN * inside),
    )
